// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/sweep_tiles.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "texture/relief/plane_sweep.h"

namespace stucco {
namespace {

constexpr double kTile_m = 6;
constexpr int kSightStep = 4;        // cells of a cell that sights are asked for
constexpr double kLeastMerit = 0.1;  // of a photo, mean over a tile

// How well photos see a facet's plane, in coarse cells.
struct Sights {
  TexelGrid grid;
  std::vector<int> photos;
  std::vector<std::vector<float>> costs;  // by photo and cell, below 0 where not seen

  float CostAt(size_t view, int column, int row) const {
    return costs[view][static_cast<size_t>(row / kSightStep) * grid.width + column / kSightStep];
  }
};

Sights MeasureSights(const Facet& facet, const TexelGrid& raster, double texel,
                     const ViewLimits& limits, const PaintScene& scene) {
  FacetRaster coarse{Coarsened(raster, kSightStep), {}, 1};
  coarse.inside.assign(coarse.grid.size(), 1);
  Sights out{coarse.grid, PhotosThatMaySee(facet, scene.sights.photos, limits.max_angle_deg), {}};
  out.costs.reserve(out.photos.size());
  for (const int photo : out.photos) {
    const RasterView view = MeasureView(scene.sights, photo, facet, coarse, limits);
    const double sharpness = scene.sights.photos[photo].relative_sharpness;
    out.costs.push_back(ViewCosts(view, coarse.grid.texel, texel, sharpness));
    for (size_t i = 0; i < view.texels.size(); ++i) {
      if (view.texels[i].sight == Sight::kNot) out.costs.back()[i] = -1;
    }
  }
  return out;
}

// Mean over the tile of 1 - cost, 0 where not seen.
double MeritOf(size_t view, const CellRectangle& cells, const Sights& sights) {
  double merit = 0;
  int count = 0;
  for (int row = cells.top; row < cells.bottom; row += kSightStep) {
    for (int column = cells.left; column < cells.right; column += kSightStep) {
      ++count;
      const float cost = sights.CostAt(view, column, row);
      if (cost >= 0) merit += std::max(0.0f, 1 - cost);
    }
  }
  return merit / count;
}

std::vector<size_t> ByMerit(const CellRectangle& cells, const Sights& sights) {
  std::vector<std::pair<double, size_t>> merits;
  for (size_t v = 0; v < sights.photos.size(); ++v) {
    const double merit = MeritOf(v, cells, sights);
    if (merit >= kLeastMerit) merits.emplace_back(-merit, v);
  }
  std::ranges::sort(merits);
  std::vector<size_t> out;
  out.reserve(merits.size());
  for (const auto& [merit, view] : merits) out.push_back(view);
  return out;
}

SweepTile MakeTile(const CellRectangle& cells, const TexelGrid& raster, const Sights& sights,
                   std::span<const SurveyPhoto> photos) {
  SweepTile tile{cells, {}, {}};
  const CellRectangle around = WithRim(cells, raster);
  const TexelGrid part = PartOf(raster, around);
  for (const size_t view : ByMerit(cells, sights)) {
    if (tile.photos.size() == kMostTilePhotos) break;
    const int photo = sights.photos[view];
    const Eigen::Vector2d slant = SlantOf(photos[photo], part);
    const auto is_near = [&](const Eigen::Vector2d& other) {
      return (slant - other).norm() < kLeastParallax;
    };
    if (std::ranges::any_of(tile.slants, is_near)) continue;
    TilePhoto shown{photo, {}};
    shown.sees.reserve(part.size());
    for (int row = around.top; row < around.bottom; ++row) {
      for (int column = around.left; column < around.right; ++column) {
        shown.sees.push_back(sights.CostAt(view, column, row) >= 0);
      }
    }
    tile.photos.push_back(std::move(shown));
    tile.slants.push_back(slant);
  }
  return tile;
}

// The ends of about equal parts of [0, cells).
std::vector<int> EndsOfParts(int cells, double cell) {
  const int parts = std::max(1, static_cast<int>(std::lround(cells * cell / kTile_m)));
  std::vector<int> out;
  for (int i = 1; i <= parts; ++i) out.push_back(static_cast<int>(int64_t{cells} * i / parts));
  return out;
}

}  // namespace

std::vector<SweepTile> CutForSweep(const Facet& facet, const TexelGrid& raster, double texel,
                                   const ViewLimits& limits, const PaintScene& scene) {
  const Sights sights = MeasureSights(facet, raster, texel, limits, scene);
  std::vector<SweepTile> tiles;
  int top = 0;
  for (const int bottom : EndsOfParts(raster.height, raster.texel)) {
    int left = 0;
    for (const int right : EndsOfParts(raster.width, raster.texel)) {
      tiles.push_back(MakeTile({left, top, right, bottom}, raster, sights, scene.sights.photos));
      left = right;
    }
    top = bottom;
  }
  return tiles;
}

}  // namespace stucco
