// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/fit_control.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace stucco {
namespace {

constexpr double kLeastTolerance_m = 0.15;
constexpr double kToleranceOfExtent = 0.02;
constexpr int kMostTriples = 3000;
constexpr size_t kAllTriplesUpTo = 27;  // points: 2925 triples
// Points this much nearer to a line than they reach along it leave the turn about it open.
constexpr double kLeastAcross = 0.05;
constexpr double kLeastAcross_m = 0.2;
// What a frame that positions and gimbals hold is off by.
constexpr double kTilt_rad = 0.02;
constexpr double kHeading_rad = 0.1;
constexpr double kScale = 0.02;

using Triple = std::array<int, 3>;

std::vector<Triple> TriplesOf(size_t count) {
  std::vector<Triple> triples;
  const int n = static_cast<int>(count);
  if (count <= kAllTriplesUpTo) {
    for (int a = 0; a < n; ++a) {
      for (int b = a + 1; b < n; ++b) {
        for (int c = b + 1; c < n; ++c) triples.push_back({a, b, c});
      }
    }
    return triples;
  }
  std::mt19937 random(1);
  while (triples.size() < kMostTriples) {
    Triple triple{};
    for (int& i : triple) i = static_cast<int>(random() % count);
    std::ranges::sort(triple);
    if (triple[0] != triple[1] && triple[1] != triple[2]) triples.push_back(triple);
  }
  return triples;
}

template <typename Indices>
Similarity AlignPairs(std::span<const PointPair> pairs, const Indices& indices) {
  Eigen::Matrix3Xd source(3, indices.size());
  Eigen::Matrix3Xd target(3, indices.size());
  Eigen::Index column = 0;
  for (const int i : indices) {
    source.col(column) = pairs[i].in_scene;
    target.col(column++) = pairs[i].surveyed;
  }
  return AlignPoints(source, target);
}

// Standard deviations of surveyed points along their line and across it (the lesser of what is
// across does not matter: points in a plane are enough).
template <typename Indices>
Eigen::Vector2d Extents(std::span<const PointPair> pairs, const Indices& indices) {
  const auto count = static_cast<double>(indices.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int i : indices) mean += pairs[i].surveyed / count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const int i : indices) {
    const Eigen::Vector3d d = pairs[i].surveyed - mean;
    covariance += d * d.transpose() / count;
  }
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues();
  return {std::sqrt(std::max(0.0, values[2])), std::sqrt(std::max(0.0, values[1]))};
}

template <typename Indices>
bool AreOnALine(std::span<const PointPair> pairs, const Indices& indices) {
  const Eigen::Vector2d extents = Extents(pairs, indices);
  return !(extents[1] > std::max(kLeastAcross_m, kLeastAcross * extents[0]));
}

double Residual(const PointPair& pair, const Similarity& fit) {
  return (fit * pair.in_scene - pair.surveyed).norm();
}

// How unlikely the motion is for a frame that sensors hold, in squared standard deviations.
double CostOfMotion(const Similarity& fit) {
  const Eigen::AngleAxisd turn(fit.rotation);
  const Eigen::Vector3d vector = turn.angle() * turn.axis();
  const double scale = std::log(fit.scale) / kScale;
  return vector.head<2>().squaredNorm() / (kTilt_rad * kTilt_rad) +
         vector.z() * vector.z() / (kHeading_rad * kHeading_rad) + scale * scale;
}

class ControlConsensus {
 public:
  ControlConsensus(std::span<const PointPair> pairs, bool is_upright)
      : pairs_(pairs), is_upright_(is_upright) {
    for (size_t i = 0; i < pairs.size(); ++i) all_.push_back(static_cast<int>(i));
    tolerance_m_ = kLeastTolerance_m;
  }

  ControlFit Fit() {
    ControlFit result;
    if (pairs_.size() < 3) {
      result.why_not = fmt::format(
          "{} control point{} of two photos or more: three are needed to hold the model",
          pairs_.size(), pairs_.size() == 1 ? "" : "s");
      return result;
    }
    std::vector<int> agreeing = BestConsensus();
    if (agreeing.size() < 3) {
      result.why_not = AreOnALine(pairs_, all_)
                           ? "the control points lie on one line, about which the model could "
                             "turn; survey one beside it"
                           : Contradiction();
      return result;
    }
    Similarity fit = AlignPairs(pairs_, agreeing);
    for (int round = 0; round < 5; ++round) {
      std::vector<int> again = Agreeing(fit);
      if (again == agreeing || again.size() < agreeing.size() || AreOnALine(pairs_, again)) break;
      agreeing = std::move(again);
      fit = AlignPairs(pairs_, agreeing);
    }
    if (!IsCertain(agreeing)) {
      result.why_not = Contradiction();
      return result;
    }
    result.surveyed_from_scene = fit;
    for (const int i : all_) {
      result.residual_m.push_back(Residual(pairs_[i], fit));
      if (!std::ranges::binary_search(agreeing, i)) result.blunders.push_back(i);
    }
    return result;
  }

 private:
  // Three points always fit a fourth place for themselves; a frame of sensors is a witness.
  bool IsCertain(const std::vector<int>& agreeing) const {
    const size_t num_blunders = pairs_.size() - agreeing.size();
    if (num_blunders == 0) return true;
    return (agreeing.size() > 3 || is_upright_) && agreeing.size() > num_blunders;
  }

  std::string Contradiction() const {
    return fmt::format(
        "the {} control points contradict each other by more than {:.2f} m, and which of them is "
        "wrong cannot be told; check coordinates and marks, or give more points",
        pairs_.size(), tolerance_m_);
  }

  std::vector<int> Agreeing(const Similarity& fit) const {
    std::vector<int> agreeing;
    for (const int i : all_) {
      if (Residual(pairs_[i], fit) < tolerance_m_) agreeing.push_back(i);
    }
    return agreeing;
  }

  std::vector<int> BestConsensus() {
    // By the middle of all, so that one far off does not widen it.
    tolerance_m_ = std::max(kLeastTolerance_m, kToleranceOfExtent * MiddleDistance());
    std::vector<int> best;
    double best_cost = std::numeric_limits<double>::infinity();
    for (const Triple& triple : TriplesOf(pairs_.size())) {
      if (AreOnALine(pairs_, triple)) continue;
      const Similarity fit = AlignPairs(pairs_, triple);
      if (!std::isfinite(fit.scale) || !(fit.scale > 0)) continue;
      double cost = is_upright_ ? CostOfMotion(fit) : 0;
      for (const int i : all_) {
        const double r = Residual(pairs_[i], fit) / tolerance_m_;
        cost += std::min(r * r, 1.0) * kWeightOfPoint;
      }
      if (!(cost < best_cost)) continue;
      best_cost = cost;
      best = Agreeing(fit);
    }
    return best;
  }

  // Median distance between two points.
  double MiddleDistance() const {
    std::vector<double> distances;
    for (size_t a = 0; a < pairs_.size(); ++a) {
      for (size_t b = a + 1; b < pairs_.size(); ++b) {
        distances.push_back((pairs_[a].surveyed - pairs_[b].surveyed).norm());
      }
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::ranges::nth_element(distances, middle);
    return *middle;
  }

  // A point that does not fit weighs as much as a turn by three standard deviations.
  static constexpr double kWeightOfPoint = 9;

  std::span<const PointPair> pairs_;
  bool is_upright_;
  std::vector<int> all_;
  double tolerance_m_;
};

}  // namespace

ControlFit FitControl(std::span<const PointPair> pairs, bool is_upright) {
  return ControlConsensus(pairs, is_upright).Fit();
}

}  // namespace stucco
