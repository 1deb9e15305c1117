// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "proxy/cloud/grid_index.h"
#include "proxy/cloud/normals.h"
#include "proxy/planes/consolidate.h"
#include "proxy/planes/find_planes.h"
#include "proxy/planes/regularise.h"
#include "proxy/planes/upright.h"
#include "proxy/scene/clusters.h"
#include "proxy/scene/ground.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr double kFlatOfDetail =
    0.4;  // 0.12 of 0.3 m: what stereo makes of a flat surface lies within

constexpr char kCloudRemedy[] =
    "Look at dense/cloud.ply: the dense stage found too little surface. More overlapping photos, "
    "or "
    "a finer dense quality, give more points.";

// Thins the cloud, measures it, and thins again when the tolerances need fewer points or more.
CloudScale PrepareSamples(const ProxyInput& input, const ProxyOptions& options,
                          PlanarScene& scene) {
  const bool metric = input.georef.metric;
  constexpr int kFirstLook = 500'000;  // points that tell the scale of any scene
  scene.samples = ThinCloud(input.cloud, input.photos, std::min(options.max_points, kFirstLook), 0);
  const auto fewest = static_cast<size_t>(std::max(12, options.min_points));
  if (scene.samples.size() < fewest) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("the dense cloud has {} usable points ({} of {} are not finite or far "
                            "away); planes need at least {}",
                            scene.samples.size(), scene.samples.dropped, input.cloud.count, fewest),
                kCloudRemedy);
  }
  CloudScale scale = MeasureScale(scene.samples);
  if (!(scale.spacing > 0)) {
    throw Error(ErrorKind::kStageFailed, "all points of the dense cloud are at one place",
                kCloudRemedy);
  }
  CloudScale dense = scale;
  dense.spacing = 0;
  const double fine = DeriveTolerances(dense, metric, options).level_of_detail / kSamplesPerDetail;
  if (options.max_points > kFirstLook && 1.3 * fine < scale.spacing) {
    scene.samples = ThinCloud(input.cloud, input.photos, options.max_points, fine);
    scale = MeasureScale(scene.samples);
  }
  scene.tolerances = DeriveTolerances(scale, metric, options);
  const double coarse = scene.tolerances.level_of_detail / kSamplesPerDetail;
  if (coarse > 1.3 * scale.spacing) {
    scene.samples = ThinCloud(input.cloud, input.photos, options.max_points, coarse);
    const CloudScale thinned = MeasureScale(scene.samples);
    scene.tolerances.spacing = std::max(thinned.spacing, scene.samples.cell * 0.8);
    scene.tolerances.radius = 3 * scene.tolerances.spacing;
  }
  return scale;
}

// Says when points too far apart, by `max_points` or in the cloud itself, cost details.
void WarnOfCoarseness(const CloudScale& scale, const ProxyInput& input, const ProxyOptions& options,
                      const PlanarScene& scene, ProxyFindings& findings) {
  const Georef& georef = input.georef;
  CloudScale dense = scale;
  dense.spacing = 0;
  const Tolerances wanted = DeriveTolerances(dense, georef.metric, options);
  const Tolerances& got = scene.tolerances;
  constexpr double kWorthAWord = 1.25;
  if (got.level_of_detail <= kWorthAWord * wanted.level_of_detail &&
      got.fill_gap <= kWorthAWord * wanted.fill_gap) {
    return;
  }
  const std::string thinned =
      std::string(input.plan ? "Buildings that the map gives shape are looked at closely all the "
                               "same. For what else there is, raise"
                             : "Raise") +
      " proxy.max_points (a million points take about 0.3 GB), or divide the survey.";
  findings.warnings.push_back(fmt::format(
      "points {:.3g} {} apart tell few details: the level of detail is {:.3g} instead of {:.3g}, "
      "gaps are closed up to {:.3g}, facets below an area of {:.3g} are left out. {}",
      scale.spacing, georef.metric ? "m" : "units", got.level_of_detail, wanted.level_of_detail,
      got.fill_gap, got.min_area,
      scene.samples.cell > 0 ? thinned : "A finer dense quality gives more points."));
}

std::vector<Plane> PlanesOf(const ProxyOptions& options, int threads, PlanarScene& scene) {
  const GridIndex index(scene.samples.positions, scene.tolerances.radius);
  const auto agreement = SmoothNormals(scene.samples, index, scene.tolerances.radius, threads);
  return FindPlanes(scene.samples, index, agreement, scene.tolerances, options);
}

