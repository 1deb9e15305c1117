// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/select.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stucco {
namespace {

// Weights of the data term against the view cost, which is in [0, 1]. An occluder is worse than the
// poorest view, so that removing one pays for another photo.
constexpr float kDisagreementWeight = 2.0f;
constexpr float kBehindWeight = 2.0f;  // also for what is beyond
constexpr float kUnseenCost = 3.0f;
constexpr float kHazeWeight = 1.0f;  // of all contrast lost
// A texel leaves its cell's picture for a neighbouring cell's that is better by this.
constexpr float kClearlyBetter = 1.2f;
constexpr int kNotStray = 4;  // of 9 texels
// Seams: a floor that keeps them short, and weights of differences on a scale of 0 to 1.
constexpr float kSeamFloor = 0.1f;
constexpr float kSeamColour = 8.0f;
constexpr float kSeamGradient = 4.0f;
constexpr float kSeamUnseen = 0.5f;
// Something stands out of the plane here: photos show it in different places.
constexpr float kSeamRelief = 0.8f;

// Of the cell in this column and row with its right (direction 0) or lower neighbour (1).
struct CellBorder {
  int x = 0;
  int y = 0;
  int direction = 0;
};

// Walks the pairs of raster texels (i on this side, j on the other) along the border between a cell
// and its right or lower neighbour.
template <typename Fn>
void ForEachBorderPair(const TexelGrid& raster, int cell, const CellBorder& border, Fn&& fn) {
  const bool right = border.direction == 0;
  for (int k = 0; k < cell; ++k) {
    const int x = right ? (border.x + 1) * cell - 1 : border.x * cell + k;
    const int y = right ? border.y * cell + k : (border.y + 1) * cell - 1;
    const int next_x = right ? x + 1 : x;
    const int next_y = right ? y : y + 1;
    if (next_x >= raster.width || next_y >= raster.height) continue;
    fn(static_cast<size_t>(y) * raster.width + x,
       static_cast<size_t>(next_y) * raster.width + next_x);
  }
}

float SeamAt(const RasterPicture& a, const RasterPicture& b, size_t i, size_t j) {
  if (a.sight[i] == Sight::kNot || b.sight[i] == Sight::kNot || a.sight[j] == Sight::kNot ||
      b.sight[j] == Sight::kNot) {
    return kSeamUnseen;
  }
  const float colour = (ColourDifference(&a.rgb[3 * i], &b.rgb[3 * i]) +
                        ColourDifference(&a.rgb[3 * j], &b.rgb[3 * j])) /
                       2;
  float step_a[3];
  float step_b[3];
  for (int k = 0; k < 3; ++k) {
    step_a[k] = a.rgb[3 * j + k] - a.rgb[3 * i + k];
    step_b[k] = b.rgb[3 * j + k] - b.rgb[3 * i + k];
  }
  const bool flat = a.sight[i] == Sight::kFree && b.sight[i] == Sight::kFree;
  return (kSeamColour * colour + kSeamGradient * ColourDifference(step_a, step_b)) / 255 +
         (flat ? 0 : kSeamRelief);
}

// The pictures and what each costs where: [picture][texel].
struct CostedPictures {
  std::span<const RasterPicture> pictures;
  std::vector<std::vector<float>> costs;
};

CostedPictures CostPictures(std::span<const RasterPicture> pictures, const TexelGrid& raster,
                            double relief) {
  const Consensus consensus = FindConsensus(pictures, raster);
  std::vector<std::vector<float>> costs = Disagreement(pictures, consensus, raster);
  std::vector<float> haze;
  for (size_t p = 0; p < pictures.size(); ++p) {
    haze.push_back(kHazeWeight * Haze(pictures[p], consensus, costs[p]));
  }
  ForgiveRelief(pictures, consensus, raster, relief, costs);
  for (size_t p = 0; p < pictures.size(); ++p) {
    for (size_t i = 0; i < raster.size(); ++i) {
      const Sight sight = pictures[p].sight[i];
      costs[p][i] = pictures[p].cost[i] + haze[p] + kDisagreementWeight * costs[p][i];
      if (sight != Sight::kFree) costs[p][i] += kBehindWeight;
      if (sight == Sight::kNot) costs[p][i] = kUnseenCost;
    }
  }
  return {pictures, std::move(costs)};
}

// What `inside` sums up to in a cell that is all of the facet.
double FullCell(const FacetRaster& raster, int cell) {
  return static_cast<double>(raster.full) * cell * cell;
}

void FillData(const CostedPictures& costed, const FacetRaster& raster, int cell,
              LabelProblem& problem) {
  const TexelGrid& grid = raster.grid;
  const double full_cell = FullCell(raster, cell);
  problem.data.assign(problem.cells() * problem.labels, 0);
  for (int label = 0; label < problem.labels; ++label) {
    const RasterPicture& picture = costed.pictures[label];
    std::vector<uint8_t> seen(problem.cells(), 0);
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        const size_t i = static_cast<size_t>(y) * grid.width + x;
        if (raster.inside[i] == 0) continue;
        const size_t c = static_cast<size_t>(y / cell) * problem.width + x / cell;
        if (picture.sight[i] != Sight::kNot) seen[c] = 1;
        problem.data[c * problem.labels + label] +=
            costed.costs[label][i] * static_cast<float>(raster.inside[i] / full_cell);
      }
    }
    for (size_t c = 0; c < problem.cells(); ++c) {
      if (!seen[c]) problem.data[c * problem.labels + label] = LabelProblem::kForbidden;
    }
  }
}

