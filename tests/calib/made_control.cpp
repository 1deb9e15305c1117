// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calib/made_control.h"

#include <string>

namespace stucco::test {
namespace {

PlaceOnEarth PlaceAt(const Georef& frame, const Eigen::Vector3d& position) {
  const Eigen::Vector3d geodetic = GeodeticFromEnu(frame, position);
  return {geodetic.x(), geodetic.y(), geodetic.z()};
}

}  // namespace

Georef MadeFrame() {
  Georef frame;
  frame.frame = "enu";
  frame.origin_latitude_deg = 50.1;
  frame.origin_longitude_deg = 14.4;
  frame.origin_height_m = 250;
  frame.up = Eigen::Vector3d::UnitZ();
  frame.metric = true;
  frame.source = "gps";
  return frame;
}

GroundControl MakeControl(const Scene& truth, const Georef& frame,
                          const std::vector<Eigen::Vector3d>& positions, double mark_noise_px) {
  Random random(11);
  GroundControl control;
  control.file = "gcp_list.txt";
  for (const Eigen::Vector3d& position : positions) {
    MarkedPoint& point = control.points.emplace_back();
    point.name = "P" + std::to_string(control.points.size() - 1);
    point.place = PlaceAt(frame, position);
    for (int i = 0; i < static_cast<int>(truth.photos.size()); ++i) {
      const Camera& camera = truth.CameraOf(i);
      const auto pixel = camera.Project(*truth.photos[i].pose * position);
      if (!pixel) continue;
      const double x = random.Gauss(mark_noise_px);
      const Eigen::Vector2d marked = *pixel + Eigen::Vector2d(x, random.Gauss(mark_noise_px));
      if (camera.Contains(marked)) point.marks.push_back({i, marked});
    }
  }
  return control;
}

std::vector<Eigen::Vector3d> MadeCorners() {
  return {{-6, 1.75, 1},   {6, 1.75, 1.5}, {0, -2, 6},  {-4, 0.5, 6.5},
          {4.5, 0.8, 5.5}, {-4, -6, 0},    {5, -6.5, 0}};
}

void MovePoint(const Georef& frame, const Eigen::Vector3d& by_m, MarkedPoint& point) {
  point.place = PlaceAt(frame, PositionIn(frame, point.place) + by_m);
}

}  // namespace stucco::test
