// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tests/survey/temporary_folder.h"

namespace stucco {

// A JPEG of blocks whose pattern depends on `seed`, so that different seeds are different photos.
std::string MakeJpeg(int seed, int width_px = 320, int height_px = 240);

// The JPEG with EXIF tags ("Exif.Image.Make" -> "DJI") and the attributes of an XMP packet
// ("drone-dji:RtkFlag" -> "50") written into it by Exiv2.
std::string WithMetadata(const std::string& jpeg, const std::map<std::string, std::string>& exif,
                         const std::map<std::string, std::string>& xmp_attributes = {});

// The JPEG with this text as its XMP packet.
std::string WithXmpPacket(const std::string& jpeg, const std::string& packet);

// What a DJI drone writes: position, height, gimbal and camera.
std::string MakeDjiPhoto(int seed, double latitude_deg, double longitude_deg, double height_m);

class TempFolder : public test::TemporaryFolder {
 public:
  // Writes a file, creating folders on the way.
  void Write(const std::string& name, const std::string& bytes) const;
};

}  // namespace stucco
