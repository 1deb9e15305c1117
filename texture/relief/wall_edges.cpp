// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/wall_edges.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stucco {
namespace {

constexpr float kSharpEdge = 12;  // grey levels from cell to cell: sharper edges count for no more
constexpr float kEdgeWorth = 0.3f;  // of a cell's length of such an edge, in correlations of a cell
constexpr float kLineWorth = 0.15f;  // likewise, on the line of another window's side
constexpr int kSnapRounds = 3;
constexpr int kLeastOpeningSide = 5;  // cells

// Of a part of the raster, from sums over all cells above and left of each corner.
class PartSums {
 public:
  PartSums(const CellRectangle& part, const cv::Mat& values) : part_(part) {
    cv::integral(values, sums_, CV_64F);
  }

  double Over(const CellRectangle& cells) const {
    return At(cells.right, cells.bottom) - At(cells.left, cells.bottom) -
           At(cells.right, cells.top) + At(cells.left, cells.top);
  }

 private:
  double At(int x, int y) const { return sums_.at<double>(y - part_.top, x - part_.left); }

  CellRectangle part_;
  cv::Mat sums_;
};

}  // namespace

WallEdges::WallEdges(const PlaneSweep& sweep) : sweep_(sweep) {
  const auto columns = static_cast<size_t>(sweep.raster.width) + 1;
  const auto rows = static_cast<size_t>(sweep.raster.height) + 1;
  for (const int side : {0, 1}) lines_[side].resize(columns, false);
  for (const int side : {2, 3}) lines_[side].resize(rows, false);
}

void WallEdges::Remember(const CellRectangle& cells) {
  lines_[0][cells.left] = true;
  lines_[1][cells.right] = true;
  lines_[2][cells.top] = true;
  lines_[3][cells.bottom] = true;
}

float WallEdges::Between(int x, int y, int beside_x, int beside_y) const {
  const int width = sweep_.raster.width;
  if (std::min(beside_x, beside_y) < 0 || beside_x >= width || beside_y >= sweep_.raster.height) {
    return 0;
  }
  const float a = sweep_.grey[static_cast<size_t>(y) * width + x];
  const float b = sweep_.grey[static_cast<size_t>(beside_y) * width + beside_x];
  return a < 0 || b < 0 ? 0 : std::min(1.0f, std::abs(a - b) / kSharpEdge);
}

std::array<float, 4> WallEdges::Along(const CellRectangle& cells) const {
  std::array<float, 4> sums = {};
  for (int y = cells.top; y < cells.bottom; ++y) {
    sums[0] += Between(cells.left, y, cells.left - 1, y);
    sums[1] += Between(cells.right - 1, y, cells.right, y);
  }
  for (int x = cells.left; x < cells.right; ++x) {
    sums[2] += Between(x, cells.top, x, cells.top - 1);
    sums[3] += Between(x, cells.bottom - 1, x, cells.bottom);
  }
  const auto width = static_cast<float>(cells.right - cells.left);
  const auto height = static_cast<float>(cells.bottom - cells.top);
  return {sums[0] / height, sums[1] / height, sums[2] / width, sums[3] / width};
}

CellRectangle WallEdges::Snap(CellRectangle cells, const CellRectangle& part,
                              const cv::Mat& evidence, int reach) const {
  const CellRectangle found = cells;
  const PartSums sums(part, evidence);
  const auto worth = [&](const CellRectangle& at) {
    const auto [left, right, top, bottom] = Along(at);
    const auto width = static_cast<float>(at.right - at.left);
    const auto height = static_cast<float>(at.bottom - at.top);
    return kEdgeWorth * ((left + right) * height + (top + bottom) * width) + sums.Over(at);
  };
  const auto snap = [&](int CellRectangle::*side, int low, int high, const auto& lines,
                        int length) {
    // Only of the side that is moved: those next to it would gain by growing along their lines.
    const double on_line = kLineWorth * length;
    CellRectangle best = cells;
    double most = worth(cells) + (lines[cells.*side] ? on_line : 0);
    const int last = std::min(high, found.*side + reach);
    for (int at = std::max(low, found.*side - reach); at <= last; ++at) {
      CellRectangle moved = cells;
      moved.*side = at;
      if (std::min(moved.right - moved.left, moved.bottom - moved.top) < kLeastOpeningSide)
        continue;
      const double now = worth(moved) + (lines[at] ? on_line : 0);
      if (now <= most) continue;
      most = now;
      best = moved;
    }
    cells = best;
  };
  for (int round = 0; round < kSnapRounds; ++round) {
    snap(&CellRectangle::left, part.left, part.right, lines_[0], cells.bottom - cells.top);
    snap(&CellRectangle::right, part.left, part.right, lines_[1], cells.bottom - cells.top);
    snap(&CellRectangle::top, part.top, part.bottom, lines_[2], cells.right - cells.left);
    snap(&CellRectangle::bottom, part.top, part.bottom, lines_[3], cells.right - cells.left);
  }
  return cells;
}

}  // namespace stucco
