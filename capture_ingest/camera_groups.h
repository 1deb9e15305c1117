// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "capture_ingest/photo_record.h"
#include "survey/captures.h"

namespace stucco {

// What photos must have in common to share intrinsics: make, model, serial number, lens, band,
// focal length, zoom, size and factory calibration. Two bodies of one model share a camera only
// where nothing in the metadata tells them apart.
std::string CameraKey(const PhotoRecord& record);

// "DJI FC6360, 1600 x 1300, 5.7 mm"; what is not known is left out.
std::string CameraLabel(const PhotoRecord& record);

// The cameras of all usable photos in the order of their first photo; sets CapturedPhoto::camera.
std::vector<CapturedCamera> GroupCameras(std::vector<PhotoRecord>& records);

// Replaces the intrinsics of the cameras that a known camera can belong to (fx fy cx cy, or these
// and k1 k2 p1 p2, in pixels of the full photo): those whose middle third holds its principal
// point. Returns the labels of the cameras it does not fit. Throws Error (kUsage) on a wrong number
// of values or values no camera has, and where it fits no camera at all. Requires OPENCV cameras,
// as GroupCameras makes them.
std::vector<std::string> ApplyPriorCamera(std::span<const double> prior, bool fixed,
                                          std::vector<CapturedCamera>& cameras);

}  // namespace stucco
