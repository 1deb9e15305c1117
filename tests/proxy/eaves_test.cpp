// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/eaves.h"

#include <gtest/gtest.h>

#include "proxy/map/roof_cells.h"
#include "proxy/map/wall_facets.h"
#include "proxy/solids/written_check.h"
#include "survey/degree.h"
#include "tests/proxy/map_scene.h"

namespace stucco {
namespace {

constexpr double kEaves = 5;
const Tolerances kTolerances{.level_of_detail = 0.2,
                             .epsilon = 0.1,
                             .min_area = 1,
                             .fill_gap = 0.5,
                             .spacing = 0.1,
                             .radius = 0.3};

// How far a roof of the survey is off the one that stands there.
struct Off {
  double height = 0;
  double turn_deg = 0;  // of the direction it falls to
};

// Askew to the axes, so that corners in millimetres lie off their edges.
Eigen::Vector3d Askew(const Eigen::Vector3d& p) {
  return Eigen::AngleAxisd(34.7 * kDegree, Eigen::Vector3d::UnitZ()) * p;
}

Ring Outline() {
  Ring ring;
  for (const auto& p : test::HipLOutline()) ring.emplace_back(Askew({p.x(), p.y(), 0}).head<2>());
  return ring;
}

// An L under hip roofs with samples of each, the planes found a little off.
struct Survey {
  FittedBuilding building;
  RoofEvidence roof;
  std::vector<int> planes;
};

void AddRoof(test::TruePolygon polygon, const Off& off, Survey& survey) {
  for (auto& p : polygon.ring) p = Askew(p);
  const Eigen::Vector3d a = polygon.ring[0], b = polygon.ring[1], c = polygon.ring[2];
  const Eigen::Vector3d truth = (b - a).cross(c - a).normalized();
  Plane plane;
  plane.normal = Eigen::AngleAxisd(off.turn_deg * kDegree, Eigen::Vector3d::UnitZ()) * truth;
  Ring ring;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& p : polygon.ring) {
    ring.emplace_back(p.head<2>());
    middle += p / static_cast<double>(polygon.ring.size());
  }
  plane.offset = plane.normal.dot(middle + off.height * Eigen::Vector3d::UnitZ());
  for (double x = -8; x < 10; x += 0.1) {
    for (double y = 0; y < 19; y += 0.1) {
      if (!Contains(ring, {x, y})) continue;
      const double z = (truth.dot(a) - truth.x() * x - truth.y() * y) / truth.z();
      plane.points.push_back(static_cast<int>(survey.roof.samples.size()));
      survey.roof.samples.positions.emplace_back(x, y, z);
      survey.roof.samples.normals.push_back(truth);
      survey.roof.samples.weights.push_back(1);
      survey.roof.samples.cameras.push_back(-1);
    }
  }
  Measure(survey.roof.samples, 0.2, plane);
  survey.planes.push_back(static_cast<int>(survey.roof.planes.size()));
  survey.roof.planes.push_back(std::move(plane));
}

// `offs`: of the south, west, east hip, north hip, north and east roof of test::HipLHouse.
Survey Make(const std::vector<Off>& offs) {
  Survey survey;
  survey.building.building.parts = {Polygon{{Outline()}}};
  const Ring ring = Outline();
  for (size_t i = 0; i < ring.size(); ++i) {
    survey.building.edges.push_back(
        {.line = {ring[i], ring[(i + 1) % ring.size()]}, .facades = {}});
  }
  size_t roof = 0;
  for (const test::TruePolygon& polygon : test::HipLHouse(kEaves).polygons) {
    if (polygon.name != "wall") AddRoof(polygon, offs[roof++], survey);
  }
  return survey;
}

std::vector<RoofPlane> RoofsOf(const Survey& survey) {
  std::vector<RoofPlane> roofs;
  for (const Plane& plane : survey.roof.planes) {
    roofs.push_back({.slope = -plane.normal.head<2>() / plane.normal.z(),
                     .height = plane.offset / plane.normal.z()});
  }
  return roofs;
}

std::vector<RoofPlane> Levelled(const Survey& survey) {
  std::vector<RoofPlane> roofs = RoofsOf(survey);
  LevelEaves(survey.building, survey.roof, survey.planes, kTolerances, roofs);
  return roofs;
}

constexpr Off kFaults[] = {{0, 0.01},     {0.0022, -0.02}, {0.0024, 0},
                           {0.003, 0.01}, {-0.001, 0},     {0.0007, -0.01}};
const std::vector<Off> kAlmostTrue(std::begin(kFaults), std::end(kFaults));

TEST(LevelEaves, HipsAndValleysRunThroughTheCorners) {
  const Survey survey = Make(kAlmostTrue);
  const auto roofs = Levelled(survey);
  const Ring ring = Outline();
  // Of each corner the two roofs whose hip or valley leaves it.
  constexpr size_t kMeeting[][2] = {{0, 1}, {0, 2}, {2, 4}, {4, 5}, {5, 3}, {3, 1}};
  for (size_t c = 0; c < ring.size(); ++c) {
    EXPECT_NEAR(roofs[kMeeting[c][0]].At(ring[c]), roofs[kMeeting[c][1]].At(ring[c]), 1e-9);
    EXPECT_NEAR(roofs[kMeeting[c][0]].At(ring[c]), kEaves, 0.003);
  }
}

TEST(LevelEaves, ASolidWhoseValleyMissesItsCornerByHairsCanBeWritten) {
  for (const double off_m : {-0.0004, -0.0002, 0.0002, 0.0004}) {
    std::vector<Off> offs(6);
    offs[4].turn_deg = 0.005;
    offs[5].height = off_m;
    const Survey survey = Make(offs);
    const RoofCells cells = LabelRoof(survey.building, survey.roof, survey.planes, kTolerances);
    const auto faces = ExtrudeCells(cells.arrangement, cells.lines,
                                    {.labels = cells.labels, .roofs = cells.roofs});
    const auto facets = FacetsOf(faces, survey.building, survey.roof.samples, kTolerances, 25);
    EXPECT_EQ(FindFaultAsWritten(facets, Eigen::Matrix3d::Identity()), std::nullopt) << off_m;
    // Six walls, six roofs and the floor, as they were built.
    EXPECT_EQ(facets.size(), 13U);
  }
}

TEST(LevelEaves, EavesOfDifferentHeightsStay) {
  std::vector<Off> offs(6);
  offs[1].height = 0.3;
  const auto before = RoofsOf(Make(offs)), after = Levelled(Make(offs));
  for (size_t k = 0; k < before.size(); ++k) {
    EXPECT_NEAR(after[k].height, before[k].height, 1e-9) << k;
    EXPECT_NEAR((after[k].slope - before[k].slope).norm(), 0, 1e-9) << k;
  }
}

TEST(LevelEaves, RoofsThatFallAskewStay) {
  std::vector<Off> offs(6);
  offs[0].turn_deg = 1.5;  // its samples would move by a tenth of a metre
  const auto before = RoofsOf(Make(offs)), after = Levelled(Make(offs));
  EXPECT_NEAR((after[0].slope - before[0].slope).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace stucco
