// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/point_cloud.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace stucco {
namespace {

constexpr float kNormalTolerance =
    1e-3F;  // normals are single precision and may be rounded in files

}  // namespace

std::optional<std::string> FindProblem(const PointCloud& cloud) {
  const auto misfits = [&](size_t count) { return count != 0 && count != cloud.size(); };
  if (misfits(cloud.normals.size()) || misfits(cloud.colors.size()) ||
      misfits(cloud.views.size())) {
    return fmt::format("{} points have {} normals, {} colours and {} lists of views", cloud.size(),
                       cloud.normals.size(), cloud.colors.size(), cloud.views.size());
  }
  for (size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.positions[i].allFinite()) return fmt::format("point {} is not finite", i);
  }
  for (size_t i = 0; i < cloud.normals.size(); ++i) {
    if (!(std::abs(cloud.normals[i].norm() - 1) <= kNormalTolerance)) {
      return fmt::format("the normal of point {} is not of unit length", i);
    }
  }
  for (size_t i = 0; i < cloud.views.size(); ++i) {
    const auto& views = cloud.views[i];
    if (std::ranges::adjacent_find(views, std::greater_equal<>()) != views.end()) {
      return fmt::format("the views of point {} are not ascending", i);
    }
  }
  return std::nullopt;
}

}  // namespace stucco
