// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/find_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "texture/relief/best_rectangle.h"
#include "texture/relief/plane_sweep.h"
#include "texture/relief/stretch.h"
#include "texture/relief/sweep_tiles.h"
#include "texture/relief/wall_edges.h"

namespace stucco {
namespace {

constexpr double kCell_m = 0.045;
constexpr double kMostCells = 300'000;
constexpr int kLeastTexels = 2;  // of a cell, a side
constexpr int kBlock = 4;  // cells of a block, a side, that rectangles are first looked for in
// Plain surfaces look alike on any plane: they cost little and count for nothing; as cells where
// photos agree no better they count against what lies back.
constexpr float kTelling = 0.12f;  // mean correlation on either plane
constexpr float kPlainCost = 0.01f;
// To the edge of a plain pane half a metre off a side may go, over a plain wall not.
constexpr float kPlainPaneCost = 0.03f;
constexpr double kLeastTelling = 0.25;  // of a rectangle
constexpr float kLeastGain = 0.06f;     // of the mean correlation of pairs, in what tells
// Mean correlation: of all pairs for what stands out, as nothing hides it from any photo; of the
// better ones for what lies back, as its own reveal does.
constexpr double kLeastCorrelationOut = 0.25;
constexpr double kLeastCorrelationIn = 0.35;
constexpr float kLeastOfCellOut = 0.2f;  // where less, a cell counts against standing out
constexpr double kLeastSquarely = 0.1;   // of the pairs with the squarest photo
constexpr double kLeastArea_m2 = 0.15;
constexpr int kLeastSide = 5;           // cells
constexpr double kLeastSum_m2 = 0.015;  // of area times gain beyond the least
// What stands before the plane belongs to the facet when three photos show it and none the facet
// behind it; else it is a lamp, a car, a branch.
constexpr int kFewestPairs = 3;
constexpr float kBehind = 0.5f;       // of a pair that shows the facet
constexpr double kMostBehind = 0.3;   // of a rectangle
constexpr int kMostRectangles = 400;  // looked at
// How far a side of what lies back may move to an edge: farther first, as far as that is sure.
constexpr double kSnaps_m[] = {1.0, 0.6};
constexpr double kLeastReveal_m = 0.5;  // a side of what lies back

TexelGrid SweepRaster(const TexelGrid& grid) {
  const double needed =
      std::max(kCell_m / grid.texel, std::sqrt(static_cast<double>(grid.size()) / kMostCells));
  return Coarsened(grid, std::max(kLeastTexels, static_cast<int>(std::ceil(needed))));
}

// Nothing where no two photos look at the same part from different enough sides.
std::optional<PlaneSweep> SweepAll(const TexelGrid& raster, const std::vector<SweepTile>& tiles,
                                   const PaintScene& scene) {
  double parallax = 0;
  for (const SweepTile& tile : tiles) parallax = std::max(parallax, LargestParallax(tile.slants));
  if (parallax == 0) return {};
  PlaneSweep sweep = StartSweep(raster, parallax);
  for (const SweepTile& tile : tiles) {
    const TexelGrid part = PartOf(raster, WithRim(tile.cells, raster));
    std::vector<SweepPhoto> photos;
    photos.reserve(tile.photos.size());
    for (const auto& [photo, sees] : tile.photos) {
      photos.push_back(OpenForSweep(scene.sights.photos[photo], part, *scene.cache));
      photos.back().sees = sees;
    }
    SweepPart(tile.cells, photos, sweep);
  }
  return sweep;
}

// Puts rectangles onto other planes, those that gain most first; later ones may lie on earlier
// ones.
class RectangleFinder {
 public:
  RectangleFinder(const PlaneSweep& sweep, const std::vector<SweepTile>& tiles)
      : sweep_(sweep),
        edges_(sweep),
        tiles_(tiles),
        labels_(sweep.raster.size(), sweep.plane),
        best_(sweep.planes) {
    refused_.fill(std::vector<uint8_t>(sweep.raster.size(), 0));
  }

