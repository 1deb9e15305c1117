// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/lost_walls.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "survey/parallel.h"

namespace stucco::plan {
namespace {

// A piece of wall that is missing, with the hovers of the grid that see it.
using Seers = std::vector<uint32_t>;

std::vector<Seers> SeersOf(const FacadeSight& sight, int facade, std::span<const uint32_t> cells) {
  std::vector<Seers> out(cells.size());
  for (const SeenView& view : sight.ViewsOf(facade, cells)) {
    for (const uint32_t cell : view.cells) {
      Seers& seers = out[std::ranges::lower_bound(cells, cell) - cells.begin()];
      const auto hover = static_cast<uint32_t>(view.place);
      if (seers.empty() || seers.back() != hover) seers.push_back(hover);
    }
  }
  std::erase_if(out, [](const Seers& seers) { return seers.empty(); });
  return out;
}

// Greedy set cover.
std::vector<uint32_t> Cover(std::vector<Seers> lost, size_t hovers) {
  std::vector<size_t> shows(hovers);
  for (const Seers& seers : lost) {
    for (const uint32_t hover : seers) ++shows[hover];
  }
  std::vector<uint32_t> out;
  while (!lost.empty()) {
    const auto best = static_cast<uint32_t>(std::ranges::max_element(shows) - shows.begin());
    out.push_back(best);
    std::erase_if(lost, [&](const Seers& seers) {
      if (!std::ranges::binary_search(seers, best)) return false;
      for (const uint32_t hover : seers) --shows[hover];
      return true;
    });
  }
  std::ranges::sort(out);
  return out;
}

}  // namespace

std::vector<uint32_t> HoversForLostWalls(const FacadeSight& full, const FacadeSight& kept,
                                         int threads) {
  std::vector<std::vector<Seers>> lost(full.site().facades.size());
  ParallelFor(lost.size(), threads, [&](size_t i) {
    const int facade = static_cast<int>(i);
    const std::vector<uint32_t> unseen = kept.Unseen(facade);
    if (!unseen.empty()) lost[i] = SeersOf(full, facade, unseen);
  });
  std::vector<Seers> all;
  for (auto& of_facade : lost) std::ranges::move(of_facade, std::back_inserter(all));
  return Cover(std::move(all), full.hovers().size());
}

void PutBack(const Hover& hover, std::vector<Hover>& hovers) {
  const auto there = std::ranges::find(hovers, hover.position, &Hover::position);
  if (there == hovers.end()) {
    hovers.push_back(hover);
  } else {
    there->shots = hover.shots;
  }
}

}  // namespace stucco::plan
