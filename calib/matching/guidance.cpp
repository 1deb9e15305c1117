// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/guidance.h"

#include <algorithm>
#include <optional>

#include "calib/expect/expected_poses.h"
#include "survey/files.h"
#include "survey/plan_of_survey.h"

namespace stucco {
namespace {

constexpr double kBeyondSight_m = 1;  // of what the photo should see is rectified too
constexpr int kWallPartners = 6;

// Along the wall and in height, what the photo should see of it.
WallView ViewOfWall(const Plan& plan, const ExpectedViews& views, int photo, int wall) {
  const PlannedFacade& facade = plan.facades[wall];
  const Eigen::Vector2d along = facade.along();
  WallView view{
      facade, {facade.length_m(), 0}, {facade.z_m.to_m, facade.z_m.from_m}, *views.poses[photo]};
  const auto include = [](double value, Interval& interval) {
    interval.from_m = std::min(interval.from_m, value);
    interval.to_m = std::max(interval.to_m, value);
  };
  for (const int point : views.seen[photo]) {
    const SurfaceSample& p = views.points[point];
    if (p.facade != wall) continue;
    include((p.position.head<2>() - facade.a_m).dot(along), view.along_m);
    include(p.position.z(), view.z_m);
  }
  view.along_m = {view.along_m.from_m - kBeyondSight_m, view.along_m.to_m + kBeyondSight_m};
  view.z_m = {view.z_m.from_m - kBeyondSight_m, view.z_m.to_m + kBeyondSight_m};
  return view;
}

}  // namespace

Guidance GuideByPlan(const CalibOptions& options, const Captures& captures,
                     const std::vector<const CapturedPhoto*>& photos, const StageContext& context) {
  Guidance guidance;
  const std::optional<Plan> plan = PlanOfSurvey(context);
  if (!plan) return guidance;
  guidance.facades = plan->facades;
  guidance.footprints = plan->footprints;
  ExpectInput input{*plan, ExpectedPoses(*plan, photos), {}};
  for (const CapturedPhoto* photo : photos) {
    input.cameras.push_back(&captures.cameras[photo->camera].intrinsics);
  }
  const ExpectedViews& views = guidance.views.emplace(ExpectViews(std::move(input), context));
  guidance.pairs = OverlappingPairs(views, options.neighbours, context.threads);
  guidance.wall_pairs = ObliqueWallPairs(views, kWallPartners, context.threads);
  for (const WallPair& pair : guidance.wall_pairs) {
    for (const int photo : {pair.first, pair.second}) {
      auto [place, is_new] = guidance.walls.try_emplace({photo, pair.wall});
      if (is_new) place->second = ViewOfWall(*plan, views, photo, pair.wall);
    }
  }
  return guidance;
}

}  // namespace stucco