void FindUp(const std::vector<Plane>& planes, const ProxyInput& input, const ProxyOptions& options,
            PlanarScene& scene, ProxyFindings& findings) {
  const Georef& georef = input.georef;
  if (options.up.size() == 3) {
    const Eigen::Vector3d up(options.up[0], options.up[1], options.up[2]);
    if (!(up.norm() > 0)) {
      throw Error(ErrorKind::kUsage, "proxy.up must not be [0, 0, 0]");
    }
    scene.up = up.normalized();
    findings.notes.push_back("up: from the settings");
    return;
  }
  if (!options.up.empty()) {
    throw Error(ErrorKind::kUsage,
                fmt::format("proxy.up has {} numbers; it needs 3", options.up.size()));
  }
  if (georef.up && georef.up->allFinite() && georef.up->norm() > 0) {
    // Gimbals are good to about a degree, and positions of a few metres from a short flight tilt
    // the frame by more; walls are better, but only near what sensors say. RTK and surveyed points
    // need no help, nor does a scan, which has no cameras: its coordinate system knows up. Where
    // gimbals look all around, calibration knows it better than walls with windows and balconies.
    constexpr double kGimbal_deg = 3;
    constexpr double kPositions_deg = 5;
    const Eigen::Vector3d given = georef.up->normalized();
    constexpr double kSure_deg = 0.1;
    const bool exact =
        georef.frame == "enu" &&
        (georef.source == "rtk" || georef.source == kGroundControlSource || input.photos.empty() ||
         (georef.up_sigma_deg && *georef.up_sigma_deg < kSure_deg));
    const double tolerance_deg = georef.frame == "enu" ? kPositions_deg : kGimbal_deg;
    scene.up = exact ? given : RefineUp(planes, {given, tolerance_deg, georef.up_sigma_deg});
    findings.notes.push_back(fmt::format(
        "up: from calibration ({}); walls moved it by {:.2f} deg", georef.source,
        std::acos(std::clamp(scene.up.dot(given), -1.0, 1.0)) * 180 / std::numbers::pi));
    return;
  }
  const UpEstimate estimate = EstimateUp(planes, input.photos);
  scene.up = estimate.up;
  findings.notes.push_back(fmt::format(
      "up: from {}; {:.0f} % of the planes' area is upright or level, walls moved it by {:.1f} deg",
      estimate.source, 100 * estimate.explained, estimate.from_first_guess_deg));
  if (estimate.explained < 0.3) {
    findings.warnings.push_back(
        "up is uncertain: few planes are upright or level. Set proxy.up, or give photos with "
        "gimbal "
        "angles or GPS.");
  }
}

// Takes the ground out of the planes; its pieces of one height and slope are one plane. The main
// one first.
std::vector<Plane> TakeGround(const PlanarScene& scene, RegulariseOptions regularity,
                              std::vector<Plane>& planes) {
  std::vector<Plane> ground;
  for (const int g : FindGround(scene.samples, scene.tolerances, scene.up, planes)) {
    ground.push_back(std::move(planes[g]));
    planes[g].points.clear();
  }
  std::erase_if(planes, [](const Plane& plane) { return plane.points.empty(); });
  if (ground.empty()) return ground;
  const std::vector<int> of_main = ground.front().points;
  regularity.align_tolerance_deg = 0;
  Regularise(scene.samples, scene.tolerances, scene.up, regularity, ground);
  const auto in_main = [&](const Plane& plane) {
    return std::ranges::count_if(plane.points,
                                 [&](int i) { return std::ranges::binary_search(of_main, i); });
  };
  std::rotate(ground.begin(), std::ranges::max_element(ground, {}, in_main), ground.end());
  return ground;
}

}  // namespace

bool IsOfLeaves(const PlanarScene& scene, const Plane& plane) {
  return NormalScatterDeg(scene.samples, plane) > scene.leaf_scatter_deg;
}

PlanarScene UnderstandCloud(const ProxyInput& input, const ProxyOptions& options, int threads,
                            ProxyFindings& findings) {
  PlanarScene scene;
  const Georef& georef = input.georef;
  const CloudScale scale = PrepareSamples(input, options, scene);
  findings.notes.push_back(
      fmt::format("{} points thinned to {}, {} dropped; noise {:.4g}, level of detail {:.4g} {}",
                  input.cloud.count, scene.samples.size(), scene.samples.dropped, scale.noise,
                  scene.tolerances.level_of_detail, georef.metric ? "m" : "units"));
  WarnOfCoarseness(scale, input, options, scene, findings);
  auto planes = PlanesOf(options, threads, scene);
  if (planes.empty()) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("the dense cloud shows no plane of at least {:.3g} {}",
                            scene.tolerances.min_area, georef.metric ? "m2" : "square units"),
                kCloudRemedy);
  }
  FindUp(planes, input, options, scene, findings);
  const RegulariseOptions regularity{.vertical_tolerance_deg = options.vertical_tolerance_deg,
                                     .align_tolerance_deg = options.align_tolerance_deg};
  AssignRoles(scene.samples, scene.tolerances, scene.up, regularity, planes);
  std::vector<const Plane*> all;
  all.reserve(planes.size());
  for (const Plane& plane : planes) {
    all.push_back(&plane);
    scene.support.insert(scene.support.end(), plane.points.begin(), plane.points.end());
  }
  scene.main_direction = MainDirection(scene.up, all);
  std::sort(scene.support.begin(), scene.support.end());
  const size_t num_planes = planes.size();
  scene.ground = TakeGround(scene, regularity, planes);
  if (scene.ground.empty()) {
    if (auto floor = FitFloor(scene.samples, scene.tolerances, scene.up)) {
      scene.ground.push_back(std::move(*floor));
      findings.notes.push_back("the ground is seen in patches only: fitted as one plane");
    }
  }
  Clusters clusters =
      SplitIntoBuildings(scene.samples, scene.tolerances, scene.up, scene.ground, planes);
  scene.buildings = std::move(clusters.buildings);
  ParallelFor(scene.buildings.size(), threads, [&](size_t b) {
    std::vector<Plane>& building = scene.buildings[b];
    Regularise(scene.samples, scene.tolerances, scene.up, regularity, building);
    for (Plane& plane : building) {
      RefitToDensest(scene.samples, kFlatOfDetail * scene.tolerances.level_of_detail, plane);
    }
  });
  std::erase_if(scene.buildings, [](const auto& building) { return building.empty(); });
  scene.leaf_scatter_deg = LeafScatterDeg(scene.samples, scene.buildings);
  findings.notes.push_back(
      fmt::format("{} planes: {} ground, {} buildings; {} small objects left out", num_planes,
                  scene.ground.size(), scene.buildings.size(), clusters.dropped));
  if (scene.ground.empty()) findings.warnings.push_back("the cloud shows no ground");
  return scene;
}

}  // namespace stucco
