// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calib/made_bays.h"

#include "tests/calib/expect/made_site.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {

Features SeeBays(const Pose& cam_from_plan, bool alike) {
  Features features;
  for (int bay = 0; bay < 6; ++bay) {
    for (int i = 0; i < 30; ++i) {
      Random place(500 + i);
      const double x = 1 + 3 * bay + place.Uniform(0, 3);
      const Eigen::Vector3d point(x, 0, place.Uniform(1, 11));
      Random look(alike ? 900 + i : 900 + i + 30 * bay);
      std::array<uint8_t, 128> descriptor;
      for (uint8_t& value : descriptor) value = static_cast<uint8_t>(look.Uniform(0, 120));
      const auto pixel = SiteCamera().Project(cam_from_plan * point);
      if (!pixel || !SiteCamera().Contains(*pixel)) continue;
      features.keypoints.push_back(
          {static_cast<float>(pixel->x()), static_cast<float>(pixel->y()), 2});
      features.colors.push_back({});
      features.descriptors.push_back(descriptor);
    }
  }
  return features;
}

}  // namespace stucco::test
