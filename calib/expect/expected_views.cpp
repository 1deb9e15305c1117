// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/expected_views.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr double kRadians = M_PI / 180;
constexpr double kSpacing_m = 2;
// Farther than this multiple of the farthest distance that the plan counts on, photos show the site
// too small for its features to match.
constexpr double kReach = 4;
// A surface seen at a flatter angle shows nothing that matches.
const double kLeastFacing = std::cos(80 * kRadians);
// SIFT matches about these changes of direction and scale (Mikolajczyk et al. 2005).
const double kAlikeDirection = std::cos(50 * kRadians);
constexpr double kAlikeScale = 3;
// Seen from farther off the normal, a wall matches better once it is rectified.
const double kFrontal = std::cos(35 * kRadians);
constexpr double kAlikeScaleOfWalls = 8;
// Fewer common points are chance.
constexpr int kLeastShared = 6;
constexpr double kLeastShare = 0.05;  // of what the photo sees

// Points by square cells of the ground plan.
class PointGrid {
 public:
  PointGrid(const std::vector<SitePoint>& points, double cell_m) : cell_m_(cell_m) {
    for (size_t i = 0; i < points.size(); ++i) {
      cells_[CellOf(points[i].position.head<2>())].push_back(static_cast<int>(i));
    }
  }
  // Points of all cells that reach into the square around `place`, in no order.
  std::vector<int> Near(const Eigen::Vector2d& place, double reach_m) const {
    const auto low = CellOf(place.array() - reach_m);
    const auto high = CellOf(place.array() + reach_m);
    std::vector<int> found;
    for (int x = low.first; x <= high.first; ++x) {
      for (auto cell = cells_.lower_bound({x, low.second});
           cell != cells_.end() && cell->first <= std::pair(x, high.second); ++cell) {
        found.insert(found.end(), cell->second.begin(), cell->second.end());
      }
    }
    return found;
  }

 private:
  std::pair<int, int> CellOf(const Eigen::Vector2d& place) const {
    return {static_cast<int>(std::floor(place.x() / cell_m_)),
            static_cast<int>(std::floor(place.y() / cell_m_))};
  }
  double cell_m_;
  std::map<std::pair<int, int>, std::vector<int>> cells_;
};

bool InPicture(const Camera& camera, const Eigen::Vector3d& in_cam) {
  if (in_cam.z() <= 0 || !camera.IsInvertibleAt(in_cam.hnormalized())) return false;
  const auto pixel = camera.Project(in_cam);
  return pixel && camera.Contains(*pixel);
}

std::vector<int> SeenBy(const Pose& pose, const Camera& camera,
                        const std::vector<SitePoint>& points, std::vector<int> candidates,
                        const Occluders& site) {
  const Eigen::Vector3d center = pose.Center();
  std::erase_if(candidates, [&](int i) {
    const Eigen::Vector3d way = center - points[i].position;
    return way.dot(points[i].normal) < kLeastFacing * way.norm() ||
           !InPicture(camera, pose * points[i].position) || site.Block(points[i].position, way, 1);
  });
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

// How a photo sees a point.
struct Sight {
  int photo = 0;
  Eigen::Vector3d way = Eigen::Vector3d::Zero();  // unit, from the point to the camera
  double distance_m = 0;
};

// Calls `fn(point, sights)` for every point that at least two photos should see.
template <typename Fn>
void ForEachShared(const ExpectedViews& views, const Fn& fn) {
  std::vector<std::vector<Sight>> sights(views.points.size());
  for (size_t photo = 0; photo < views.seen.size(); ++photo) {
    if (!views.poses[photo]) continue;
    const Eigen::Vector3d center = views.poses[photo]->Center();
    for (const int point : views.seen[photo]) {
      const Eigen::Vector3d way = center - views.points[point].position;
      const double distance = way.norm();
      sights[point].push_back({static_cast<int>(photo), way / distance, distance});
    }
  }
  for (size_t point = 0; point < sights.size(); ++point) {
    if (sights[point].size() > 1) fn(views.points[point], sights[point]);
  }
}

double ScaleChange(const Sight& a, const Sight& b) {
  return std::max(a.distance_m / b.distance_m, b.distance_m / a.distance_m);
}

// The `count` of `partners` (photo -> common points) with most of them; of equal ones the first.
std::vector<int> Best(const std::map<int, int>& partners, int least, int count) {
  std::vector<std::pair<int, int>> order;  // (-points, photo)
  for (const auto& [photo, shared] : partners) {
    if (shared >= least) order.emplace_back(-shared, photo);
  }
  std::sort(order.begin(), order.end());
  if (static_cast<int>(order.size()) > count) order.resize(count);
  std::vector<int> best;
  for (const auto& [shared, photo] : order) best.push_back(photo);
  return best;
}

}  // namespace

