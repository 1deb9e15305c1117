// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/expected_matches.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <string>
#include <tuple>

#include "plan/match/ties.h"

namespace stucco::plan {
namespace {

// Partners that a photo has besides are no news.
constexpr size_t kMostPartners = 12;
constexpr size_t kWeakest = 10;

TiedView Describe(const PlannedView& view, const Shot& shot, const Ties& ties) {
  TiedView out{.view = view.id,
               .partners = static_cast<int>(ties.strong.size()),
               .close = static_cast<int>(ties.close.size()),
               .strength = 0,
               .facades = {},
               .is_loose = LackingPartners(ties) + LackingClose(ties, shot) > 0};
  for (const Partner& partner : ties.strong) out.strength += partner.strength;
  for (const PlannedTarget& target : view.targets) {
    if (std::ranges::find(out.facades, target.facade) == out.facades.end()) {
      out.facades.push_back(target.facade);
    }
  }
  return out;
}

// Counts the photos outside of the largest part, and what they are meant for.
void DescribeParts(const Connectivity& whole, const Plan& plan, MatchStats& stats) {
  std::vector<int> photos(whole.parts, 0);
  for (const int part : whole.part) ++photos[part];
  const auto largest = static_cast<int>(std::ranges::max_element(photos) - photos.begin());
  std::set<std::string> buildings;
  for (size_t i = 0; i < plan.views.size(); ++i) {
    if (whole.part[i] == largest) continue;
    ++stats.apart;
    for (const PlannedTarget& target : plan.views[i].targets) {
      buildings.insert(target.facade.substr(0, target.facade.find('/')));
    }
  }
  stats.apart_of.assign(buildings.begin(), buildings.end());
}

}  // namespace

MatchStats ExpectMatches(const PhotoGraph& photos, std::span<const Hover> hovers, int threads,
                         Plan& plan) {
  assert(photos.graph.size() == plan.views.size());
  std::vector<Ties> ties = TiesOf(photos, hovers, threads);
  const Connectivity whole = ConnectivityOf(ties);
  MatchStats stats{.parts = whole.parts,
                   .bridges = static_cast<int>(whole.bridges.size()),
                   .hanging = 0,
                   .loose = 0,
                   .weakest = {}};
  DescribeParts(whole, plan, stats);
  for (const LooseGroup& group : LooseGroups(photos.places, ties)) {
    if (group.on >= 0) stats.hanging += static_cast<int>(group.photos.size());
  }
  for (size_t i = 0; i < ties.size(); ++i) {
    PlannedView& view = plan.views[i];
    std::ranges::stable_sort(ties[i].strong, std::ranges::greater{}, &Partner::strength);
    for (const Partner& partner : ties[i].strong) {
      if (view.partners.size() == kMostPartners) break;
      view.partners.push_back({plan.views[partner.photo].id, partner.strength});
    }
    const PhotoPlace& place = photos.places[i];
    stats.weakest.push_back(Describe(view, hovers[place.hover].shots[place.shot], ties[i]));
    view.is_loose = stats.weakest.back().is_loose;
    stats.loose += view.is_loose;
  }
  std::ranges::stable_sort(stats.weakest, {}, [](const TiedView& view) {
    return std::tuple(!view.is_loose, view.strength);
  });
  stats.weakest.resize(
      std::min(stats.weakest.size(), std::max<size_t>(kWeakest, static_cast<size_t>(stats.loose))));
  return stats;
}

}  // namespace stucco::plan
