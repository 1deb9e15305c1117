// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calib/made_bays.h"

#include "tests/calib/expect/made_site.h"
#include "tests/calib/made_scene.h"
#include "tests/site/made_plan.h"
#include "tests/survey/stage_support.h"

namespace stucco::test {

void SeeKeypoint(const Pose& cam_from_plan, int bay, int i, int look, Features& features) {
  Random place(500 + i);
  const double x = 1 + 3 * bay + place.Uniform(0, 3);
  const Eigen::Vector3d point(x, 0, place.Uniform(1, 11));
  Random values(900 + look);
  std::array<uint8_t, 128> descriptor;
  for (uint8_t& value : descriptor) value = static_cast<uint8_t>(values.Uniform(0, 120));
  const auto pixel = SiteCamera().Project(cam_from_plan * point);
  if (!pixel || !SiteCamera().Contains(*pixel)) return;
  features.keypoints.push_back({static_cast<float>(pixel->x()), static_cast<float>(pixel->y()), 2});
  features.colors.push_back({});
  features.descriptors.push_back(descriptor);
}

Features SeeBays(const Pose& cam_from_plan, bool alike) {
  Features features;
  for (int bay = 0; bay < 6; ++bay) {
    for (int i = 0; i < 30; ++i) {
      SeeKeypoint(cam_from_plan, bay, i, alike ? i : i + 30 * bay, features);
    }
  }
  return features;
}

Pose Moved(const Pose& pose, const Eigen::Vector3d& off) {
  return {pose.rotation, -(pose.rotation * (pose.Center() + off))};
}

BaysTest::BaysTest() {
  captures_.cameras.push_back({"key", "Made", SiteCamera(), "option"});
  guidance_.facades = TwoHouses().facades;
  context_.progress = &SilentProgress();
  context_.units = &NoUnits();
  context_.threads = 2;
  options_.max_image_px = 1000;
  repeating_.period_m[0] = 3;
}

void BaysTest::Take(const Pose& cam_from_plan, bool alike) {
  Take(SeeBays(cam_from_plan, alike));
}

void BaysTest::Take(const Features& seen) {
  CapturedPhoto photo;
  photo.width_px = SiteCamera().width_px;
  photo.height_px = SiteCamera().height_px;
  photo.camera = 0;
  captures_.photos.push_back(photo);
  features_.plain.push_back(seen);
  repeating_.wall_of.emplace_back(features_.plain.back().size(), 0);
}

PhotoSet BaysTest::Photos() {
  photos_.clear();
  for (const CapturedPhoto& photo : captures_.photos) photos_.push_back(&photo);
  return {captures_, photos_, guidance_};
}

}  // namespace stucco::test