ExpectedViews ExpectViews(ExpectInput input, const StageContext& context) {
  const SiteMesh mesh = MeshOfSite(input.plan);
  ExpectedViews views{std::move(input.poses),
                      SampleSite(input.plan, kSpacing_m),
                      {},
                      Occluders(mesh.vertices, mesh.triangles)};
  views.seen.resize(views.poses.size());
  const double reach_m = kReach * std::max(input.plan.safe_altitude_m, input.plan.d_max_m);
  const PointGrid grid(views.points, reach_m / 4);
  ParallelFor(views.poses.size(), context.threads, [&](size_t i) {
    const auto& pose = views.poses[i];
    if (!pose) return;
    views.seen[i] = SeenBy(*pose, *input.cameras[i], views.points,
                           grid.Near(pose->Center().head<2>(), reach_m), views.site);
  });
  return views;
}

std::vector<std::pair<int, int>> OverlappingPairs(const ExpectedViews& views, int count) {
  std::vector<std::map<int, int>> partners(views.seen.size());
  ForEachShared(views, [&](const SitePoint&, const std::vector<Sight>& sights) {
    for (const Sight& a : sights) {
      for (const Sight& b : sights) {
        if (a.photo == b.photo || a.way.dot(b.way) < kAlikeDirection) continue;
        if (ScaleChange(a, b) < kAlikeScale) ++partners[a.photo][b.photo];
      }
    }
  });
  std::set<std::pair<int, int>> pairs;
  for (size_t photo = 0; photo < partners.size(); ++photo) {
    const int a = static_cast<int>(photo);
    const int least =
        std::max(kLeastShared,
                 static_cast<int>(kLeastShare * static_cast<double>(views.seen[photo].size())));
    for (const int b : Best(partners[photo], least, count)) {
      pairs.emplace(std::min(a, b), std::max(a, b));
    }
  }
  return {pairs.begin(), pairs.end()};
}

std::vector<WallPair> ObliqueWallPairs(const ExpectedViews& views, int count) {
  // Common points by (photo, wall), with frontal and oblique partners apart.
  std::map<std::pair<int, int>, std::array<std::map<int, int>, 2>> partners;
  ForEachShared(views, [&](const SitePoint& point, const std::vector<Sight>& sights) {
    if (point.wall < 0) return;
    for (const Sight& a : sights) {
      const bool a_frontal = a.way.dot(point.normal) > kFrontal;
      for (const Sight& b : sights) {
        const bool b_frontal = b.way.dot(point.normal) > kFrontal;
        if (a.photo == b.photo || (a_frontal && b_frontal)) continue;
        if (ScaleChange(a, b) > kAlikeScaleOfWalls) continue;
        ++partners[{a.photo, point.wall}][b_frontal ? 0 : 1][b.photo];
      }
    }
  });
  std::set<WallPair> pairs;
  for (const auto& [photo_and_wall, by_direction] : partners) {
    const auto [a, wall] = photo_and_wall;
    for (const auto& shared : by_direction) {
      for (const int b : Best(shared, kLeastShared, count)) {
        pairs.insert({std::min(a, b), std::max(a, b), wall});
      }
    }
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace stucco
