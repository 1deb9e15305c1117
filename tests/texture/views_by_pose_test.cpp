// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/views_by_pose.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "survey/plan_frame.h"

namespace stucco {
namespace {

Georef Here() {
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = 50.001;
  georef.origin_longitude_deg = 14.001;
  return georef;
}

// Views every 5 m along a street, two of each stop: one looks north, one down to the east.
Plan StreetPlan() {
  Plan plan;
  plan.origin = {50, 14, 200};
  for (int i = 0; i < 8; ++i) {
    PlannedView view;
    view.id = "h" + std::to_string(i) + "v1";
    view.position_m = {5.0 * i, 2, 12};
    plan.views.push_back(view);
    view.id = "h" + std::to_string(i) + "v2";
    view.yaw_deg = 90;
    view.pitch_deg = -60;
    plan.views.push_back(view);
  }
  return plan;
}

// Where the view's photo stands in the world, moved by `shift`.
SurveyPhoto PhotoOf(const PlannedView& view, const Plan& plan, const Eigen::Vector3d& shift) {
  const double yaw = view.yaw_deg * std::numbers::pi / 180;
  const double pitch = view.pitch_deg * std::numbers::pi / 180;
  const Eigen::Vector3d ahead(std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch),
                              std::sin(pitch));
  const Eigen::Vector3d right(std::cos(yaw), -std::sin(yaw), 0);
  Eigen::Matrix3d axes;
  axes << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
  Eigen::Vector3d center;
  center << EnuFromPlan(plan.origin, Here(), view.position_m.head<2>()), view.position_m.z();
  SurveyPhoto photo;
  photo.cam_from_world.rotation = Eigen::Quaterniond(axes);
  photo.cam_from_world.translation = -(photo.cam_from_world.rotation * (center + shift));
  return photo;
}

std::vector<SurveyPhoto> Photos(const Plan& plan, const Eigen::Vector3d& shift) {
  std::vector<SurveyPhoto> photos;
  for (size_t v = 0; v < plan.views.size(); ++v) {
    // Wind moves each a little.
    const Eigen::Vector3d wind(0.3 * std::sin(2.0 * static_cast<double>(v)), 0.2, 0);
    photos.push_back(PhotoOf(plan.views[v], plan, shift + wind));
  }
  return photos;
}

TEST(NameViewsByPose, FindsTheViewsThroughAShiftOfTheFrame) {
  const Plan plan = StreetPlan();
  std::vector<SurveyPhoto> photos = Photos(plan, {1.2, -1.5, 240});
  NameViewsByPose(plan, Here(), photos);
  for (size_t v = 0; v < photos.size(); ++v) {
    EXPECT_EQ(photos[v].captured.view, plan.views[v].id);
  }
}

TEST(NameViewsByPose, AViewHasOnePhoto) {
  const Plan plan = StreetPlan();
  std::vector<SurveyPhoto> photos = Photos(plan, Eigen::Vector3d::Zero());
  photos.push_back(PhotoOf(plan.views[3], plan, {1, 0, 0}));    // taken again, farther off
  photos.push_back(PhotoOf(plan.views[3], plan, {0, -40, 0}));  // of no view
  NameViewsByPose(plan, Here(), photos);
  EXPECT_EQ(photos[3].captured.view, plan.views[3].id);
  EXPECT_EQ(photos[photos.size() - 2].captured.view, "");
  EXPECT_EQ(photos.back().captured.view, "");
}

TEST(NameViewsByPose, NamesStayAndTellTheShiftToTheRest) {
  const Plan plan = StreetPlan();
  // Farther off than a shift that is looked for, and half a stop along the street.
  std::vector<SurveyPhoto> photos = Photos(plan, {2.5, -9, 240});
  photos[4].captured.view = plan.views[4].id;
  photos[9].captured.view = plan.views[9].id;
  photos.push_back(PhotoOf(plan.views[4], plan, {2.5, -9, 240}));  // nearer than the named one
  photos.push_back(photos[2]);
  photos.back().captured.view = "a view of no plan";
  NameViewsByPose(plan, Here(), photos);
  for (size_t v = 0; v < plan.views.size(); ++v) {
    EXPECT_EQ(photos[v].captured.view, plan.views[v].id);
  }
  EXPECT_EQ(photos[plan.views.size()].captured.view, "");
  EXPECT_EQ(photos.back().captured.view, "a view of no plan");
}

TEST(NameViewsByPose, LeavesOtherFlightsAlone) {
  const Plan plan = StreetPlan();
  std::vector<SurveyPhoto> elsewhere = Photos(plan, {0, 300, 0});
  NameViewsByPose(plan, Here(), elsewhere);
  EXPECT_EQ(elsewhere[0].captured.view, "");

  std::vector<SurveyPhoto> nowhere = Photos(plan, Eigen::Vector3d::Zero());
  NameViewsByPose(plan, Georef{}, nowhere);
  EXPECT_EQ(nowhere[0].captured.view, "");
}

}  // namespace
}  // namespace stucco
