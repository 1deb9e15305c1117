// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/solids/soundness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <new>
#include <stdexcept>

#include "survey/error.h"

namespace stucco {
namespace {

using ::testing::HasSubstr;

Facet Square(double z) {
  Facet facet;
  facet.offset = z;
  facet.outer = {{0, 0, z}, {2, 0, z}, {2, 2, z}, {0, 2, z}};
  facet.area = 4;
  return facet;
}

Facet OffItsPlane() {
  Facet facet = Square(1);
  facet.outer[2].z() += 0.01;
  return facet;
}

TEST(FindFacetFault, NamesWhatIsWrong) {
  EXPECT_EQ(FindFacetFault(Square(3)), std::nullopt);
  EXPECT_THAT(*FindFacetFault(OffItsPlane()), HasSubstr("off the plane"));
  Facet facet = Square(1);
  facet.outer.resize(2);
  EXPECT_THAT(*FindFacetFault(facet), HasSubstr("2 vertices"));
  facet = Square(1);
  facet.outer[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(FindFacetFault(facet));
}

TEST(CloseOrExplain, KeepsASoundSolid) {
  const auto close = [] {
    Solid solid;
    solid.facets = {Square(0), Square(1)};
    solid.support = 0.9;
    return solid;
  };
  EXPECT_EQ(CloseOrExplain(close).facets.size(), 2u);
  EXPECT_EQ(CloseOrExplain(close).support, 0.9);
  EXPECT_TRUE(CloseOrExplain(close).why_not.empty());
}

TEST(CloseOrExplain, AFaultIsAReasonToStayOpen) {
  const auto why_not = [](const std::function<Solid()>& close) {
    const Solid solid = CloseOrExplain(close);
    EXPECT_TRUE(solid.facets.empty());
    return solid.why_not;
  };
  EXPECT_THAT(why_not([]() -> Solid { throw std::logic_error("assertion\nExpr: x > 0"); }),
              HasSubstr("its geometry fails: assertion"));
  EXPECT_THAT(why_not([]() -> Solid { throw Error(ErrorKind::kStageFailed, "fault"); }),
              HasSubstr("fault"));
  EXPECT_THAT(why_not([]() -> Solid { throw std::bad_alloc(); }), HasSubstr("memory"));
  EXPECT_THAT(why_not([] {
                Solid solid;
                solid.facets = {Square(0), OffItsPlane()};
                return solid;
              }),
              HasSubstr("off the plane"));
}

TEST(OutlineOrWarn, LeavesOutWhatIsUnsoundAndSaysSo) {
  std::vector<std::string> warnings;
  const auto outline = [] { return std::vector<Facet>{Square(0), OffItsPlane(), Square(2)}; };
  EXPECT_EQ(OutlineOrWarn(outline, warnings).size(), 2u);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("area 4"));
  EXPECT_TRUE(OutlineOrWarn([]() -> std::vector<Facet> { throw std::logic_error("no"); }, warnings)
                  .empty());
  EXPECT_EQ(warnings.size(), 2u);
}

}  // namespace
}  // namespace stucco
