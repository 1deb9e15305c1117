// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/semi_global.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace stucco {
namespace {

struct Penalties {
  float small = 0;
  float large = 0;
};

// The costs of one cell by way of the cell before it on its path, whose own are `before`.
void Step(std::span<const float> costs, std::span<const float> before, const Penalties& penalties,
          std::span<float> path) {
  const float least = *std::ranges::min_element(before);
  const size_t last = costs.size() - 1;
  for (size_t l = 0; l <= last; ++l) {
    float best = std::min(before[l], least + penalties.large);
    if (l > 0) best = std::min(best, before[l - 1] + penalties.small);
    if (l < last) best = std::min(best, before[l + 1] + penalties.small);
    path[l] = costs[l] + best - least;
  }
}

// Adds the costs of all paths in the direction (dx, dy).
void AddPaths(const LabelCosts& costs, std::pair<int, int> direction, const Penalties& penalties,
              std::vector<float>& sums) {
  const auto [dx, dy] = direction;
  const auto labels = static_cast<size_t>(costs.labels);
  std::vector<float> paths(costs.costs.size());
  const auto path = [&](size_t cell) { return std::span(paths).subspan(cell * labels, labels); };
  for (int j = 0; j < costs.height; ++j) {
    const int y = dy < 0 ? costs.height - 1 - j : j;
    for (int i = 0; i < costs.width; ++i) {
      const int x = dx < 0 ? costs.width - 1 - i : i;
      const size_t cell = static_cast<size_t>(y) * costs.width + x;
      const int from_x = x - dx;
      const int from_y = y - dy;
      if (from_x < 0 || from_y < 0 || from_x >= costs.width || from_y >= costs.height) {
        std::ranges::copy(costs.Of(cell), path(cell).begin());
      } else {
        Step(costs.Of(cell), path(static_cast<size_t>(from_y) * costs.width + from_x), penalties,
             path(cell));
      }
    }
  }
  for (size_t i = 0; i < sums.size(); ++i) sums[i] += paths[i];
}

}  // namespace

std::vector<int> MatchSemiGlobally(const LabelCosts& costs, float small, float large) {
  assert(costs.labels > 0 && small <= large);
  const auto cells = static_cast<size_t>(costs.width) * costs.height;
  assert(costs.costs.size() == cells * costs.labels);
  std::vector<float> sums(costs.costs.size(), 0);
  constexpr std::array<std::pair<int, int>, 8> kDirections = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
  for (const auto& direction : kDirections) AddPaths(costs, direction, {small, large}, sums);
  std::vector<int> labels(cells);
  for (size_t cell = 0; cell < cells; ++cell) {
    const auto of = std::span(sums).subspan(cell * costs.labels, costs.labels);
    labels[cell] = static_cast<int>(std::ranges::min_element(of) - of.begin());
  }
  return labels;
}

}  // namespace stucco
