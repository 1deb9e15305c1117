// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/speckles.h"

#include <cmath>
#include <vector>

namespace stucco {

void RemoveSpeckles(int min_pixels, float max_step, DepthMap& map) {
  std::vector<char> visited(map.depths.size(), 0);
  std::vector<size_t> piece;
  for (size_t start = 0; start < map.depths.size(); ++start) {
    if (visited[start] || map.depths[start] <= 0) continue;
    piece.assign(1, start);
    visited[start] = 1;
    for (size_t next = 0; next < piece.size(); ++next) {
      const size_t at = piece[next];
      const int x = static_cast<int>(at % map.width);
      const int y = static_cast<int>(at / map.width);
      const int neighbours[4][2] = {{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}};
      for (const auto& [nx, ny] : neighbours) {
        if (nx < 0 || ny < 0 || nx >= map.width || ny >= map.height) continue;
        const size_t other = map.Index(nx, ny);
        if (visited[other] || map.depths[other] <= 0) continue;
        if (std::abs(map.depths[other] - map.depths[at]) > max_step * map.depths[at]) continue;
        visited[other] = 1;
        piece.push_back(other);
      }
    }
    if (static_cast<int>(piece.size()) >= min_pixels) continue;
    for (const size_t at : piece) map.depths[at] = 0;
  }
}

}  // namespace stucco