  // By cell, its plane.
  std::vector<int> Find() {
    for (int i = 0; i < kMostRectangles; ++i) {
      const int label = BestLabel();
      if (best_[label]->sum < kLeastSum_m2 / CellArea()) break;
      const Opening opening = LargestOpening(Refined(best_[label]->cells, label), label);
      if (const auto cells = Ended(opening, label)) {
        Take(*cells, label);
      } else {
        Refuse(opening.cells, label);
      }
    }
    return std::move(labels_);
  }

 private:
  enum Side : uint8_t { kBehindIt, kOnIt, kBefore };
  Side SideOf(int label) const {
    if (label == sweep_.plane) return kOnIt;
    return label > sweep_.plane ? kBefore : kBehindIt;
  }
  double CellArea() const { return sweep_.raster.texel * sweep_.raster.texel; }
  size_t CellAt(int column, int row) const {
    return static_cast<size_t>(row) * sweep_.raster.width + column;
  }
  float Best(size_t cell, int label) const {
    return sweep_.best[label * sweep_.raster.size() + cell];
  }
  float All(size_t cell, int label) const {
    return sweep_.all[label * sweep_.raster.size() + cell];
  }
  float Closest(size_t cell, int label) const {
    return sweep_.closest[label * sweep_.raster.size() + cell];
  }
  float Squarest(size_t cell, int label) const {
    return sweep_.squarest[label * sweep_.raster.size() + cell];
  }
  // What lies back lies no farther back: panes show things that are farther off.
  bool IsFree(size_t cell, int label) const {
    return labels_[cell] != label && !refused_[SideOf(label)][cell] &&
           (labels_[cell] >= sweep_.plane || label >= sweep_.plane);
  }
  bool Tells(size_t cell, int label) const {
    return std::max(Best(cell, label), Best(cell, labels_[cell])) >= kTelling;
  }
  Plain PlainAt(size_t cell, int label) const {
    return sweep_.plain[label * sweep_.raster.size() + cell];
  }
  bool IsPlain(size_t cell, int label) const { return PlainAt(cell, label) == Plain::kAround; }

  // What a cell is worth to a rectangle.
  float Worth(size_t cell, int label) const {
    if (!IsFree(cell, label)) return 0;
    const int now = labels_[cell];
    const int front = std::max(label, now);
    if (!Tells(cell, label) || (front > sweep_.plane && IsPlain(cell, front))) {
      // The wall is where nothing speaks against it: rows of windows do not take it with them.
      return label < sweep_.plane && now == sweep_.plane ? -kLeastGain : -kPlainCost;
    }
    // Back between two things that stand out, which hide the wall there from some photos.
    if (now > sweep_.plane && label <= sweep_.plane) return Best(cell, label) - Best(cell, now);
    const float gain = All(cell, label) - All(cell, now) - kLeastGain;
    // Nothing hides what stands out: where photos do not agree, it is not there.
    return label > sweep_.plane ? std::min(gain, All(cell, label) - kLeastOfCellOut) : gain;
  }

  int BestLabel() {
    int best = 0;
    for (int label = 0; label < sweep_.planes; ++label) {
      if (!best_[label]) best_[label] = InBlocks(label);
      if (best_[label]->sum > best_[best]->sum) best = label;
    }
    return best;
  }

  RectangleSum InBlocks(int label) const {
    const int width = (sweep_.raster.width + kBlock - 1) / kBlock;
    const int height = (sweep_.raster.height + kBlock - 1) / kBlock;
    std::vector<float> sums(static_cast<size_t>(width) * height, 0);
    for (int y = 0; y < sweep_.raster.height; ++y) {
      for (int x = 0; x < sweep_.raster.width; ++x) {
        sums[static_cast<size_t>(y / kBlock) * width + x / kBlock] += Worth(CellAt(x, y), label);
      }
    }
    RectangleSum out = BestRectangle(sums, width, height);
    out.cells = {out.cells.left * kBlock, out.cells.top * kBlock,
                 std::min(out.cells.right * kBlock, sweep_.raster.width),
                 std::min(out.cells.bottom * kBlock, sweep_.raster.height)};
    return out;
  }

