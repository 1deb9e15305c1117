// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "proxy/cloud/input.h"
#include "survey/point_cloud.h"

namespace stucco::test {

// A flat polygon of the true scene, counter-clockwise seen from outside.
struct TruePolygon {
  std::string name;
  std::vector<Eigen::Vector3d> ring;
};

struct House {
  std::vector<TruePolygon> polygons;
};

// x to the east, y to the north, z up; eaves at `height`.
House GableHouse(double length = 12, double width = 8, double height = 6, double ridge = 9.5);
House BoxHouse(double length, double width, double height,
               const Eigen::Vector3d& corner = Eigen::Vector3d::Zero());
// Flat roofs; the missing quarter is the north-eastern one.
House LShapedHouse(double length = 14, double width = 12, double height = 7);
TruePolygon GroundSquare(double half, double z = 0);

// How a scene is turned into what the dense stage would give. Cameras stand on a ring around the
// origin at two heights, or in front of the south side only.
struct CaptureOptions {
  double spacing = 0.12;               // metres between points
  double noise = 0.01;                 // standard deviation along the normal
  double outliers = 0.0;               // share of points scattered through the scene's box
  bool front_only = false;             // photos from the south at eye level
  std::vector<std::string> hide = {};  // polygons by name without points
  uint64_t seed = 1;
};

struct Captured {
  PointCloud cloud;
  std::vector<SurveyPhoto> photos;
};

// The input refers to the cloud.
ProxyInput InputOf(const Captured& captured, const Georef& georef);

// A camera at `center` that looks along `forward`, its x axis along `right` (both unit vectors).
Pose PoseOf(const Eigen::Vector3d& center, const Eigen::Vector3d& forward,
            const Eigen::Vector3d& right);

// Points only where a camera sees the polygon (no other polygon in between, not from behind), with
// the normal's noise that patch-based stereo has (10 degrees), colours and up to three views.
Captured Capture(const std::vector<House>& houses, const std::vector<TruePolygon>& others,
                 const CaptureOptions& options);

// A ball of leaves: points through its volume with random normals.
void AddTree(const Eigen::Vector3d& center, double radius, int count, uint64_t seed,
             Captured& captured);

// Takes points away.
void EraseIf(const std::function<bool(const Eigen::Vector3d&)>& gone, Captured& captured);

// Turns and scales everything: an arbitrary frame as calibration without GPS gives.
void MoveTo(const Eigen::Matrix3d& rotation, double scale, const Eigen::Vector3d& translation,
            Captured& captured);

// The plane of a true polygon: unit normal and offset.
Eigen::Vector4d PlaneOf(const TruePolygon& polygon);

}  // namespace stucco::test
