// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/heading.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calib/records/position_witnesses.h"
#include "survey/median.h"

namespace stucco {
namespace {

constexpr int kHeadingRounds = 10;

// Where a photo stands and where its record has it, about the middles of both in its flight.
struct Arm {
  Eigen::Vector2d posed;
  Eigen::Vector2d recorded;
};

Eigen::Vector2d MiddleOf(const std::vector<Eigen::Vector2d>& vectors) {
  std::vector<double> x;
  std::vector<double> y;
  for (const Eigen::Vector2d& v : vectors) {
    x.push_back(v.x());
    y.push_back(v.y());
  }
  return {Median(std::move(x)).value_or(0), Median(std::move(y)).value_or(0)};
}

std::vector<std::vector<Arm>> FlightsOf(const std::vector<PoseRecord>& records,
                                        const Scene& scene) {
  const std::vector<bool> tells = PositionWitnesses(records, scene);
  std::map<int, std::vector<Arm>> flights;
  for (size_t i = 0; i < records.size(); ++i) {
    if (!tells[i]) continue;
    flights[records[i].flight].push_back(
        {scene.photos[i].pose->Center().head<2>(), records[i].position->position.head<2>()});
  }
  std::vector<std::vector<Arm>> result(1);  // what has no shift of its own, together
  for (auto& [flight, arms] : flights) {
    if (arms.size() < kEnoughForOneFlight) {
      result[0].insert(result[0].end(), arms.begin(), arms.end());
    } else {
      result.push_back(std::move(arms));
    }
  }
  std::erase_if(result, [](const std::vector<Arm>& arms) { return arms.size() < 2; });
  return result;
}

// About the mean of where photos stand; what is off there by the median is the flight's shift.
std::vector<Arm> AboutMiddles(const std::vector<std::vector<Arm>>& flights, double turn_rad) {
  std::vector<Arm> all;
  for (const std::vector<Arm>& flight : flights) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Arm& arm : flight) mean += arm.posed;
    mean /= static_cast<double>(flight.size());
    std::vector<Eigen::Vector2d> off;
    off.reserve(flight.size());
    for (const Arm& arm : flight) {
      off.emplace_back(arm.recorded - mean - Eigen::Rotation2Dd(turn_rad) * (arm.posed - mean));
    }
    const Eigen::Vector2d shift = MiddleOf(off);
    for (const Arm& arm : flight) all.push_back({arm.posed - mean, arm.recorded - mean - shift});
  }
  return all;
}

}  // namespace

SceneHeading HeadingByPositions(const std::vector<PoseRecord>& records, const Scene& scene) {
  const std::vector<std::vector<Arm>> flights = FlightsOf(records, scene);
  SceneHeading heading;
  if (flights.empty()) return heading;
  for (int round = 0; round < kHeadingRounds; ++round) {
    const std::vector<Arm> arms = AboutMiddles(flights, heading.turn_rad);
    std::vector<Eigen::Vector2d> turned;
    std::vector<double> rests;
    for (const Arm& arm : arms) {
      turned.emplace_back(Eigen::Rotation2Dd(heading.turn_rad) * arm.posed);
      const Eigen::Vector2d rest = arm.recorded - turned.back();
      rests.push_back(std::abs(rest.x()));
      rests.push_back(std::abs(rest.y()));
    }
    const double scale =
        std::max(kLeastPosition_m, Median(std::move(rests)).value_or(0) / kMedianOfNormal);
    double squares = 0;
    double moment = 0;
    for (size_t i = 0; i < arms.size(); ++i) {
      const Eigen::Vector2d rest = arms[i].recorded - turned[i];
      const double r = rest.norm() / (2 * scale);
      const double weight = 1 / (1 + r * r);
      squares += weight * turned[i].squaredNorm();
      moment += weight * (turned[i].x() * rest.y() - turned[i].y() * rest.x());
    }
    if (squares <= 0) return {};
    heading.turn_rad += moment / squares;
    heading.sigma_rad = std::min(std::numbers::pi, scale / std::sqrt(squares));
  }
  return heading;
}

}  // namespace stucco
