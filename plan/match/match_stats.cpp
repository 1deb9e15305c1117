// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/match_stats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

namespace stucco::plan {
namespace {

constexpr size_t kMostNamed = 8;

}  // namespace

std::string LooseFacades(const MatchStats& stats) {
  std::set<std::string> facades;
  int photos = 0;
  for (const TiedView& view : stats.weakest) {
    if (!view.is_loose || view.facades.empty()) continue;
    ++photos;
    facades.insert(view.facades.begin(), view.facades.end());
  }
  if (photos == 0) return {};
  std::vector<std::string> named(facades.begin(), facades.end());
  const size_t more = named.size() > kMostNamed ? named.size() - kMostNamed : 0;
  named.resize(named.size() - more);
  return fmt::format(
      "photos of facades that hang loose: {}; no place from which a photo would tie them to the "
      "others "
      "is free. Their facades: {}{}",
      photos, fmt::join(named, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace stucco::plan
