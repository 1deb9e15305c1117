// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulate/flight/placing.h"
#include "survey/error.h"
#include "survey/plan_frame.h"
#include "tests/simulate/made_flight.h"

namespace stucco::simulate {
namespace {

using ::testing::HasSubstr;

std::string ProblemOf(const Plan& plan, const SceneShape& scene) {
  try {
    PlacePlan(plan, MadeSceneInfo(), scene);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    return std::string(error.what()) + "; " + error.remedy();
  }
  return "";
}

TEST(Placing, GroundOfAPlanWithoutTerrainIsTheScenes) {
  const PlacedPlan placed = PlacePlan(MadePlan(2), MadeSceneInfo(), MadeScene(17));
  EXPECT_NEAR(placed.height_m, 267, 1e-4);
  EXPECT_LT((WorldFromPlan(placed, {5, -15, 4}) - Eigen::Vector3d(5, -15, 21)).norm(), 1e-3);
}

// As models from elsewhere are: names that mean nothing, and no ground under the house.
SceneShape SceneFromElsewhere(double ground_m) {
  SceneShape scene = MadeScene(ground_m);
  scene.is_ours = false;
  scene.elements = {"field", "G7"};
  scene.cast = [=, whole = scene.cast](const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& direction) {
    const auto hit = whole(from, direction);
    const Eigen::AlignedBox2d house(Eigen::Vector2d(0, 0), Eigen::Vector2d(12, 8));
    const bool is_hole = hit && std::abs(hit->point.z() - ground_m) < 1e-9 &&
                         house.contains(hit->point.head<2>().eval());
    return is_hole ? std::nullopt : hit;
  };
  return scene;
}

TEST(Placing, ARoofWithoutGroundBelowIsNoGround) {
  // The plan's origin is a corner of the house.
  const PlacedPlan placed = PlacePlan(MadePlan(2), MadeSceneInfo(), SceneFromElsewhere(17));
  EXPECT_NEAR(placed.height_m, 267, 1e-4);
  EXPECT_EQ(placed.walls_judged, 1);
}

TEST(Placing, NamesMeanNothingInOtherModels) {
  SceneShape scene = MadeScene();
  scene.elements[1] = "G7";
  EXPECT_EQ(WhyBlocked(scene, {6, 4, 3}), "is below the ground");
  scene.is_ours = false;
  EXPECT_EQ(WhyBlocked(scene, {6, 4, 3}), "stands inside G7");
  scene.elements[1] = "occluder/house";
  EXPECT_EQ(WhyBlocked(scene, {6, 4, 3}), "stands inside occluder/house");
  scene.is_ours = true;
  scene.elements[1] = "G7 Main Street";
  EXPECT_EQ(WhyBlocked(scene, {6, 4, 3}), "stands inside G7 Main Street");
}

TEST(Placing, WallsThatCannotBeJudgedAreNoted) {
  // Roofs alone.
  SceneShape scene = SceneFromElsewhere(0);
  scene.cast = [with = scene.cast](const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
    const auto hit = with(from, direction);
    return hit && hit->element == 0 ? std::nullopt : hit;
  };
  Plan plan = MadePlan(8);
  plan.origin.height_m = 250;
  FlightOptions options;
  const PreparedFlight prepared = PrepareFlight(plan, MadeSceneInfo(), scene, options);
  EXPECT_EQ(prepared.placed.walls_judged, 0);
  ASSERT_EQ(prepared.notes.size(), 1u);
  EXPECT_THAT(prepared.notes[0], HasSubstr("only 0 of the plan's 1 walls"));
  EXPECT_TRUE(PrepareFlight(plan, MadeSceneInfo(), MadeScene(), options).notes.empty());
}

TEST(Placing, HeightsOfAPlanWithTerrainAreAbsolute) {
  Plan plan = MadePlan(2);
  plan.origin.height_m = 253;
  const PlacedPlan placed = PlacePlan(plan, MadeSceneInfo(), MadeScene());
  EXPECT_NEAR(WorldFromPlan(placed, {0, 0, 7}).z(), 10, 1e-6);
}

TEST(Placing, FollowsThePlansOriginAndNorth) {
  // The plan's origin 900 m east of the scene's: its north is turned by the meridians' convergence.
  Plan plan = MadePlan(2);
  PlanOrigin scene_origin{50.1, 14.2, 0};
  const Geodetic east = GeodeticFromPlan(scene_origin, {900, 0});
  plan.origin = {east.latitude_deg, east.longitude_deg, 250};
  for (auto& corner : plan.footprints[0].rings_m[0]) corner.x() -= 900;
  const PlacedPlan placed = PlacePlan(plan, MadeSceneInfo(), MadeScene());
  const Eigen::Vector2d origin = PlanFromGeodetic(plan.origin, {50.1, 14.2});
  EXPECT_NEAR(origin.norm(), 900, 0.01);
  EXPECT_LT(WorldFromPlan(placed, {origin.x(), origin.y(), 0}).norm(), 1e-6);
  const Eigen::Matrix3d axes = PlanAxesAt(placed, {0, 0, 0});
  EXPECT_NEAR((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 0, 1e-9);
  EXPECT_NEAR(axes.determinant(), 1, 1e-9);
  const double convergence = 900 / 6378137.0 * std::tan(50.1 / 57.29578);
  EXPECT_NEAR(std::atan2(axes(0, 1), axes(1, 1)), -convergence, 2e-6);
}

TEST(Placing, CameraAxesFollowTheGimbal) {
  const PlacedPlan placed = PlacePlan(MadePlan(2), MadeSceneInfo(), MadeScene());
  const auto in_camera = [&](const GimbalAngles& angles, const Eigen::Vector3d& direction) {
    return Eigen::Vector3d(CameraPose(placed, {1, 2, 3}, angles).rotation * direction);
  };
  const Eigen::Vector3d east(1, 0, 0), north(0, 1, 0), up(0, 0, 1);
  EXPECT_LT((in_camera({0, 0, 0}, north) - Eigen::Vector3d(0, 0, 1)).norm(), 1e-5);
  EXPECT_LT((in_camera({0, 0, 0}, up) - Eigen::Vector3d(0, -1, 0)).norm(), 1e-5);
  EXPECT_LT((in_camera({90, 0, 0}, east) - Eigen::Vector3d(0, 0, 1)).norm(), 1e-5);
  EXPECT_LT((in_camera({90, -90, 0}, up) - Eigen::Vector3d(0, 0, -1)).norm(), 1e-5);
  EXPECT_LT((in_camera({90, -90, 0}, east) - Eigen::Vector3d(0, -1, 0)).norm(), 1e-5);
  // Rolled to the right, the camera's right sinks.
  EXPECT_GT(in_camera({0, 0, 10}, -up).x(), 0.1);
  const Pose pose = CameraPose(placed, {1, 2, 3}, {30, -20, 0});
  EXPECT_LT((pose.Center() - Eigen::Vector3d(1, 2, 3)).norm(), 1e-4);
}

TEST(Placing, AModelWithoutAPlaceIsInThePlansFrame) {
  SceneInfo info;  // "arbitrary"
  const PlacedPlan placed = PlacePlan(MadePlan(2), info, MadeScene(2));
  EXPECT_LT((WorldFromPlan(placed, {5, 6, 7}) - Eigen::Vector3d(5, 6, 9)).norm(), 1e-3);
  EXPECT_EQ(placed.world.frame, "enu");
}

TEST(Placing, PlansForOtherPlacesAreRefused) {
  EXPECT_EQ(ProblemOf(MadePlan(2), MadeScene()), "");
  Plan far = MadePlan(2);
  far.origin.latitude_deg += 0.05;
  EXPECT_THAT(ProblemOf(far, MadeScene()), HasSubstr("another place"));
  Plan antipode = MadePlan(2);
  antipode.origin.latitude_deg = -50.1;
  EXPECT_THAT(ProblemOf(antipode, MadeScene()), HasSubstr("another place"));
}

TEST(Placing, ModelsThatAreNotWhatWasPlannedForAreRefused) {
  // All lie about their origin; only the walls tell them apart.
  Plan plan = MadePlan(2);
  plan.facades[0].a_m.x() += 30;
  plan.facades[0].b_m.x() += 30;
  EXPECT_THAT(ProblemOf(plan, MadeScene()), HasSubstr("0 of its 1 walls"));
  plan = MadePlan(2);
  std::swap(plan.facades[0].a_m, plan.facades[0].b_m);  // built on the wrong side
  EXPECT_THAT(ProblemOf(plan, MadeScene()), HasSubstr("0 of its 1 walls"));
  plan.facades.push_back(MadePlan(2).facades[0]);
  EXPECT_EQ(ProblemOf(plan, MadeScene()), "");  // half of them do
  plan.facades.clear();
  EXPECT_EQ(ProblemOf(plan, MadeScene()), "");
}

TEST(Placing, AModelInMillimetresOrKilometresIsRefusedWithAHint) {
  SceneShape small = MadeScene();
  small.box = Eigen::AlignedBox3d(Eigen::Vector3d(-0.1, -0.1, 0), Eigen::Vector3d(0.1, 0.1, 0.01));
  EXPECT_THAT(ProblemOf(MadePlan(2), small), HasSubstr("--unit"));
}

TEST(Placing, CamerasInsideHousesOrUnderGroundAreFound) {
  const SceneShape scene = MadeScene(10);
  EXPECT_EQ(WhyBlocked(scene, {6, -15, 15}), std::nullopt);
  EXPECT_EQ(WhyBlocked(scene, {6, 4, 25}), std::nullopt);
  EXPECT_EQ(WhyBlocked(scene, {6, 4, 13}), "stands inside B0001");
  EXPECT_EQ(WhyBlocked(scene, {6, -15, 9}), "is below the ground");
  EXPECT_EQ(WhyBlocked(scene, {500, 500, 5}), std::nullopt);  // beyond the ground's edge
}

TEST(Placing, CamerasInTheCrownsOfTreesAreFound) {
  SceneShape scene = MadeScene();
  scene.elements.push_back("occluder/tree-001");
  const Eigen::Vector3d crown(30, 0, 6);
  constexpr double kRadius = 3;
  // Leaves are seen from within and from outside: where a ray enters, else where it leaves.
  scene.cast = [=, without = scene.cast](const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& direction) {
    auto hit = without(from, direction);
    const double along = (crown - from).dot(direction);
    const double reach = kRadius * kRadius - ((crown - from).squaredNorm() - along * along);
    if (reach < 0) return hit;
    const double enters = along - std::sqrt(reach), leaves = along + std::sqrt(reach);
    const double distance = enters > 0 ? enters : leaves;
    if (distance > 0 && (!hit || distance < hit->distance)) {
      hit = RayHit{from + distance * direction, -direction, distance, 2};
    }
    return hit;
  };
  EXPECT_EQ(TreeInTheWay(scene, crown), "occluder/tree-001");
  EXPECT_EQ(TreeInTheWay(scene, crown + Eigen::Vector3d(2.5, 0, 0)), "occluder/tree-001");
  EXPECT_EQ(TreeInTheWay(scene, crown + Eigen::Vector3d(3.2, 0, 0)), "occluder/tree-001");
  EXPECT_EQ(TreeInTheWay(scene, crown + Eigen::Vector3d(3.5, 0, 0)), std::nullopt);
  EXPECT_EQ(TreeInTheWay(scene, {6, -15, 5}), std::nullopt);
  // The views there are lost, however many they are; the plan cannot know.
  Plan plan = MadePlan(20);
  for (int i = 0; i < 6; ++i) plan.views[i].position_m = crown;
  FlightOptions options;
  options.position_sigma_m = 0;
  const PreparedFlight prepared = PrepareFlight(plan, MadeSceneInfo(), scene, options);
  EXPECT_TRUE(prepared.flight.photos[5].lost);
  EXPECT_FALSE(prepared.flight.photos[6].lost);
  ASSERT_EQ(prepared.notes.size(), 6u);
  EXPECT_EQ(prepared.notes[0], "view h0000v0 stands in occluder/tree-001: no photo");
  // What the plan is blamed for is only what it could know.
  for (int i = 6; i < 9; ++i) plan.views[i].position_m = {6, 4, 3};
  try {
    PrepareFlight(plan, MadeSceneInfo(), scene, options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("3 of 20 views"));
    EXPECT_THAT(error.what(), HasSubstr("view h0003v0 stands inside B0001"));
  }
}

}  // namespace
}  // namespace stucco::simulate
