// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/solids/written_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "proxy/solids/closed_check.h"

namespace stucco {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::Optional;

const Eigen::Matrix3d kLevel = Eigen::Matrix3d::Identity();

Facet MakeFacet(std::vector<Vector3d> ring) {
  Facet facet;
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    facet.normal += (ring[i] - ring[0]).cross(ring[i + 1] - ring[0]);
  }
  facet.normal = (facet.normal - Vector3d::UnitZ()).normalized();  // from UnitZ on
  facet.offset = facet.normal.dot(ring[0]);
  facet.outer = std::move(ring);
  return facet;
}

// An upright prism over a ring that is counter-clockwise seen from above.
std::vector<Facet> Prism(const std::vector<Eigen::Vector2d>& ring, double low, double high) {
  std::vector<Facet> facets;
  std::vector<Vector3d> floor, roof;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &p = ring[i], &q = ring[(i + 1) % ring.size()];
    roof.emplace_back(p.x(), p.y(), high);
    floor.emplace(floor.begin(), p.x(), p.y(), low);
    facets.push_back(MakeFacet(
        {{p.x(), p.y(), low}, {q.x(), q.y(), low}, {q.x(), q.y(), high}, {p.x(), p.y(), high}}));
  }
  facets.push_back(MakeFacet(roof));
  facets.push_back(MakeFacet(floor));
  return facets;
}

TEST(FindFaultAsWritten, ABoxHasNone) {
  const auto box = Prism({{0, 0}, {8, 0}, {8, 5}, {0, 5}}, 0, 4);
  EXPECT_EQ(FindFault(box), std::nullopt);
  EXPECT_EQ(FindFaultAsWritten(box, kLevel), std::nullopt);
}

TEST(FindFaultAsWritten, CornersThatFallTogetherAreOne) {
  // A step of 0.2 mm in the outline vanishes, and its wall with it.
  const auto box = Prism({{0, 0}, {4, 0}, {4, 0.0002}, {8, 0.0002}, {8, 5}, {0, 5}}, 0, 4);
  EXPECT_EQ(Rounded(box, 0.001).size(), box.size() - 1);
  EXPECT_EQ(FindFaultAsWritten(box, kLevel), std::nullopt);
}

TEST(FindFaultAsWritten, SeesWhatMillimetresPinchOff) {
  // Two halves that a neck of 0.4 mm joins: closed as they are, not as written.
  const auto neck = Prism({{0, 0}, {4, 2}, {8, 0}, {8, 5}, {4, 2.0004}, {0, 5}}, 0, 4);
  EXPECT_EQ(FindOpening(neck), std::nullopt);
  EXPECT_THAT(FindFaultAsWritten(neck, kLevel),
              Optional(HasSubstr("in millimetres a ring passes a corner twice")));
}

TEST(FindFault, SeesABentFacet) {
  auto box = Prism({{0, 0}, {8, 0}, {8, 5}, {0, 5}}, 0, 4);
  for (Facet& facet : box) {
    for (Vector3d& p : facet.outer) {
      if (p == Vector3d(8, 5, 4)) p.z() += 0.03;  // closed all the same
    }
  }
  EXPECT_EQ(FindOpening(box), std::nullopt);
  EXPECT_THAT(FindFault(box), Optional(HasSubstr("not planar")));
}

TEST(FindFault, SeesAnOpening) {
  auto box = Prism({{0, 0}, {8, 0}, {8, 5}, {0, 5}}, 0, 4);
  box.pop_back();
  EXPECT_THAT(FindFault(box), Optional(HasSubstr("open at an edge")));
}

}  // namespace
}  // namespace stucco