struct LabelRegion {
  int label = -1;
  std::vector<size_t> cells;
};

// Connected regions of equal label, in order of their first cell; `region_of` gives each cell's.
std::vector<LabelRegion> FindRegions(const LabelProblem& problem, const Labels& labels,
                                     std::vector<int>& region_of) {
  std::vector<LabelRegion> regions;
  region_of.assign(labels.size(), -1);
  const auto width = static_cast<size_t>(problem.width);
  for (size_t start = 0; start < labels.size(); ++start) {
    if (labels[start] < 0 || region_of[start] >= 0) continue;
    LabelRegion region{labels[start], {start}};
    const int number = static_cast<int>(regions.size());
    region_of[start] = number;
    for (size_t k = 0; k < region.cells.size(); ++k) {
      const size_t cell = region.cells[k];
      const size_t x = cell % width;
      const auto visit = [&](bool exists, size_t next) {
        if (!exists || region_of[next] >= 0 || labels[next] != region.label) return;
        region_of[next] = number;
        region.cells.push_back(next);
      };
      visit(x > 0, cell - 1);
      visit(x + 1 < width, cell + 1);
      visit(cell >= width, cell - width);
      visit(cell + width < labels.size(), cell + width);
    }
    regions.push_back(std::move(region));
  }
  return regions;
}

// Length of the border that a region shares with each label.
std::vector<size_t> BorderWith(const LabelProblem& problem, const Labels& labels,
                               const LabelRegion& region) {
  std::vector<size_t> border(problem.labels, 0);
  const auto width = static_cast<size_t>(problem.width);
  for (size_t cell : region.cells) {
    const size_t x = cell % width;
    const auto visit = [&](bool exists, size_t next) {
      if (exists && labels[next] >= 0 && labels[next] != region.label) ++border[labels[next]];
    };
    visit(x > 0, cell - 1);
    visit(x + 1 < width, cell + 1);
    visit(cell >= width, cell - width);
    visit(cell + width < labels.size(), cell + width);
  }
  return border;
}

