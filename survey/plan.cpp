// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/plan.h"

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

}  // namespace stucco
