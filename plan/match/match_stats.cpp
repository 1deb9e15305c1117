// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/match_stats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

namespace stucco::plan {
namespace {

constexpr size_t kMostNamed = 8;

std::string Named(std::vector<std::string> names) {
  const size_t more = names.size() > kMostNamed ? names.size() - kMostNamed : 0;
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

std::string Parts(const MatchStats& stats) {
  const std::string whose =
      stats.apart_of.empty() ? "" : fmt::format(" (of {})", Named(stats.apart_of));
  return fmt::format(
      "the photos fall into {} parts with nothing that ties them: {} of them{} hang with the "
      "others "
      "by their recorded positions only. Add photos of the ground between them, or plan each part "
      "as a survey of its own",
      stats.parts, stats.apart, whose);
}

std::string Loose(const MatchStats& stats, bool links_tried) {
  std::set<std::string> facades;
  int photos = 0;
  for (const TiedView& view : stats.weakest) {
    if (!view.is_loose || view.facades.empty()) continue;
    ++photos;
    facades.insert(view.facades.begin(), view.facades.end());
  }
  const std::string why = links_tried
                              ? "no place was found from which a photo would tie them to the others"
                              : "this plan has no link photos";
  if (photos == 0) {
    return fmt::format("photos from above that hang loose: {}; {}", stats.loose, why);
  }
  return fmt::format("photos of facades that hang loose: {}; {}. Their facades: {}", photos, why,
                     Named({facades.begin(), facades.end()}));
}

}  // namespace

std::vector<std::string> MatchWarnings(const MatchStats& stats, bool links_tried) {
  std::vector<std::string> warnings;
  if (stats.parts > 1) warnings.push_back(Parts(stats));
  if (stats.loose > 0) warnings.push_back(Loose(stats, links_tried));
  if (stats.hanging > 0) {
    warnings.push_back(fmt::format(
        "photos that those of a single stop tie to the others: {}; should these fail, so do they",
        stats.hanging));
  }
  return warnings;
}

}  // namespace stucco::plan
