// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/expected_views.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <set>

#include "calib/expect/project_inside.h"
#include "site/incidence.h"
#include "site/sightings.h"
#include "site/site_model.h"
#include "site/site_of_plan.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kSpacing_m = 2;
constexpr double kGroundReach_m = 30;
constexpr double kOffSurface_m = 0.05;  // a line of sight to a photo begins at the point
// Farther than this multiple of the farthest distance that the plan counts on, photos show the site
// too small for its features to match.
constexpr double kReach = 4;
constexpr double kLeastReach_m = 100;
constexpr double kMostReach_m = 1000;
const double kLeastFacing = std::cos(kMaxShownIncidence_rad);
// SIFT matches about these changes of direction and scale (Mikolajczyk et al. 2005).
const double kAlikeDirection = std::cos(50 * kRadians);
constexpr double kAlikeScale = 3;
// Seen from farther off the normal, a wall matches better once it is rectified.
const double kFrontal = std::cos(35 * kRadians);
constexpr double kAlikeScaleOfWalls = 8;
// Photos from directions nearer to each other than this show it alike, rectified or not.
const double kSameDirection = std::cos(25 * kRadians);
// More walls of one photo are too small in it to add anything, and each costs a search.
constexpr size_t kWallsOfPhoto = 8;
// Fewer common points are chance.
constexpr int kLeastShared = 6;
constexpr double kLeastShare = 0.05;  // of what the photo sees

std::vector<int> SeenBy(const Pose& pose, const Camera& camera,
                        const std::vector<SurfaceSample>& points,
                        const std::vector<uint32_t>& candidates, const Occluders& site) {
  const Eigen::Vector3d center = pose.Center();
  std::vector<int> seen;
  for (const uint32_t i : candidates) {
    const SurfaceSample& point = points[i];
    const Eigen::Vector3d way = center - point.position;
    if (way.dot(point.normal) < kLeastFacing * way.norm() ||
        !ProjectInside(camera, pose * point.position) || site.Block(point.position, way, 1)) {
      continue;
    }
    seen.push_back(static_cast<int>(i));
  }
  std::sort(seen.begin(), seen.end());
  return seen;
}

// How a photo sees a point.
struct Sight {
  Eigen::Vector3d way = Eigen::Vector3d::Zero();  // unit, from the point to the camera
  double distance_m = 0;
};

// Who sees what, from both sides.
class Sights {
 public:
  explicit Sights(const ExpectedViews& views) : views_(views), photos_of_(views.points.size()) {
    for (size_t photo = 0; photo < views.seen.size(); ++photo) {
      centers_.push_back(views.poses[photo] ? views.poses[photo]->Center()
                                            : Eigen::Vector3d::Zero());
      for (const int point : views.seen[photo])
        photos_of_[point].push_back(static_cast<int>(photo));
    }
  }
  const std::vector<int>& PhotosOf(int point) const { return photos_of_[point]; }
  Sight Of(int photo, int point) const {
    const Eigen::Vector3d way = centers_[photo] - views_.points[point].position;
    const double distance_m = way.norm();
    return {way / distance_m, distance_m};
  }

 private:
  const ExpectedViews& views_;
  std::vector<Eigen::Vector3d> centers_;
  std::vector<std::vector<int>> photos_of_;
};

double ScaleChange(const Sight& a, const Sight& b) {
  return std::max(a.distance_m / b.distance_m, b.distance_m / a.distance_m);
}

// The `count` photos with most of the `shared` points (by photo), at least `least`; of equal ones
// the first.
std::vector<int> Best(const std::vector<int>& shared, int least, int count) {
  std::vector<std::pair<int, int>> order;  // (-points, photo)
  for (size_t photo = 0; photo < shared.size(); ++photo) {
    if (shared[photo] >= least) order.emplace_back(-shared[photo], static_cast<int>(photo));
  }
  std::sort(order.begin(), order.end());
  if (static_cast<int>(order.size()) > count) order.resize(count);
  std::vector<int> best;
  best.reserve(order.size());
  for (const auto& [points, photo] : order) best.push_back(photo);
  return best;
}

// The area that photos within `reach_m` may show.
Eigen::AlignedBox2d AreaOf(const std::vector<std::optional<Pose>>& poses, double reach_m) {
  Eigen::AlignedBox2d area;
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(reach_m);
  for (const auto& pose : poses) {
    if (!pose) continue;
    const Eigen::Vector2d place = pose->Center().head<2>();
    area.extend(Eigen::AlignedBox2d(place - reach, place + reach));
  }
  return area;
}

// Where the points of one wall begin and end in `seen` of a photo.
struct WallRange {
  int wall = 0;
  size_t begin = 0;
  size_t end = 0;
};

// The walls that a photo shows most of, at most kWallsOfPhoto; ascending.
std::vector<WallRange> WallsOf(const ExpectedViews& views, size_t photo) {
  std::vector<WallRange> walls;
  const std::vector<int>& seen = views.seen[photo];
  for (size_t i = 0; i < seen.size(); ++i) {
    const int wall = views.points[seen[i]].facade;
    if (wall < 0) continue;
    if (walls.empty() || walls.back().wall != wall) walls.push_back({wall, i, i});
    walls.back().end = i + 1;
  }
  std::stable_sort(walls.begin(), walls.end(), [](const WallRange& a, const WallRange& b) {
    return a.end - a.begin > b.end - b.begin;
  });
  if (walls.size() > kWallsOfPhoto) walls.resize(kWallsOfPhoto);
  std::sort(walls.begin(), walls.end(),
            [](const WallRange& a, const WallRange& b) { return a.wall < b.wall; });
  return walls;
}