// A label that may replace a region's: it can paint nine tenths of the cells.
int BestNeighbour(const LabelProblem& problem, const Labels& labels, const LabelRegion& region) {
  const std::vector<size_t> border = BorderWith(problem, labels, region);
  int best = -1;
  for (int label = 0; label < problem.labels; ++label) {
    if (border[label] == 0 || (best >= 0 && border[label] <= border[best])) continue;
    const auto allowed = std::count_if(region.cells.begin(), region.cells.end(), [&](size_t cell) {
      return problem.Data(cell, label) < LabelProblem::kForbidden;
    });
    if (10 * static_cast<size_t>(allowed) >= 9 * region.cells.size()) best = label;
  }
  return best;
}

// The pictures in use in a cell and the eight around it.
std::vector<uint8_t> NearbyLabels(const LabelProblem& problem, const Labels& labels, int cell_x,
                                  int cell_y) {
  std::vector<uint8_t> nearby(problem.labels, 0);
  for (int y = std::max(0, cell_y - 1); y <= std::min(problem.height - 1, cell_y + 1); ++y) {
    for (int x = std::max(0, cell_x - 1); x <= std::min(problem.width - 1, cell_x + 1); ++x) {
      const int label = labels[static_cast<size_t>(y) * problem.width + x];
      if (label >= 0) nearby[label] = 1;
    }
  }
  return nearby;
}

// The cheapest of the pictures marked in `allowed` that see a texel, -1 for none.
int Cheapest(const CostedPictures& costed, const std::vector<uint8_t>& allowed, size_t texel) {
  const auto& [pictures, costs] = costed;
  int best = -1;
  for (size_t p = 0; p < pictures.size(); ++p) {
    if (!allowed[p] || pictures[p].sight[texel] == Sight::kNot) continue;
    if (best < 0 || costs[p][texel] < costs[best][texel]) best = static_cast<int>(p);
  }
  return best;
}

// How many of the 3 x 3 texels around one have this value.
int CountAround(const std::vector<int>& values, const TexelGrid& raster, int x, int y, int value) {
  int count = 0;
  for (int j = std::max(0, y - 1); j <= std::min(raster.height - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(raster.width - 1, x + 1); ++i) {
      count += values[static_cast<size_t>(j) * raster.width + i] == value;
    }
  }
  return count;
}

// From cells to texels: a texel that its cell's picture does not see takes the cheapest in use;
// those that another picture nearby shows far better (the rim of an occluder) take that, unless
// they are stray ones.
std::vector<int> RefineToTexels(const CostedPictures& costed, const FacetRaster& raster, int cell,
                                const LabelProblem& problem, const Labels& labels) {
  const auto& [pictures, costs] = costed;
  const TexelGrid& grid = raster.grid;
  std::vector<uint8_t> in_use(pictures.size(), 0);
  for (int label : labels) {
    if (label >= 0) in_use[label] = 1;
  }
  std::vector<int> wish(grid.size(), -1);
  std::vector<int> out(grid.size(), -1);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const size_t i = static_cast<size_t>(y) * grid.width + x;
      if (raster.inside[i] == 0) continue;
      const int own = labels[static_cast<size_t>(y / cell) * problem.width + x / cell];
      if (own < 0 || pictures[own].sight[i] == Sight::kNot) {
        out[i] = Cheapest(costed, in_use, i);
        continue;
      }
      out[i] = own;
      const int other = Cheapest(costed, NearbyLabels(problem, labels, x / cell, y / cell), i);
      if (costs[other][i] + kClearlyBetter < costs[own][i]) wish[i] = other;
    }
  }
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const size_t i = static_cast<size_t>(y) * grid.width + x;
      if (wish[i] >= 0 && CountAround(wish, grid, x, y, wish[i]) >= kNotStray) out[i] = wish[i];
    }
  }
  return out;
}

// What a seam between two texels costs, for every pair of pictures on its two sides.
void AddSeams(std::span<const RasterPicture> pictures, size_t i, size_t j, float scale,
              float* costs) {
  const size_t labels = pictures.size();
  for (size_t a = 0; a < labels; ++a) {
    for (size_t b = a + 1; b < labels; ++b) {
      const float seam = scale * (kSeamFloor + SeamAt(pictures[a], pictures[b], i, j));
      costs[a * labels + b] += seam;
      costs[b * labels + a] += seam;
    }
  }
}