  // The best rectangle of cells in that of blocks and one block around it.
  CellRectangle Refined(const CellRectangle& blocks, int label) const {
    const CellRectangle around = {std::max(0, blocks.left - kBlock),
                                  std::max(0, blocks.top - kBlock),
                                  std::min(sweep_.raster.width, blocks.right + kBlock),
                                  std::min(sweep_.raster.height, blocks.bottom + kBlock)};
    std::vector<float> worth;
    for (int y = around.top; y < around.bottom; ++y) {
      for (int x = around.left; x < around.right; ++x) worth.push_back(Worth(CellAt(x, y), label));
    }
    CellRectangle out =
        BestRectangle(worth, around.right - around.left, around.bottom - around.top).cells;
    out.left += around.left;
    out.right += around.left;
    out.top += around.top;
    out.bottom += around.top;
    return out;
  }

  // A rectangle, and how far its sides may move.
  struct Opening {
    CellRectangle cells;
    CellRectangle bounds;
  };

  // Windows of one depth come as one rectangle where the wall between them is plain. A strip right
  // across it in which hardly anything speaks for lying back is wall; frames cross what is one
  // window. Of the parts the one for which most speaks.
  Opening LargestOpening(const CellRectangle& cells, int label) const {
    Opening opening = {cells, {0, 0, sweep_.raster.width, sweep_.raster.height}};
    if (SideOf(label) != kBehindIt) return opening;
    auto& [part, bounds] = opening;
    for (int before = 0; part.Cells() != before;) {
      before = part.Cells();
      Cut(ByColumn(part, label), part.left, part.right, bounds.left, bounds.right);
      Cut(ByRow(part, label), part.top, part.bottom, bounds.top, bounds.bottom);
    }
    return opening;
  }

  static void Cut(const std::vector<double>& speaks, int& begin, int& end, int& low, int& high) {
    const Stretch stretch = LargestStretch(speaks);
    if (stretch.low > 0) low = begin + stretch.low;
    if (stretch.high < std::ssize(speaks)) high = begin + stretch.high;
    end = begin + stretch.end;
    begin += stretch.begin;
  }

  // What speaks for the label.
  std::vector<double> ByColumn(const CellRectangle& cells, int label) const {
    std::vector<double> sums;
    sums.reserve(cells.right - cells.left);
    for (int x = cells.left; x < cells.right; ++x) {
      sums.push_back(Speaks({x, cells.top, x + 1, cells.bottom}, label));
    }
    return sums;
  }
  std::vector<double> ByRow(const CellRectangle& cells, int label) const {
    std::vector<double> sums;
    sums.reserve(cells.bottom - cells.top);
    for (int y = cells.top; y < cells.bottom; ++y) {
      sums.push_back(Speaks({cells.left, y, cells.right, y + 1}, label));
    }
    return sums;
  }
  double Speaks(const CellRectangle& cells, int label) const {
    double sum = 0;
    ForAll(cells, [&](size_t cell) { sum += std::max(0.0f, Worth(cell, label)); });
    return sum;
  }

  // The rectangle as it most likely ends; nothing where that is not sure.
  std::optional<CellRectangle> Ended(const Opening& opening, int label) const {
    if (SideOf(label) != kBehindIt) {
      const CellRectangle cells = WithoutRim(opening.cells, label);
      return IsSure(cells, label) ? std::optional(cells) : std::nullopt;
    }
    for (const double reach_m : kSnaps_m) {
      const CellRectangle cells =
          Snapped(opening, label, static_cast<int>(reach_m / sweep_.raster.texel));
      if (IsSure(cells, label)) return cells;
    }
    return std::nullopt;
  }

  // What lies back ends at edges of the wall: plain panes do not tell how far a reveal reaches.
  CellRectangle Snapped(const Opening& opening, int label, int reach) const {
    const auto& [cells, bounds] = opening;
    const CellRectangle part = {
        std::max(bounds.left, cells.left - reach), std::max(bounds.top, cells.top - reach),
        std::min(bounds.right, cells.right + reach), std::min(bounds.bottom, cells.bottom + reach)};
    cv::Mat evidence(part.bottom - part.top, part.right - part.left, CV_32F, cv::Scalar(0));
    for (int y = part.top; y < part.bottom; ++y) {
      for (int x = part.left; x < part.right; ++x) {
        const size_t cell = CellAt(x, y);
        if (!IsFree(cell, label)) continue;
        evidence.at<float>(y - part.top, x - part.left) =
            Tells(cell, label) ? Best(cell, label) - Best(cell, labels_[cell]) : -kPlainPaneCost;
      }
    }
    return edges_.Snap(cells, part, evidence, reach);
  }

