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

// Where the photos see a facet's plane, in coarse cells.
struct Sights {
  TexelGrid grid;
  std::vector<RasterView> views;
  std::vector<std::vector<float>> costs;  // by view

  bool Sees(size_t view, int column, int row) const {
    const size_t i = static_cast<size_t>(row / kSightStep) * grid.width + column / kSightStep;
    return views[view].texels[i].sight != Sight::kNot;
  }
};

Sights MeasureSights(const Facet& facet, const TexelGrid& raster, double texel,
                     const ViewLimits& limits, const PaintScene& scene) {
  FacetRaster coarse{Coarsened(raster, kSightStep), {}, 1};
  coarse.inside.assign(coarse.grid.size(), 1);
  Sights out{coarse.grid, {}, {}};
  for (const int photo : PhotosThatMaySee(facet, scene.sights.photos, limits.max_angle_deg)) {
    RasterView view = MeasureView(scene.sights, photo, facet, coarse, limits);
    const double sharpness = scene.sights.photos[photo].relative_sharpness;
    out.costs.push_back(ViewCosts(view, coarse.grid.texel, texel, sharpness));
    out.views.push_back(std::move(view));
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
      if (!sights.Sees(view, column, row)) continue;
      const size_t i =
          static_cast<size_t>(row / kSightStep) * sights.grid.width + column / kSightStep;
      merit += std::max(0.0f, 1 - sights.costs[view][i]);
    }
  }
  return merit / count;
}

std::vector<size_t> ByMerit(const CellRectangle& cells, const Sights& sights) {
  std::vector<std::pair<double, size_t>> merits;
  for (size_t v = 0; v < sights.views.size(); ++v) {
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
    const int photo = sights.views[view].photo;
    const Eigen::Vector2d slant = SlantOf(photos[photo], part);
    const auto is_near = [&](const Eigen::Vector2d& other) {
      return (slant - other).norm() < kLeastParallax;
    };
    if (std::ranges::any_of(tile.slants, is_near)) continue;
    TilePhoto shown{photo, {}};
    shown.sees.reserve(part.size());
    for (int row = around.top; row < around.bottom; ++row) {
      for (int column = around.left; column < around.right; ++column) {
        shown.sees.push_back(sights.Sees(view, column, row));
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
