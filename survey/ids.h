// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <limits>

namespace stucco {

// Distinct types, so that a camera cannot be passed where a photo is meant.
template <typename Tag, typename Value = uint32_t>
struct Id {
  Value value = std::numeric_limits<Value>::max();
  constexpr auto operator<=>(const Id&) const = default;  // NOLINT(modernize-use-nullptr)
  constexpr bool IsValid() const { return value != std::numeric_limits<Value>::max(); }
};

using CameraId = Id<struct CameraTag>;
using PhotoId = Id<struct PhotoTag>;
using PointId = Id<struct PointTag, uint64_t>;

}  // namespace stucco

template <typename Tag, typename Value>
struct std::hash<stucco::Id<Tag, Value>> {
  size_t operator()(stucco::Id<Tag, Value> id) const noexcept {
    return std::hash<Value>()(id.value);
  }
};
