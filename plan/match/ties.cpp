// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/ties.h"

#include <algorithm>
#include <set>
#include <utility>

#include "survey/parallel.h"

namespace stucco::plan {
namespace {

// Two close partners of a photo stand apart, or they are one.
constexpr double kApart_m = 2;

Edges EdgesOf(const std::vector<Ties>& ties) {
  Edges edges;
  for (size_t a = 0; a < ties.size(); ++a) {
    for (const Partner& b : ties[a].strong) {
      if (a < b.photo) edges.emplace_back(static_cast<int>(a), static_cast<int>(b.photo));
    }
  }
  return edges;
}

// The graph of hovers whose photos match.
std::vector<LooseGroup> HangingFromHovers(std::span<const PhotoPlace> places,
                                          const std::vector<Ties>& ties) {
  int hovers = 0;
  for (const PhotoPlace& place : places) {
    hovers = std::max(hovers, static_cast<int>(place.hover) + 1);
  }
  std::set<std::pair<int, int>> pairs;
  for (const auto& [a, b] : EdgesOf(ties)) {
    pairs.insert(std::minmax(static_cast<int>(places[a].hover), static_cast<int>(places[b].hover)));
  }
  std::vector<LooseGroup> groups;
  std::vector<int> group_of(hovers, -1);
  for (const HangingGroup& hanging : HangingGroups(hovers, Edges(pairs.begin(), pairs.end()))) {
    for (const int hover : hanging.nodes) group_of[hover] = static_cast<int>(groups.size());
    groups.push_back({.photos = {}, .on = hanging.on});
  }
  for (uint32_t photo = 0; photo < places.size(); ++photo) {
    const int group = group_of[places[photo].hover];
    if (group >= 0) groups[group].photos.push_back(photo);
  }
  return groups;
}

}  // namespace

bool IsOfFacade(const Shot& shot) {
  return shot.kind == ViewKind::kDipping || shot.kind == ViewKind::kDippingFoot;
}

bool StandsApart(const MatchGraph& graph, const Ties& ties, const Eigen::Vector3d& position) {
  return std::ranges::none_of(ties.close, [&](uint32_t other) {
    return (graph.position(other) - position).norm() < kApart_m;
  });
}

std::vector<Ties> TiesOf(const PhotoGraph& photos, std::span<const Hover> hovers, int threads) {
  std::vector<Ties> out(photos.graph.size());
  ParallelFor(out.size(), threads, [&](size_t i) {
    const PhotoPlace& place = photos.places[i];
    const bool of_facade = IsOfFacade(hovers[place.hover].shots[place.shot]);
    for (const Partner& partner : photos.graph.PartnersOf(static_cast<uint32_t>(i))) {
      if (partner.strength >= kEnoughStrength) out[i].strong.push_back(partner);
      if (of_facade && partner.close_walls >= kCloseShare &&
          StandsApart(photos.graph, out[i], photos.graph.position(partner.photo))) {
        out[i].close.push_back(partner.photo);
      }
    }
  });
  return out;
}

Connectivity ConnectivityOf(const std::vector<Ties>& ties) {
  return ConnectivityOf(static_cast<int>(ties.size()), EdgesOf(ties));
}

std::vector<LooseGroup> LooseGroups(std::span<const PhotoPlace> places,
                                    const std::vector<Ties>& ties) {
  std::vector<LooseGroup> groups = HangingFromHovers(places, ties);
  const auto held = [&](int photo) {
    return std::ranges::any_of(groups, [&](const LooseGroup& group) { return group.Holds(photo); });
  };
  // Photos of one hover need not match others together.
  for (const HangingGroup& hanging : HangingGroups(static_cast<int>(ties.size()), EdgesOf(ties))) {
    if (std::ranges::any_of(hanging.nodes, held)) continue;
    groups.push_back({.photos = {hanging.nodes.begin(), hanging.nodes.end()},
                      .on = hanging.on < 0 ? -1 : static_cast<int>(places[hanging.on].hover)});
  }
  return groups;
}

int LackingPartners(const Ties& ties) {
  return std::max(0, kFewestPartners - static_cast<int>(ties.strong.size()));
}

int LackingClose(const Ties& ties, const Shot& shot) {
  return IsOfFacade(shot) ? std::max(0, kFewestClose - static_cast<int>(ties.close.size())) : 0;
}

}  // namespace stucco::plan