// The points of one wall that a photo shares with each of the others, by photo.
struct SharedOfWall {
  std::vector<int> with_frontal;  // one of the two sees them frontally
  std::vector<int> with_oblique;  // neither
};

SharedOfWall SharedOn(const WallRange& wall, const ExpectedViews& views, const Sights& sights,
                      int photo) {
  SharedOfWall shared{std::vector<int>(views.seen.size(), 0),
                      std::vector<int>(views.seen.size(), 0)};
  for (size_t i = wall.begin; i < wall.end; ++i) {
    const int point = views.seen[photo][i];
    const Eigen::Vector3d& normal = views.points[point].normal;
    const Sight sight = sights.Of(photo, point);
    const bool is_frontal = sight.way.dot(normal) > kFrontal;
    for (const int b : sights.PhotosOf(point)) {
      const Sight other = sights.Of(b, point);
      const bool other_frontal = other.way.dot(normal) > kFrontal;
      if (photo == b || (is_frontal && other_frontal)) continue;
      if (sight.way.dot(other.way) > kSameDirection) continue;
      if (ScaleChange(sight, other) > kAlikeScaleOfWalls) continue;
      ++(is_frontal || other_frontal ? shared.with_frontal : shared.with_oblique)[b];
    }
  }
  return shared;
}

}  // namespace

ExpectedViews ExpectViews(ExpectInput input, const StageContext& context) {
  assert(input.poses.size() == input.cameras.size());
  const Site site = SiteOfPlan(input.plan);
  const double reach_m =
      std::clamp(kReach * std::max(input.plan.safe_altitude_m, input.plan.d_max_m), kLeastReach_m,
                 kMostReach_m);
  std::vector<SurfaceSample> points = SampleSurface(site, {.spacing_m = kSpacing_m,
                                                           .never_farther = true,
                                                           .fewest_rows = 1,
                                                           .ground_reach_m = kGroundReach_m,
                                                           .off_surface_m = kOffSurface_m,
                                                           .within = AreaOf(input.poses, reach_m)});
  ExpectedViews views{std::move(input.poses), std::move(points), {}, OccludersOf(site)};
  views.seen.resize(views.poses.size());
  const SampleIndex index(views.points, reach_m / 4);
  ParallelFor(views.poses.size(), context.threads, [&](size_t i) {
    const auto& pose = views.poses[i];
    if (!pose) return;
    views.seen[i] = SeenBy(*pose, *input.cameras[i], views.points,
                           index.Near(pose->Center().head<2>(), reach_m), views.site);
  });
  return views;
}

std::vector<std::pair<int, int>> OverlappingPairs(const ExpectedViews& views, int count,
                                                  int threads) {
  const Sights sights(views);
  std::vector<std::vector<int>> partners(views.seen.size());
  ParallelFor(views.seen.size(), threads, [&](size_t photo) {
    const int a = static_cast<int>(photo);
    std::vector<int> shared(views.seen.size(), 0);
    for (const int point : views.seen[photo]) {
      const Sight sight = sights.Of(a, point);
      for (const int b : sights.PhotosOf(point)) {
        const Sight other = sights.Of(b, point);
        shared[b] += b != a && sight.way.dot(other.way) >= kAlikeDirection &&
                     ScaleChange(sight, other) < kAlikeScale;
      }
    }
    const double share = kLeastShare * static_cast<double>(views.seen[photo].size());
    partners[photo] = Best(shared, std::max(kLeastShared, static_cast<int>(share)), count);
  });
  std::set<std::pair<int, int>> pairs;
  for (int a = 0; a < static_cast<int>(partners.size()); ++a) {
    for (const int b : partners[a]) pairs.emplace(std::min(a, b), std::max(a, b));
  }
  return {pairs.begin(), pairs.end()};
}

std::vector<WallPair> ObliqueWallPairs(const ExpectedViews& views, int count, int threads) {
  const Sights sights(views);
  std::vector<std::vector<WallPair>> of_photo(views.seen.size());
  ParallelFor(views.seen.size(), threads, [&](size_t photo) {
    const int a = static_cast<int>(photo);
    for (const WallRange& wall : WallsOf(views, photo)) {
      const SharedOfWall shared = SharedOn(wall, views, sights, a);
      std::vector<int> partners = Best(shared.with_frontal, kLeastShared, count);
      const std::vector<int> more = Best(shared.with_oblique, kLeastShared, count / 3);
      partners.insert(partners.end(), more.begin(), more.end());
      for (const int b : partners) {
        of_photo[photo].push_back({std::min(a, b), std::max(a, b), wall.wall});
      }
    }
  });
  std::set<WallPair> pairs;
  for (const auto& each : of_photo) pairs.insert(each.begin(), each.end());
  return {pairs.begin(), pairs.end()};
}

}  // namespace stucco
