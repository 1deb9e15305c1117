// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/candidates.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace stucco {
namespace {

constexpr double kBorderShare = 0.04;
// Not used at all: lenses are at their worst there, and alignment may still move the picture.
constexpr double kUnusedShare = 0.005;
// Less than this, as a share of the facet, is no coverage worth a photo.
constexpr double kLeastGain = 0.002;

// Photo pixels per raster texel at a texel's centre, or nothing where the photo does not show it.
std::optional<Eigen::Matrix2d> PixelsPerTexel(const SurveyPhoto& photo, const TexelGrid& raster,
                                              double x, double y) {
  const double height = raster.HeightAt(x, y);
  const auto right = ProjectIntoPhoto(photo, raster.AtHeight(x + 0.25, y, height));
  const auto left = ProjectIntoPhoto(photo, raster.AtHeight(x - 0.25, y, height));
  const auto below = ProjectIntoPhoto(photo, raster.AtHeight(x, y + 0.25, height));
  const auto above = ProjectIntoPhoto(photo, raster.AtHeight(x, y - 0.25, height));
  if (!right || !left || !below || !above) return std::nullopt;
  Eigen::Matrix2d jacobian;
  jacobian.col(0) = 2 * (*right - *left);
  jacobian.col(1) = 2 * (*below - *above);
  return jacobian;
}

double SmallerSingularValue(const Eigen::Matrix2d& m) {
  const double half_trace = m.squaredNorm() / 2;
  const double determinant = m.determinant();
  const double root = std::sqrt(std::max(0.0, half_trace * half_trace - determinant * determinant));
  return std::sqrt(std::max(0.0, half_trace - root));
}

double BorderDistance(const Camera& camera, const Eigen::Vector2d& pixel) {
  return std::min(
      {pixel.x(), pixel.y(), camera.width_px - pixel.x(), camera.height_px - pixel.y()});
}

float BorderNearness(const Camera& camera, const Eigen::Vector2d& pixel) {
  const double share = BorderDistance(camera, pixel) / (kBorderShare * camera.width_px);
  return static_cast<float>(std::clamp(1 - share, 0.0, 1.0));
}

// A texel in a photo, as if nothing stood in between.
struct ShownTexel {
  TexelView view;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// Nothing where the photo does not show it well enough to be of use.
std::optional<ShownTexel> ShowTexel(const SurveyPhoto& photo, const TexelGrid& grid, int column,
                                    int row) {
  const auto pixel = ProjectIntoPhoto(photo, grid.Center(column, row));
  if (!pixel) return std::nullopt;
  if (BorderDistance(photo.camera, *pixel) < kUnusedShare * photo.camera.width_px) {
    return std::nullopt;
  }
  const auto jacobian = PixelsPerTexel(photo, grid, column + 0.5, row + 0.5);
  if (!jacobian) return std::nullopt;
  const double area = std::abs(jacobian->determinant());
  if (!(area > 0)) return std::nullopt;
  ShownTexel shown{{}, *pixel};
  shown.view.sight = Sight::kFree;
  shown.view.resolution = static_cast<float>(SmallerSingularValue(*jacobian));
  shown.view.footprint = static_cast<float>(grid.texel / std::sqrt(area));
  shown.view.border = BorderNearness(photo.camera, *pixel);
  return shown;
}

// Whether a third of the texel and its neighbours that can be seen at all are hidden.
bool IsAmongHidden(const TexelGrid& raster, const std::vector<TexelView>& texels, int x, int y) {
  int hidden = 0;
  int known = 0;
  for (int j = std::max(0, y - 1); j <= std::min(raster.height - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(raster.width - 1, x + 1); ++i) {
      const Sight sight = texels[static_cast<size_t>(j) * raster.width + i].sight;
      hidden += sight == Sight::kBehind;
      known += sight != Sight::kNot;
    }
  }
  return 3 * hidden >= known && hidden > 0;
}

// Texels with a third of their neighbourhood hidden become hidden too.
void GrowHidden(const TexelGrid& raster, std::vector<TexelView>& texels) {
  std::vector<uint8_t> grown(texels.size(), 0);
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      grown[static_cast<size_t>(y) * raster.width + x] = IsAmongHidden(raster, texels, x, y);
    }
  }
  for (size_t i = 0; i < texels.size(); ++i) {
    if (grown[i] && texels[i].sight == Sight::kFree) texels[i].sight = Sight::kBehind;
  }
}

double RoundedToTwoDigits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return std::round(value / unit) * unit;
}

// The views that see something, by merit; `photo` is the index of the view.
std::vector<Candidate> MakePool(std::span<const RasterView> views,
                                std::span<const std::vector<float>> costs, double total) {
  std::vector<Candidate> pool;
  for (size_t v = 0; v < views.size(); ++v) {
    Candidate candidate{static_cast<int>(v)};
    for (size_t i = 0; i < costs[v].size(); ++i) {
      if (views[v].texels[i].sight == Sight::kNot) continue;
      candidate.seen += 1 / total;
      candidate.merit += std::max(0.0f, 1 - costs[v][i]) / total;
    }
    if (candidate.seen > 0) pool.push_back(candidate);
  }
  std::stable_sort(pool.begin(), pool.end(),
                   [](const Candidate& a, const Candidate& b) { return a.merit > b.merit; });
  return pool;
}

// What a view adds to the merit reached so far, in texels; `new_only`: where nothing was reached.
double GainOf(const RasterView& view, const std::vector<float>& costs,
              const std::vector<float>& reached, bool new_only) {
  double gain = 0;
  for (size_t i = 0; i < costs.size(); ++i) {
    if (view.texels[i].sight == Sight::kNot || (new_only && reached[i] > 0)) continue;
    gain += std::max(0.0f, 1 - costs[i] - reached[i]);
  }
  return gain;
}

