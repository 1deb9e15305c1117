// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "site/surface_samples.h"
#include "survey/camera.h"
#include "survey/occluders.h"
#include "survey/plan.h"
#include "survey/pose.h"
#include "survey/stage.h"

namespace stucco {

// What the photos should show of the site, from their expected poses.
struct ExpectedViews {
  std::vector<std::optional<Pose>> poses;  // cam_from_plan
  std::vector<SurfaceSample> points;
  // Per photo: indices of the points it should see, ascending. Empty without an expected pose.
  std::vector<std::vector<int>> seen;
  Occluders site;  // buildings and ground
};

struct ExpectInput {
  const Plan& plan;
  std::vector<std::optional<Pose>> poses;  // cam_from_plan
  std::vector<const Camera*> cameras;      // per photo
};

// Points that project into the photo, turn towards it, and are hidden by no building.
ExpectedViews ExpectViews(ExpectInput input, const StageContext& context);

// Pairs (a, b), a < b, ascending: of each photo, the `count` others that should share most of what
// it sees under angles and scales that features match at.
std::vector<std::pair<int, int>> OverlappingPairs(const ExpectedViews& views, int count,
                                                  int threads);

// A pair of photos that should both show a part of one wall, and at least one of them so obliquely
// that features only match once the wall is rectified.
struct WallPair {
  int first = 0;  // photos, first < second
  int second = 0;
  int wall = 0;                                       // index into Plan::facades
  auto operator<=>(const WallPair&) const = default;  // NOLINT(modernize-use-nullptr)
};

// Of each photo and each of the eight walls it sees most of, up to `count` partners that see it
// from another direction: those that share most of it. Of pairs in which both see it obliquely only
// a third as many: there are many of them, and they tie to each other as they are. Ascending.
std::vector<WallPair> ObliqueWallPairs(const ExpectedViews& views, int count, int threads);

}  // namespace stucco
