// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/look.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "texture/light/falloff.h"
#include "texture/photos/resample.h"
#include "texture/views/plan_prior.h"

namespace stucco {
namespace {

constexpr double kLookTexels = 1024;  // of a facet that photos show in large parts
constexpr double kMostLookTexels = 16384;
constexpr double kMostLookViews = 4e6;    // texels times photos: about 100 MB
constexpr double kTexelsAcrossPhoto = 4;  // of what the nearest photo shows of the facet
constexpr int kLookPhotoSide = 1600;      // photos are read this small
constexpr double kConeSlack = 1.1;        // distortion is not quite the same all around

struct Sphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0;
};

Sphere SphereAround(const Facet& facet) {
  Sphere sphere;
  for (const Eigen::Vector3d& vertex : facet.outer) sphere.center += vertex;
  sphere.center /= static_cast<double>(facet.outer.size());
  for (const Eigen::Vector3d& vertex : facet.outer) {
    sphere.radius = std::max(sphere.radius, (vertex - sphere.center).norm());
  }
  return sphere;
}

double HeightAbove(const Facet& facet, const SurveyPhoto& photo) {
  return facet.normal.dot(photo.cam_from_world.Center()) - facet.offset;
}

bool ConeReaches(const SurveyPhoto& photo, const Sphere& sphere) {
  if (!(photo.safe_radius_squared > 0)) return true;  // the cone is not known
  const Eigen::Vector3d center_in_cam = photo.cam_from_world * sphere.center;
  const double distance = center_in_cam.norm();
  if (distance <= sphere.radius) return true;
  const double off_axis = std::atan2(center_in_cam.head<2>().norm(), center_in_cam.z());
  const double cone = kConeSlack * std::atan(std::sqrt(photo.safe_radius_squared));
  return off_axis <= cone + std::asin(sphere.radius / distance);
}

std::vector<float> CostsOver(const RasterView& view, const TexelGrid& raster, double texel,
                             const PaintScene& scene) {
  return ViewCosts(view, raster.texel, texel, scene.sights.photos[view.photo].relative_sharpness);
}

// Where in the photo's picture the texels of a raster lie.
std::vector<float> CornerShares(const SurveyPhoto& photo, const TexelGrid& raster) {
  std::vector<float> shares;
  shares.reserve(raster.size());
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const auto pixel = ProjectIntoPhoto(photo, raster.Center(x, y));
      shares.push_back(pixel ? static_cast<float>(CornerShare(photo.camera, *pixel)) : 0.0F);
    }
  }
  return shares;
}

// How much brighter each candidate is than each other.
std::vector<ColourRatio> RatiosBetween(std::span<const Candidate> candidates,
                                       std::span<const RasterView> views, const TexelGrid& raster,
                                       const PaintScene& scene) {
  std::vector<std::vector<float>> colours;
  std::vector<std::vector<float>> corners;
  std::vector<const RasterView*> sights;
  for (const Candidate& candidate : candidates) {
    const SurveyPhoto& photo = scene.sights.photos[candidate.photo];
    colours.push_back(SampleRaster(photo, raster, *scene.cache));
    corners.push_back(CornerShares(photo, raster));
    sights.push_back(&*std::find_if(views.begin(), views.end(), [&](const RasterView& view) {
      return view.photo == candidate.photo;
    }));
  }
  std::vector<ColourRatio> ratios;
  std::vector<uint8_t> both(raster.size());
  for (size_t a = 0; a < colours.size(); ++a) {
    for (size_t b = a + 1; b < colours.size(); ++b) {
      for (size_t i = 0; i < both.size(); ++i) {
        both[i] = sights[a]->texels[i].sight == Sight::kFree &&
                  sights[b]->texels[i].sight == Sight::kFree;
      }
      const auto measured = MeasureRatios({candidates[a].photo, colours[a], corners[a]},
                                          {candidates[b].photo, colours[b], corners[b]}, both);
      ratios.insert(ratios.end(), measured.begin(), measured.end());
    }
  }
  return ratios;
}

}  // namespace

