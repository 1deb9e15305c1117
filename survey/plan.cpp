// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/plan.h"

#include <algorithm>
#include <array>
#include <utility>

#include "survey/error.h"

namespace stucco {
namespace {

constexpr std::array<std::pair<ViewKind, std::string_view>, 6> kKinds = {{
    {ViewKind::kDipping, "dipping"},
    {ViewKind::kDippingFoot, "dipping_foot"},
    {ViewKind::kNadir, "nadir"},
    {ViewKind::kOblique, "oblique"},
    {ViewKind::kSurface, "surface"},
    {ViewKind::kLink, "link"},
}};

}  // namespace

std::string_view Name(ViewKind kind) {
  for (const auto& [known, name] : kKinds) {
    if (known == kind) return name;
  }
  throw Error(ErrorKind::kStageFailed, "a view has no kind");
}

std::optional<ViewKind> ViewKindFromName(std::string_view name) {
  for (const auto& [kind, known] : kKinds) {
    if (known == name) return kind;
  }
  return std::nullopt;
}

Eigen::Vector3d Plan::HomeOf(int flight) const {
  const auto index = static_cast<size_t>(flight);
  return flight >= 0 && index < flights.size() ? HomeOf(flights[index]) : home_m;
}

std::vector<Eigen::Vector3d> Plan::Homes() const {
  if (flights.empty()) return {home_m};
  std::vector<Eigen::Vector3d> homes;
  for (const PlannedFlight& flight : flights) {
    const Eigen::Vector3d home = HomeOf(flight);
    if (std::ranges::find(homes, home) == homes.end()) homes.push_back(home);
  }
  return homes;
}

}  // namespace stucco
