// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "plan/site.h"
#include "survey/intervals.h"

namespace stucco::plan {

struct Candidate;
struct DippingSetting;

// From how far away each part of a wall may be captured: at most `kFarther` times the distance from
// which it can be, or a fifth of d_max where that is more (pixels five times as fine as asked for
// are near enough). Without it a point in the open that sees thirty walls from afar outweighs the
// points in front of them (eq. 3 sums over walls), and textures get coarse for the sake of few
// stops.
class Reach {
 public:
  static constexpr double kFarther = 1.6;
  static constexpr double kNearEnough = 0.2;  // of d_max

  Reach() = default;  // no limit
  // From all that the candidates see. A stretch that can be seen at 45 degrees or less is limited
  // by such views, others by all; nothing that one of the candidates sees is lost.
  Reach(const DippingSetting& setting, std::span<const Candidate> candidates);

  // What of `seen` may be captured from p.
  Intervals Within(int facade, const Facade& wall, const Eigen::Vector2d& p, Intervals seen) const;

 private:
  std::vector<std::vector<double>> limits_m_;  // by facade, by equal stretches from a
};

}  // namespace stucco::plan
