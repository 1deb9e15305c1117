// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plan/baseline/oblique.h"
#include "plan/evaluate/evaluate_facades.h"
#include "plan/evaluate/target_all.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

TEST(TargetAllSeen, MakesEveryPhotoThatSeesAFacadeCount) {
  const Site site = MadeSite({Rectangle(0, 0, 12, 10)}, {.safe_altitude_m = 25, .heights_m = {9}});
  const CameraPreset camera = FindCamera("mavic-3e");
  std::vector<Hover> hovers = ObliqueViews(site, camera, {});
  TargetAllSeen(site, camera, 80, hovers, 2);
  for (const FacadeReport& report : EvaluateFacades(site, camera, 80, hovers, 1)) {
    EXPECT_GT(report.views, 10);
    EXPECT_NEAR(report.meant.q_s, report.all.q_s, 1e-9);
    EXPECT_NEAR(report.meant.q_d, report.all.q_d, 1e-9);
  }
}

}  // namespace
}  // namespace stucco::plan
