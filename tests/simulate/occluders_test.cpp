// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/occluders.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>

namespace stucco::simulate {
namespace {

// A car is closed, its faces look outwards, it stands on the road and heads where it should.
TEST(Occluders, CarsAreSolidsOnTheRoad) {
  for (uint64_t seed = 0; seed < 12; ++seed) {
    Town town;
    town.seed = seed;
    town.ground = {{{-50, -50}, {50, 50}, Covering::kAsphalt, -0.12}};
    town.cars = {{{3, 4}, 0.6}};
    CityModel model;
    AddOccluders(town, model);
    const Eigen::Rotation2Dd back(-0.6);
    Eigen::AlignedBox3d box;
    double volume = 0;
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3i& triangle : model.scene.triangles) {
      std::array<Eigen::Vector3d, 3> p;
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d place = model.scene.positions[triangle[k]].cast<double>();
        p[k].head<2>() = back * (place.head<2>() - Eigen::Vector2d(3, 4));
        p[k].z() = place.z() + 0.12;
        box.extend(p[k]);
      }
      volume += p[0].dot(p[1].cross(p[2])) / 6;
      area += (p[1] - p[0]).cross(p[2] - p[0]) / 2;
    }
    EXPECT_NEAR(box.sizes().x(), 4.35, 0.1) << seed;
    EXPECT_NEAR(box.sizes().y(), 1.76, 0.05) << seed;
    EXPECT_NEAR(box.min().z(), 0, 0.01) << seed;
    EXPECT_NEAR(box.max().z(), 1.4, 0.05) << seed;
    // The faces of what is closed cancel out; those of a wheel do with the one across. Two thirds
    // of its box, roughly, are car.
    EXPECT_LT(area.norm(), 1e-4) << seed;
    EXPECT_NEAR(volume / box.volume(), 0.67, 0.07) << seed;
    for (const Eigen::Vector2f& uv : model.scene.uv) {
      ASSERT_TRUE(uv.minCoeff() >= -1e-5 && uv.maxCoeff() <= 1 + 1e-5) << uv.transpose();
    }
  }
}

}  // namespace
}  // namespace stucco::simulate
