// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/align_to_map.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "survey/plan_frame.h"
#include "tests/calib/made_records.h"
#include "tests/site/made_plan.h"

namespace stucco::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// On the walls and, a tenth of them, anywhere before these.
std::vector<Vector3d> PointsOn(const std::vector<PlannedFacade>& walls) {
  std::vector<Vector3d> points;
  Random random(3);
  for (const PlannedFacade& wall : walls) {
    for (int i = 0; i < 100; ++i) {
      Vector2d level = wall.a_m + random.Uniform(0, wall.length_m()) * wall.along();
      if (i % 10 == 0) level += random.Uniform(0, 5) * wall.outwards();
      points.emplace_back(level.x(), level.y(), random.Uniform(0, 12));
    }
  }
  return points;
}

std::vector<PlannedFacade> Walls() {
  return TwoHouses().facades;
}

SiteMap MapOf(const std::vector<PlannedFacade>& walls) {
  return {walls, {}};
}

// Where the walls of both houses have their middle.
const Vector2d kMiddle{10, -15};

std::vector<Vector3d> Moved(std::vector<Vector3d> points, const Vector2d& shift, double turn_rad) {
  for (Vector3d& point : points) {
    point.head<2>() =
        Eigen::Rotation2Dd(turn_rad) * Vector2d(point.head<2>() - kMiddle) + kMiddle + shift;
  }
  return points;
}

TEST(AlignToWalls, FindsShiftAndTurn) {
  constexpr double kTurn_rad = 0.006;
  for (const Vector2d& off : {Vector2d(1.3, -0.7), Vector2d(-4.1, 3.2), Vector2d(0, 0)}) {
    const auto points = Moved(PointsOn(Walls()), off, kTurn_rad);
    const auto found = AlignToWalls(points, MapOf(Walls()));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->walls, 8);
    EXPECT_NEAR(found->turn_rad, -kTurn_rad, 0.002);
    EXPECT_LT(found->sigma_m, 0.05);
    double worst = 0;
    for (const PlannedFacade& wall : Walls()) {
      const Vector3d corner(wall.a_m.x(), wall.a_m.y(), 3);
      const Vector3d moved = Moved({corner}, off, kTurn_rad).front();
      worst = std::max(worst, (found->map_from_scene * moved - corner).norm());
    }
    EXPECT_LT(worst, 0.06);
  }
}

TEST(AlignToWalls, AWallThatTheMapHasElsewhereMovesNothing) {
  std::vector<PlannedFacade> drawn = Walls();
  drawn[0].a_m += 0.5 * drawn[0].outwards();
  drawn[0].b_m += 0.5 * drawn[0].outwards();
  const auto found = AlignToWalls(PointsOn(Walls()), MapOf(drawn));
  ASSERT_TRUE(found);
  EXPECT_LT(found->shift_m.norm(), 0.05);
}

TEST(AlignToWalls, RefusesWhatShowsNoWalls) {
  EXPECT_FALSE(AlignToWalls({}, MapOf(Walls())));
  EXPECT_FALSE(AlignToWalls(PointsOn(Walls()), {}));
  // Leaves all about.
  std::vector<Vector3d> scattered;
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    scattered.emplace_back(random.Uniform(-10, 30), random.Uniform(-50, 20), random.Uniform(0, 12));
  }
  EXPECT_FALSE(AlignToWalls(scattered, MapOf(Walls())));
}

TEST(AlignToWalls, RefusesWallsOfOneDirection) {
  std::vector<PlannedFacade> level = Walls();
  std::erase_if(level, [](const PlannedFacade& wall) { return std::abs(wall.along().x()) < 0.5; });
  ASSERT_EQ(level.size(), 4U);  // enough in number
  EXPECT_FALSE(AlignToWalls(PointsOn(level), MapOf(level)));
}

TEST(MoveToMap, TakesRecordsAlong) {
  Scene scene = MakeScene({.num_photos = 6});
  std::vector<PoseRecord> records = MakeRecords(scene, {});
  MapAlignment alignment;
  alignment.map_from_scene.rotation = Eigen::AngleAxisd(0.01, Vector3d::UnitZ());
  alignment.map_from_scene.translation = {3, -2, 0};
  const Scene scene_before = scene;
  const std::vector<PoseRecord> records_before = records;
  MoveToMap(alignment, records, scene);
  const Vector3d center = scene_before.photos[2].pose->Center();
  EXPECT_LT((scene.photos[2].pose->Center() - alignment.map_from_scene * center).norm(), 1e-9);
  for (size_t i = 0; i < records.size(); ++i) {
    const Pose& pose = *scene.photos[i].pose;
    const Pose& before = *scene_before.photos[i].pose;
    EXPECT_NEAR((records[i].position->position - pose.Center()).norm(),
                (records_before[i].position->position - before.Center()).norm(), 1e-9);
    EXPECT_NEAR(records[i].gimbal->angularDistance(pose.rotation),
                records_before[i].gimbal->angularDistance(before.rotation), 1e-9);
  }
  for (const SceneTrack& track : scene.tracks) {
    const SceneElement& e = track.elements.front();
    EXPECT_LT(ReprojectionError(scene, e, *track.position), 1e-6);
  }
}

TEST(MapInScene, BringsHeightsToTheSurveys) {
  Plan plan = TwoHouses();
  plan.origin = OriginNear({50.1, 14.4});
  Georef georef;
  georef.frame = "enu";
  const Geodetic place = GeodeticFromPlan(plan.origin, {100, 40});
  georef.origin_latitude_deg = place.latitude_deg;
  georef.origin_longitude_deg = place.longitude_deg;
  const Scene scene = MakeScene({.num_photos = 5});
  std::vector<std::optional<Pose>> expected;
  for (const ScenePhoto& photo : scene.photos) {
    const Vector3d above = photo.pose->Center() + Vector3d(0, 0, 250);
    expected.push_back(Pose{photo.pose->rotation, -(photo.pose->rotation * above)});
  }
  expected[1].reset();
  const SiteMap map = MapInScene(plan, georef, expected, scene);
  const std::vector<PlannedFacade>& walls = map.walls;
  ASSERT_EQ(walls.size(), plan.facades.size());
  EXPECT_LT((walls[0].a_m - (plan.facades[0].a_m - Vector2d(100, 40))).norm(), 0.01);
  EXPECT_NEAR(walls[0].z_m.from_m, plan.facades[0].z_m.from_m - 250, 1e-9);
  EXPECT_NEAR(walls[0].z_m.to_m, plan.facades[0].z_m.to_m - 250, 1e-9);
  const PlannedFootprint& footprint = map.footprints[0];
  EXPECT_LT((footprint.rings_m[0][0] - walls[0].a_m).norm(), 1e-9);
  EXPECT_EQ(footprint.z_m.from_m, walls[0].z_m.from_m);
}

}  // namespace
}  // namespace stucco::test