void FillSeams(std::span<const RasterPicture> pictures, const FacetRaster& raster,
               const SelectOptions& options, LabelProblem& problem) {
  const size_t of_border = static_cast<size_t>(problem.labels) * problem.labels;
  problem.seams.assign(problem.cells() * 2 * of_border, 0);
  const auto scale = static_cast<float>(options.seam_cost / options.cell);
  const auto fill = [&](int x, int y, int direction) {
    const size_t c = static_cast<size_t>(y) * problem.width + x;
    float* costs = &problem.seams[(c * 2 + direction) * of_border];
    ForEachBorderPair(raster.grid, options.cell, {x, y, direction}, [&](size_t i, size_t j) {
      if (raster.inside[i] == 0 || raster.inside[j] == 0) return;
      AddSeams(pictures, i, j, scale, costs);
    });
  };
  for (int y = 0; y < problem.height; ++y) {
    for (int x = 0; x < problem.width; ++x) {
      for (int direction = 0; direction < 2; ++direction) fill(x, y, direction);
    }
  }
}

// The labelling problem on cells of options.cell raster texels. Data term: view cost, disagreement,
// points of the cloud in front; seams: difference of colour and gradient on both sides of the cell
// border (Kwatra et al., "Graphcut Textures", 2003).
LabelProblem MakeLabelProblem(const CostedPictures& costed, const FacetRaster& raster,
                              const SelectOptions& options) {
  const std::span<const RasterPicture> pictures = costed.pictures;
  LabelProblem problem;
  const int cell = options.cell;
  problem.width = (raster.grid.width + cell - 1) / cell;
  problem.height = (raster.grid.height + cell - 1) / cell;
  problem.labels = static_cast<int>(pictures.size());
  FillData(costed, raster, cell, problem);

  FillSeams(pictures, raster, options, problem);
  double area = 0;
  const double full_cell = FullCell(raster, cell);
  for (uint16_t count : raster.inside) area += count / full_cell;
  problem.label_cost = options.photo_cost * area;
  return problem;
}

}  // namespace

void MergeSmallRegions(const LabelProblem& problem, size_t min_cells, Labels& labels) {
  std::vector<int> region_of;
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<LabelRegion> regions = FindRegions(problem, labels, region_of);
    std::stable_sort(
        regions.begin(), regions.end(),
        [](const LabelRegion& a, const LabelRegion& b) { return a.cells.size() < b.cells.size(); });
    for (const LabelRegion& region : regions) {
      if (region.cells.size() >= min_cells) break;
      const int heir = BestNeighbour(problem, labels, region);
      if (heir < 0) continue;
      for (size_t cell : region.cells) {
        if (problem.Data(cell, heir) < LabelProblem::kForbidden) labels[cell] = heir;
      }
      // Regions have changed shape; the smallest goes first again. Every pass lowers the number of
      // regions or leaves a remnant that the heir cannot paint and that is not tried again.
      changed = FindRegions(problem, labels, region_of).size() < regions.size();
      if (changed) break;
    }
  }
}

std::vector<int> SelectPictures(std::span<const RasterPicture> pictures, const FacetRaster& raster,
                                const SelectOptions& options) {
  const CostedPictures costed = CostPictures(pictures, raster.grid, options.relief);
  const LabelProblem problem = MakeLabelProblem(costed, raster, options);
  Labels labels = CutLabels(problem);
  const auto used_cells =
      std::count_if(labels.begin(), labels.end(), [](int label) { return label >= 0; });
  MergeSmallRegions(problem,
                    static_cast<size_t>(options.min_region * static_cast<double>(used_cells)) + 1,
                    labels);
  return RefineToTexels(costed, raster, options.cell, problem, labels);
}

}  // namespace stucco