void Reach(const RasterView& view, const std::vector<float>& costs, std::vector<float>& reached) {
  for (size_t i = 0; i < costs.size(); ++i) {
    if (view.texels[i].sight != Sight::kNot) reached[i] = std::max(reached[i], 1 - costs[i]);
  }
}

}  // namespace

RasterView MeasureView(const SightScene& scene, int photo_index, const Facet& facet,
                       const FacetRaster& raster, const ViewLimits& limits) {
  const SurveyPhoto& photo = scene.photos[photo_index];
  const TexelGrid& grid = raster.grid;
  RasterView out{photo_index, std::vector<TexelView>(grid.size())};
  const Eigen::Vector3d camera = photo.cam_from_world.Center();
  if (facet.normal.dot(camera) - facet.offset <= limits.tolerance) return out;
  const double least_cos = std::cos(limits.max_angle_deg * std::numbers::pi / 180);
  bool any_hidden = false;
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const size_t index = static_cast<size_t>(row) * grid.width + column;
      if (raster.inside[index] == 0) continue;
      const Eigen::Vector3d point = grid.Center(column, row);
      const Eigen::Vector3d to_camera = (camera - point).normalized();
      const double cos_angle = facet.normal.dot(to_camera);
      if (!(cos_angle >= least_cos)) continue;
      const auto shown = ShowTexel(photo, grid, column, row);
      if (!shown) continue;
      const double height = grid.HeightAt(column + 0.5, row + 0.5);
      // Behind its plane a point is seen through it.
      const double lift = limits.tolerance + std::max(0.0, -height);
      const Eigen::Vector3d before_plane =
          height < 0 ? Eigen::Vector3d(point + lift / cos_angle * to_camera)
                     : Eigen::Vector3d(point + lift * facet.normal);
      if (scene.occlusion->Blocked(before_plane, camera)) continue;
      if (grid.ReliefHides(point, camera)) continue;
      TexelView& view = out.texels[index];
      view = shown->view;
      view.cos_angle = static_cast<float>(cos_angle);
      if (scene.nearest.empty()) continue;
      const CloudView cloud = AskCloud(scene, photo_index, shown->pixel, facet,
                                       {height - limits.clearance, height + limits.clearance});
      view.no_points = cloud == CloudView::kNoPoints;
      if (cloud == CloudView::kBeyond) view.sight = Sight::kBeyond;
      if (cloud == CloudView::kInFront) view.sight = Sight::kBehind;
      any_hidden |= cloud == CloudView::kInFront;
    }
  }
  if (any_hidden) GrowHidden(grid, out.texels);
  return out;
}

float ViewCost(const TexelView& view, double raster_texel, double texel, double sharpness) {
  const double resolution = std::min(1.0, view.resolution * texel / raster_texel);
  // A sharpness of half the survey's typical value is clearly visible in the picture.
  const double blur = std::clamp(1 - sharpness, 0.0, 1.0);
  return static_cast<float>(0.4 * (1 - resolution) + 0.3 * (1 - view.cos_angle) + 0.2 * blur +
                            0.1 * view.border);
}

std::vector<float> ViewCosts(const RasterView& view, double raster_texel, double texel,
                             double sharpness) {
  std::vector<float> costs(view.texels.size(), 0);
  for (size_t i = 0; i < costs.size(); ++i) {
    if (view.texels[i].sight == Sight::kNot) continue;
    costs[i] = ViewCost(view.texels[i], raster_texel, texel, sharpness);
  }
  return costs;
}

std::vector<Candidate> RankCandidates(std::span<const RasterView> views,
                                      std::span<const uint16_t> inside,
                                      std::span<const std::vector<float>> costs, int max_count) {
  const auto total = static_cast<double>(
      std::count_if(inside.begin(), inside.end(), [](auto n) { return n > 0; }));
  std::vector<Candidate> pool = MakePool(views, costs, total);
  std::vector<Candidate> out;
  std::vector<float> reached(inside.size(), 0);
  while (!pool.empty() && static_cast<int>(out.size()) < kMostCandidates) {
    const bool full = static_cast<int>(out.size()) >= max_count;
    size_t best = 0;
    double best_gain = kLeastGain * total;
    bool found = false;
    for (size_t k = 0; k < pool.size(); ++k) {
      const int v = pool[k].photo;
      const double gain = GainOf(views[v], costs[v], reached, full);
      if (!(gain > best_gain)) continue;
      best_gain = gain;
      best = k;
      found = true;
    }
    if (full && !found) break;
    Reach(views[pool[best].photo], costs[pool[best].photo], reached);
    out.push_back(pool[best]);
    pool.erase(pool.begin() + static_cast<std::ptrdiff_t>(best));
  }
  for (Candidate& candidate : out) candidate.photo = views[candidate.photo].photo;
  return out;
}

double FinestTexel(std::span<const RasterView> views, double raster_texel) {
  std::vector<double> finest;
  if (views.empty()) return 0;
  for (size_t i = 0; i < views.front().texels.size(); ++i) {
    float best = 0;
    for (const RasterView& view : views) {
      if (view.texels[i].sight != Sight::kNot) best = std::max(best, view.texels[i].resolution);
    }
    if (best > 0) finest.push_back(raster_texel / best);
  }
  if (finest.empty()) return 0;
  const auto quarter = finest.begin() + static_cast<std::ptrdiff_t>(finest.size() / 4);
  std::nth_element(finest.begin(), quarter, finest.end());
  return RoundedToTwoDigits(*quarter);
}

}  // namespace stucco