ViewLimits LimitsFor(const Facet& facet, std::span<const SurveyPhoto> photos,
                     double max_angle_deg) {
  const Eigen::Vector3d center = SphereAround(facet).center;
  std::vector<double> facing;
  std::vector<double> all;
  for (const SurveyPhoto& photo : photos) {
    const double distance = (photo.cam_from_world.Center() - center).norm();
    all.push_back(distance);
    if (ProjectIntoPhoto(photo, center)) facing.push_back(distance);
  }
  std::vector<double>& distances = facing.empty() ? all : facing;
  std::sort(distances.begin(), distances.end());
  const double typical = distances.empty() ? 0 : distances[distances.size() / 2];
  ViewLimits limits;
  limits.max_angle_deg = max_angle_deg;
  limits.tolerance = std::max(2 * facet.rms, 0.003 * typical);
  limits.clearance = std::max(4 * facet.rms, 0.02 * typical);
  return limits;
}

std::vector<int> PhotosThatMaySee(const Facet& facet, std::span<const SurveyPhoto> photos,
                                  double max_angle_deg) {
  const Sphere sphere = SphereAround(facet);
  const double least_cos = std::cos(max_angle_deg * std::numbers::pi / 180);
  std::vector<int> out;
  for (size_t p = 0; p < photos.size(); ++p) {
    const double height = HeightAbove(facet, photos[p]);
    if (!(height > 0)) continue;
    const double nearest =
        (photos[p].cam_from_world.Center() - sphere.center).norm() - sphere.radius;
    if (height < least_cos * nearest) continue;
    if (ConeReaches(photos[p], sphere)) out.push_back(static_cast<int>(p));
  }
  return out;
}

TexelGrid LookRaster(const Facet& facet, const PaintScene& scene, std::span<const int> photos) {
  const double tiny = std::numeric_limits<double>::min();
  const int most = static_cast<int>(kMostLookTexels);
  const TexelGrid box = MakeGrid(facet, scene.up, tiny, most);
  const double area = static_cast<double>(box.size()) * box.texel * box.texel;
  double footprint = std::numeric_limits<double>::max();
  for (int p : photos) {
    const Camera& camera = scene.sights.photos[p].camera;
    footprint = std::min(footprint, HeightAbove(facet, scene.sights.photos[p]) *
                                        std::min(camera.width_px / camera.FocalX(),
                                                 camera.height_px / camera.FocalY()));
  }
  const double affordable =
      kMostLookViews / static_cast<double>(std::max<size_t>(1, photos.size()));
  const double finest = std::sqrt(area / std::clamp(affordable, kLookTexels, kMostLookTexels));
  const double usual = std::sqrt(area / kLookTexels);
  return MakeGrid(facet, scene.up, std::clamp(footprint / kTexelsAcrossPhoto, finest, usual), most);
}

std::vector<float> SampleRaster(const SurveyPhoto& photo, const TexelGrid& raster,
                                PhotoCache& cache) {
  return SamplePhoto(photo, *cache.Get(photo.path(), kLookPhotoSide), raster,
                     {0, 0, raster.width, raster.height})
      .rgb;
}

FacetLook LookAtFacet(const Facet& facet, const PaintScene& scene, const TextureOptions& options) {
  FacetLook look;
  look.limits = LimitsFor(facet, scene.sights.photos, options.max_angle_deg);
  const std::vector<int> possible =
      PhotosThatMaySee(facet, scene.sights.photos, options.max_angle_deg);
  const TexelGrid grid = LookRaster(facet, scene, possible);
  const std::vector<uint8_t> mask = RasterizeFacet(facet, grid);
  const FacetRaster raster{grid, {mask.begin(), mask.end()}, 1};
  std::vector<RasterView> views;
  for (int p : possible) {
    RasterView view = MeasureView(scene.sights, p, facet, raster, look.limits);
    const bool any = std::any_of(view.texels.begin(), view.texels.end(),
                                 [](const TexelView& t) { return t.sight != Sight::kNot; });
    if (any) views.push_back(std::move(view));
  }
  look.texel = options.texel_size > 0 ? options.texel_size : FinestTexel(views, grid.texel);
  if (views.empty()) return look;
  std::vector<int> photos;
  photos.reserve(views.size());
  for (const RasterView& view : views) photos.push_back(view.photo);
  const std::vector<float> prior = PriorCosts(facet, scene.sights.photos, photos);
  std::vector<std::vector<float>> costs;
  for (size_t v = 0; v < views.size(); ++v) {
    costs.push_back(CostsOver(views[v], grid, look.texel, scene));
    for (float& cost : costs.back()) cost += prior[v];
  }
  look.candidates = RankCandidates(views, raster.inside, costs, options.max_candidates);
  if (options.colour) look.ratios = RatiosBetween(look.candidates, views, grid, scene);
  return look;
}

}  // namespace stucco
