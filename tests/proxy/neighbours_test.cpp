// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/neighbours.h"

#include <gtest/gtest.h>

#include "proxy/map/move_edges.h"
#include "proxy/map/upright_survey.h"

namespace stucco {
namespace {

constexpr double kSigma_m = 0.5;

// A box whose edges, from the southern one counter-clockwise, points hold or not.
FittedBuilding HeldBox(double west, double east, const std::vector<bool>& held) {
  FittedBuilding box;
  const Ring ring = {{west, 0}, {east, 0}, {east, 10}, {west, 10}};
  box.building.parts = {{{ring}}};
  for (size_t i = 0; i < 4; ++i) {
    FittedEdge& edge = box.edges.emplace_back();
    edge.line = {ring[i], ring[(i + 1) % 4]};
    edge.fitted = held[i];
  }
  return box;
}

const std::vector<bool> kAllHeld = {true, true, true, true};
const std::vector<bool> kEastNotHeld = {true, false, true, true};
const std::vector<bool> kWestNotHeld = {true, true, true, false};

UprightSurvey Nothing() {
  return UprightSurveyOf(Samples{}, {.spacing = 0.1}, Eigen::Vector3d::UnitZ());
}

// The ground, between two walls only.
UprightSurvey GroundBetween(double west, double east) {
  Samples samples;
  for (double x = west + 0.05; x < east; x += 0.1) {
    for (double y = 0.05; y < 10; y += 0.1) {
      samples.positions.emplace_back(x, y, 0);
      samples.normals.emplace_back(0, 0, 1);
      samples.weights.push_back(1);
      samples.cameras.push_back(-1);
    }
  }
  return UprightSurveyOf(std::move(samples), {.spacing = 0.1}, Eigen::Vector3d::UnitZ());
}

double EastOf(const FittedBuilding& building) {
  return BoundsOf(building.building.parts.front()).max().x();
}
double WestOf(const FittedBuilding& building) {
  return BoundsOf(building.building.parts.front()).min().x();
}

TEST(MeetNeighbours, WhatNobodySeesGoesToWhatIsSeen) {
  for (const double gap : {-0.9, 0.9}) {
    std::vector<FittedBuilding> houses = {HeldBox(-8, 0, kAllHeld), HeldBox(gap, 9, kWestNotHeld)};
    MeetNeighbours(Nothing(), kSigma_m, houses);
    EXPECT_DOUBLE_EQ(EastOf(houses[0]), 0) << gap;
    EXPECT_NEAR(WestOf(houses[1]), 0, 1e-9) << gap;
    EXPECT_NEAR(Area(houses[1].building), 90, 1e-9) << gap;
    EXPECT_NEAR(houses[1].edges[3].line.a.x(), 0, 1e-9);
    EXPECT_DOUBLE_EQ(EastOf(houses[1]), 9);
  }
}

TEST(MeetNeighbours, HalfWayWhereNobodySeesEither) {
  std::vector<FittedBuilding> houses = {HeldBox(-8, 0.4, kEastNotHeld),
                                        HeldBox(-0.4, 9, kWestNotHeld)};
  MeetNeighbours(Nothing(), kSigma_m, houses);
  EXPECT_NEAR(EastOf(houses[0]), 0, 1e-3);
  EXPECT_NEAR(WestOf(houses[1]), EastOf(houses[0]), 1e-3);
}

TEST(MeetNeighbours, WallsThatAreSeenStay) {
  std::vector<FittedBuilding> houses = {HeldBox(-8, 0, kAllHeld), HeldBox(0.7, 9, kAllHeld)};
  MeetNeighbours(Nothing(), kSigma_m, houses);
  EXPECT_DOUBLE_EQ(EastOf(houses[0]), 0);
  EXPECT_DOUBLE_EQ(WestOf(houses[1]), 0.7);
}

TEST(MeetNeighbours, AlleysStayOpen) {
  // The ground shows in it.
  std::vector<FittedBuilding> houses = {HeldBox(-8, 0, kAllHeld), HeldBox(1, 9, kWestNotHeld)};
  MeetNeighbours(GroundBetween(0, 1), kSigma_m, houses);
  EXPECT_DOUBLE_EQ(WestOf(houses[1]), 1);
  // The map is too good for such an error.
  MeetNeighbours(Nothing(), 0.05, houses);
  EXPECT_DOUBLE_EQ(WestOf(houses[1]), 1);
  // Neither.
  MeetNeighbours(Nothing(), kSigma_m, houses);
  EXPECT_NEAR(WestOf(houses[1]), 0, 1e-9);
}

TEST(WithEdgesMoved, MovesEdgesOutwardsAndRefusesWhatCrossesItself) {
  const Polygon square{{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}};
  const auto moved =
      WithEdgesMoved(square, std::vector<EdgeMove>{{0, 0}, {1, 1}, {0.5, 0.5}, {0, 0}});
  ASSERT_TRUE(moved);
  EXPECT_DOUBLE_EQ(Area(*moved), 5 * 4.5);
  EXPECT_FALSE(WithEdgesMoved(square, std::vector<EdgeMove>{{}, {-5, -5}, {}, {}}));
  EXPECT_FALSE(WithEdgesMoved(square, std::vector<EdgeMove>{{}, {-2.5, -2.5}, {}, {}}));
}

TEST(WithEdgesMoved, TurnsEdgesThatMoveByMoreAtOneEnd) {
  const Polygon square{{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}};
  const auto moved = WithEdgesMoved(square, std::vector<EdgeMove>{{}, {0, 0.5}, {}, {}});
  ASSERT_TRUE(moved);
  EXPECT_LT((moved->rings[0][1] - Eigen::Vector2d(4, 0)).norm(), 1e-9);
  EXPECT_LT((moved->rings[0][2] - Eigen::Vector2d(4.5, 4)).norm(), 1e-9);
  EXPECT_LT((moved->rings[0][3] - Eigen::Vector2d(0, 4)).norm(), 1e-9);
}

}  // namespace
}  // namespace stucco
