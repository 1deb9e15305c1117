// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/hover_costs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace stucco::plan {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kSameFacade = kLeastWeight;
constexpr double kAdjacentFacades = 0.75;
constexpr double kLeastExponentLength_m = 1;

void SortOnce(std::vector<int>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

bool HaveCommon(const std::vector<int>& a, const std::vector<int>& b) {
  size_t i = 0;
  size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (a[i] == b[j]) return true;
    a[i] < b[j] ? ++i : ++j;
  }
  return false;
}

// For each facade those that share a corner with it, itself excluded.
std::vector<std::vector<int>> AdjacentFacades(const Site& site) {
  std::vector<std::tuple<double, double, int>> ends;
  for (size_t k = 0; k < site.facades.size(); ++k) {
    for (const Vector2d& end : {site.facades[k].a, site.facades[k].b}) {
      ends.emplace_back(end.x(), end.y(), static_cast<int>(k));
    }
  }
  std::sort(ends.begin(), ends.end());
  std::vector<std::vector<int>> adjacent(site.facades.size());
  for (size_t first = 0; first < ends.size();) {
    size_t last = first;
    while (last < ends.size() && std::get<0>(ends[last]) == std::get<0>(ends[first]) &&
           std::get<1>(ends[last]) == std::get<1>(ends[first])) {
      ++last;
    }
    for (size_t i = first; i < last; ++i) {
      for (size_t j = first; j < last; ++j) {
        const int facade = std::get<2>(ends[i]);
        const int other = std::get<2>(ends[j]);
        if (facade != other) adjacent[facade].push_back(other);
      }
    }
    first = last;
  }
  return adjacent;
}

}  // namespace

HoverCosts::HoverCosts(const SafeSpace& space, std::span<const Hover> hovers)
    : space_(&space), hovers_(hovers) {
  const auto adjacent = AdjacentFacades(space.obstacles().site());
  for (const Hover& hover : hovers) {
    std::vector<int> facades;
    for (const Shot& shot : hover.shots) {
      for (const Target& target : shot.targets) facades.push_back(target.facade);
    }
    SortOnce(facades);
    std::vector<int> beside;
    for (const int facade : facades) {
      beside.insert(beside.end(), adjacent[facade].begin(), adjacent[facade].end());
    }
    SortOnce(beside);
    facades_.push_back(std::move(facades));
    adjacent_facades_.push_back(std::move(beside));
    directions_.push_back(hover.shots.empty() ? Vector3d::Zero() : hover.shots.front().Direction());
    directions_.push_back(hover.shots.empty() ? Vector3d::Zero() : hover.shots.back().Direction());
  }
}

double HoverCosts::Weight(int i, int j) const {
  if (HaveCommon(facades_[i], facades_[j])) return kSameFacade;
  return HaveCommon(adjacent_facades_[i], facades_[j]) ? kAdjacentFacades : 1;
}

double HoverCosts::Turn(Port a, Port b) const {
  const Vector3d& u = directions_[a];
  const Vector3d& v = directions_[b];
  const double cosine = u.dot(v);
  if (cosine >= 1 - 1e-12) return 0;
  // A hover without photos has no direction to turn from.
  if (u == Vector3d::Zero() || v == Vector3d::Zero()) return 0;
  return std::acos(std::max(cosine, -1.0));
}

double HoverCosts::LeastTurn(int i, int j) const {
  double least = std::numbers::pi;
  for (const Port a : {2 * i, 2 * i + 1}) {
    for (const Port b : {2 * j, 2 * j + 1}) least = std::min(least, Turn(a, b));
  }
  return least;
}

double HoverCosts::Cost(double weight, double length_m, double turn_rad) {
  if (turn_rad == 0) return weight * length_m;
  return weight * length_m * std::exp(turn_rad / std::max(length_m, kLeastExponentLength_m));
}

// l exp(alpha / l) falls with l between one metre and alpha metres and grows elsewhere, so a path
// longer than the straight line may cost less than that line, but not less than at l = alpha.
double HoverCosts::LeastCost(int i, int j) const {
  const double turn = LeastTurn(i, j);
  const double weight = Weight(i, j);
  const double straight = Cost(weight, Straight(i, j), turn);
  if (turn <= kLeastExponentLength_m || Straight(i, j) >= turn) return straight;
  return std::min(straight, Cost(weight, turn, turn));
}

double HoverCosts::CheapestCost(int i, int j) const {
  return Cost(Weight(i, j), Length(i, j), LeastTurn(i, j));
}

}  // namespace stucco::plan