  // Windows reach over the edges of what stands out: plain surfaces next to it seem to be as high.
  CellRectangle WithoutRim(CellRectangle cells, int label) const {
    if (label <= sweep_.plane) return cells;
    const CellRectangle whole = cells;
    const auto row = [&](int y) { return CellRectangle{cells.left, y, cells.right, y + 1}; };
    const auto column = [&](int x) { return CellRectangle{x, cells.top, x + 1, cells.bottom}; };
    while (cells.top < whole.top + kReach && IsPlainHere(row(cells.top), label)) ++cells.top;
    while (cells.bottom > whole.bottom - kReach && IsPlainHere(row(cells.bottom - 1), label)) {
      --cells.bottom;
    }
    while (cells.left < whole.left + kReach && IsPlainHere(column(cells.left), label)) ++cells.left;
    while (cells.right > whole.right - kReach && IsPlainHere(column(cells.right - 1), label)) {
      --cells.right;
    }
    return cells;
  }

  bool IsPlainHere(const CellRectangle& cells, int label) const {
    int plain = 0;
    ForAll(cells, [&](size_t cell) { plain += PlainAt(cell, label) != Plain::kNot; });
    return 2 * plain > std::max(0, cells.Cells());
  }

  template <typename Do>
  void ForAll(const CellRectangle& cells, const Do& what) const {
    for (int y = cells.top; y < cells.bottom; ++y) {
      for (int x = cells.left; x < cells.right; ++x) what(CellAt(x, y));
    }
  }

  template <typename Do>
  void ForFree(const CellRectangle& cells, int label, const Do& what) const {
    ForAll(cells, [&](size_t cell) {
      if (IsFree(cell, label)) what(cell);
    });
  }

  bool IsSure(const CellRectangle& cells, int label) const {
    const bool out = label > sweep_.plane;
    double free = 0;
    double telling = 0;
    double correlation = 0;
    double squarely = 0;
    double shown = 0;   // by enough pairs
    double behind = 0;  // before what a pair shows of the plane
    ForFree(cells, label, [&](size_t cell) {
      free += 1;
      shown += sweep_.pairs[cell] >= kFewestPairs;
      behind += Closest(cell, sweep_.plane) >= std::max(kBehind, Closest(cell, label));
      if (!Tells(cell, label)) return;
      telling += 1;
      correlation += out ? All(cell, label) : Best(cell, label);
      squarely += Squarest(cell, label);
    });
    if (!(free * CellArea() >= kLeastArea_m2 && telling >= kLeastTelling * free)) return false;
    if (std::min(cells.right - cells.left, cells.bottom - cells.top) < kLeastSide) return false;
    if (label == sweep_.plane) return true;
    if (!out && !IsWideEnough(cells)) return false;
    // What is beyond the last planes may be farther off.
    if (label == 0 || label + 1 == sweep_.planes) return false;
    if (!out) return correlation >= kLeastCorrelationIn * telling;
    return 2 * shown >= free && behind <= kMostBehind * free &&
           correlation >= kLeastCorrelationOut * telling && squarely >= kLeastSquarely * telling;
  }

  bool IsWideEnough(const CellRectangle& cells) const {
    const int side = std::min(cells.right - cells.left, cells.bottom - cells.top);
    return side * sweep_.raster.texel >= kLeastReveal_m;
  }

  void Take(const CellRectangle& cells, int label) {
    ForFree(cells, label, [&](size_t cell) { labels_[cell] = label; });
    if (label < sweep_.plane) {
      edges_.Remember(cells);
      // Panes as well, which show what is farther off and were refused for it.
      ForAll(cells, [&](size_t cell) {
        if (labels_[cell] == sweep_.plane) labels_[cell] = label;
      });
    }
    if (label > sweep_.plane) RefuseHidden(cells, sweep_.HeightOf(label) / sweep_.raster.texel);
    ForgetOver(cells);
  }

