// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stucco {

// What a surveyed point is for: to hold the model, or to tell how good it is without taking part.
enum class PointRole { kControl, kCheck };

// Where a photo shows a surveyed point.
struct PointMarking {
  std::string photo;  // as the file names it
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  int line = 0;  // of the file, from 1
};

struct SurveyedPoint {
  std::string name;
  PointRole role = PointRole::kControl;
  Eigen::Vector3d coordinates = Eigen::Vector3d::Zero();  // east, north (longitude, latitude), up
  std::vector<PointMarking> markings;                     // at most one per photo
};

// A gcp_list.txt as OpenDroneMap reads it, with roles (docs/formats.md).
struct GroundControlList {
  std::string crs;  // as the file names it
  std::vector<SurveyedPoint> points;
  std::vector<std::string> problems;  // lines left out: "gcp_list.txt, line 7: ..."
};

// Lines that mean nothing are left out and become problems. `file` is for messages. Throws Error
// (kBadInput) when the first line names no coordinate system or no line is a point.
GroundControlList ParseGroundControl(std::string_view text, const std::string& file);

// The same as a text, which reads back as it is. Requires points with names and photos without
// blanks.
std::string GroundControlText(const GroundControlList& list);

}  // namespace stucco
