// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/ties.h"

#include <algorithm>

#include "survey/parallel.h"

namespace stucco::plan {
namespace {

// Two close partners of a photo stand apart, or they are one.
constexpr double kApart_m = 2;

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
  std::vector<std::pair<int, int>> edges;
  for (size_t a = 0; a < ties.size(); ++a) {
    for (const Partner& b : ties[a].strong) {
      if (a < b.photo) edges.emplace_back(static_cast<int>(a), static_cast<int>(b.photo));
    }
  }
  return ConnectivityOf(static_cast<int>(ties.size()), edges);
}

int LackingPartners(const Ties& ties) {
  return std::max(0, kFewestPartners - static_cast<int>(ties.strong.size()));
}

int LackingClose(const Ties& ties, const Shot& shot) {
  return IsOfFacade(shot) ? std::max(0, kFewestClose - static_cast<int>(ties.close.size())) : 0;
}

}  // namespace stucco::plan
