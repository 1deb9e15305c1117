// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/make_plan.h"

#include <gtest/gtest.h>

#include <vector>

#include "site/site_of_plan.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

Plan ObliquePlan(const Site& site) {
  PlanOptions options;
  options.method = "oblique";
  options.forward_overlap = 0.5;
  options.side_overlap = 0.5;
  return MakePlan(site, options, 1, SilentProgress()).plan;
}

TEST(MakePlan, TellsTheSiteThatItWasMadeFor) {
  const Polygon zone{{Rectangle(60, 40, 80, 60), Reversed(Rectangle(66, 46, 74, 54))}};
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 12), Rectangle(35, 0, 50, 25)},
                             {.safe_altitude_m = 30, .heights_m = {8, 0}, .no_fly = {zone}});
  const Site told = SiteOfPlan(ObliquePlan(site));
  EXPECT_EQ(told.crs, site.crs);
  EXPECT_EQ(told.home, site.home);
  EXPECT_EQ(told.d_min_m, site.d_min_m);
  ASSERT_EQ(told.no_fly.size(), 1U);
  EXPECT_EQ(told.no_fly[0].rings, zone.rings);
  ASSERT_EQ(told.footprints.size(), site.footprints.size());
  for (size_t i = 0; i < site.footprints.size(); ++i) {
    EXPECT_EQ(told.footprints[i].building, site.footprints[i].building);
    EXPECT_EQ(told.footprints[i].outline.rings, site.footprints[i].outline.rings);
    EXPECT_EQ(told.footprints[i].z_m, site.footprints[i].z_m);
    EXPECT_EQ(told.footprints[i].top_known, site.footprints[i].top_known);
    EXPECT_EQ(told.footprints[i].blocked_to_m, site.footprints[i].blocked_to_m);
    EXPECT_TRUE(told.footprints[i].in_area);
  }
  ASSERT_EQ(told.facades.size(), site.facades.size());
  for (size_t i = 0; i < site.facades.size(); ++i) {
    EXPECT_EQ(told.facades[i].id, site.facades[i].id);
    EXPECT_EQ(told.facades[i].footprint, site.facades[i].footprint);
    EXPECT_EQ(told.facades[i].a, site.facades[i].a);
    EXPECT_EQ(told.facades[i].z_m, site.facades[i].z_m);
  }
}

}  // namespace
}  // namespace stucco::plan