  // What is on the same side there is the same thing seen less well.
  void Refuse(const CellRectangle& cells, int label) {
    ForAll(cells, [&](size_t cell) { refused_[SideOf(label)][cell] = 1; });
    ForgetOver(cells);
  }

  // Whether the way from a place on the plane to a camera goes through a rectangle or below it.
  static bool Hides(const CellRectangle& cells, double height, const Eigen::Vector2d& place,
                    const Eigen::Vector2d& slant) {
    // Where it is over [low, high], of its height.
    const auto over = [](double from, double slope, double low, double high) {
      return std::minmax({(low - from) / slope, (high - from) / slope});
    };
    const auto [u0, u1] = over(place.x(), slant.x(), cells.left, cells.right);
    const auto [v0, v1] = over(place.y(), slant.y(), cells.top, cells.bottom);
    return std::max({u0, v0, 0.0}) < std::min({u1, v1, height});
  }

  // Nothing is looked for at cells of the plane that a rectangle, `height` cells before it,
  // hides from half of the photos: they show its edges there, which look alike on many planes.
  void RefuseHidden(const CellRectangle& cells, double height) {
    for (const SweepTile& tile : tiles_) RefuseHiddenIn(tile, cells, height);
    for (auto& best : best_) best.reset();
  }

  void RefuseHiddenIn(const SweepTile& tile, const CellRectangle& cells, double height) {
    for (int y = tile.cells.top; y < tile.cells.bottom; ++y) {
      for (int x = tile.cells.left; x < tile.cells.right; ++x) {
        const auto hidden = std::ranges::count_if(tile.slants, [&](const auto& slant) {
          return Hides(cells, height, {x + 0.5, y + 0.5}, slant);
        });
        if (2 * hidden < std::ssize(tile.slants)) continue;
        refused_[kBefore][CellAt(x, y)] = 1;
        refused_[kBehindIt][CellAt(x, y)] = 1;
      }
    }
  }

  void ForgetOver(const CellRectangle& cells) {
    for (auto& best : best_) {
      if (best && Overlap(best->cells, cells)) best.reset();
    }
  }

  static bool Overlap(const CellRectangle& a, const CellRectangle& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  }

  const PlaneSweep& sweep_;
  WallEdges edges_;
  const std::vector<SweepTile>& tiles_;
  std::vector<int> labels_;
  // By cell: that it lies on this side of the facet's plane is refused.
  std::array<std::vector<uint8_t>, 3> refused_;
  std::vector<std::optional<RectangleSum>> best_;  // by label, where known, in blocks
};

}  // namespace

std::shared_ptr<const Relief> FindRelief(const Facet& facet, const TexelGrid& grid,
                                         const ViewLimits& limits, const PaintScene& scene) {
  const TexelGrid raster = SweepRaster(grid);
  const std::vector<SweepTile> tiles = CutForSweep(facet, raster, grid.texel, limits, scene);
  const std::optional<PlaneSweep> sweep = SweepAll(raster, tiles, scene);
  if (!sweep) return nullptr;
  const std::vector<int> labels = RectangleFinder(*sweep, tiles).Find();
  const int highest = *std::ranges::max_element(labels);
  if (std::ranges::all_of(labels, [&](int label) { return label == sweep->plane; })) return nullptr;
  auto relief = std::make_shared<Relief>();
  relief->cell = raster.texel;
  relief->width = raster.width;
  relief->height = raster.height;
  relief->step = sweep->step;
  relief->highest = std::max(0.0, sweep->HeightOf(highest));
  for (const int label : labels) {
    relief->heights.push_back(static_cast<float>(sweep->HeightOf(label)));
  }
  return relief;
}

bool LooksForRelief(const Facet& facet, const FacetLook& look, const TextureOptions& options,
                    bool metric) {
  return options.relief && !look.grid && metric && facet.facet_class == FacetClass::kWall;
}

uint64_t ReliefBytes(const TexelGrid& grid) {
  const TexelGrid raster = SweepRaster(grid);
  return PlaneSweepBytes(raster) + kMostTilePhotos * raster.size();  // which photo sees which cell
}

}  // namespace stucco
