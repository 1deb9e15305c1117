// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "texture/relief/best_rectangle.h"
#include "texture/relief/plane_sweep.h"

namespace stucco {

// Edges of a wall: sharp in the mean of all photos on its plane, where reveals end. What lies
// before or behind the plane is blurred there.
class WallEdges {
 public:
  // The sweep must outlive this.
  explicit WallEdges(const PlaneSweep& sweep);

  // Windows stand in rows and columns: from now on sides go to the lines of this one's rather.
  void Remember(const CellRectangle& cells);

  // How sharp the edges along the left, right, upper and lower side of a rectangle are, means from
  // 0 to 1.
  std::array<float, 4> Along(const CellRectangle& cells) const;

  // The rectangle with its sides moved, one after the other and by at most `reach` cells, to where
  // edges and evidence together speak most for it. `evidence`: by cell of `part`, which holds the
  // rectangle, what speaks for the cell being inside; sums of correlations.
  CellRectangle Snap(CellRectangle cells, const CellRectangle& part, const cv::Mat& evidence,
                     int reach) const;

 private:
  float Between(int x, int y, int beside_x, int beside_y) const;

  const PlaneSweep& sweep_;
  // Where left, right, upper and lower sides of remembered ones are, by column or row.
  std::array<std::vector<bool>, 4> lines_;
};

}  // namespace stucco
