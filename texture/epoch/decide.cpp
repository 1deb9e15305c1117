// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/epoch/decide.h"

#include <fmt/format.h>

namespace stucco {
namespace {

constexpr double kWellCovered = 0.8;  // of what any photo shows
constexpr double kChanged = 0.1;      // of what both show
constexpr double kMostlyCompared = 0.5;
constexpr double kClearlyFiner = 2.0 / 3;
constexpr double kWorthFilling = 0.05;  // of the facet

std::string Percent(double share) {
  return fmt::format("{:.0f} %", 100 * share);
}

FacetDecision Fill(double gained) {
  return {FacetChoice::kFilled,
          fmt::format("{} of it was not painted before and is now", Percent(gained))};
}

std::string WhyUnchanged(const FacetEvidence& evidence) {
  if (!(evidence.both > 0)) return "new photos show nothing of it that was painted before";
  if (evidence.compared >= kMostlyCompared * evidence.both) return "it has not changed";
  return fmt::format(
      "it has not changed as far as can be told: new photos look at {} of it from too far aside",
      Percent(evidence.both - evidence.compared));
}

// What the user may want to know of a picture that is kept.
std::string Finer(const FacetEvidence& evidence) {
  const bool finer =
      evidence.gsd_before_m > 0 && evidence.gsd_after_m < kClearlyFiner * evidence.gsd_before_m;
  if (!finer) return "";
  return fmt::format("; pixels of new photos are {:.1f} times finer on it (--replace always)",
                     evidence.gsd_before_m / evidence.gsd_after_m);
}

}  // namespace

FacetDecision Decide(ReplaceMode mode, const FacetEvidence& evidence) {
  if (!(evidence.painted_after > 0)) return {FacetChoice::kKept, "no new photo shows it"};
  if (!(evidence.painted_before > 0)) {
    return {FacetChoice::kPainted, "no photo had shown it before"};
  }
  const double gained = evidence.painted_after - evidence.both;
  if (mode == ReplaceMode::kAlways) {
    return {FacetChoice::kReplaced,
            fmt::format("new photos show {} of it", Percent(evidence.painted_after))};
  }
  if (mode == ReplaceMode::kNever) {
    if (gained > 0) return Fill(gained);
    return {FacetChoice::kKept, "all that new photos show of it was painted before"};
  }
  const bool changed = evidence.changed_share >= kChanged;
  const double covered = evidence.painted_after / (evidence.painted_before + gained);
  const std::string change =
      fmt::format("{} of what both show changed", Percent(evidence.changed_share));
  if (covered >= kWellCovered && changed) return {FacetChoice::kReplaced, change};
  if (gained >= kWorthFilling && !changed) return Fill(gained);
  if (changed) {
    return {FacetChoice::kKept, fmt::format("{}, but new photos show too little of it ({} of what "
                                            "any photo shows)",
                                            change, Percent(covered))};
  }
  return {FacetChoice::kKept, WhyUnchanged(evidence) + Finer(evidence)};
}

}  // namespace stucco
