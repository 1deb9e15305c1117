// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/photo_light.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace stucco::evaluate {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr int kRounds = 40;
constexpr double kExact = 1e-4;  // of the light: below, a deviation weighs no more
constexpr double kLeast = 1e-9;  // of the weight: photos of one radius have no falloff

// Each photo and channel is a group with a gain of its own.
using Group = std::vector<std::pair<Vector2d, double>>;  // (r^2, r^4), logarithm of the ratio

std::vector<Group> GroupsOf(const std::vector<std::vector<LightSample>>& photos) {
  std::vector<Group> groups;
  for (const std::vector<LightSample>& photo : photos) {
    for (size_t c = 0; c < 3; ++c) {
      Group& group = groups.emplace_back();
      for (const LightSample& sample : photo) {
        const double r2 = sample.radius_squared;
        group.emplace_back(Vector2d(r2, r2 * r2), sample.log_ratios[c]);
      }
    }
  }
  return groups;
}

struct Fit {
  Vector2d falloff = Vector2d::Zero();
  std::vector<double> gains;  // logarithms, by group
};

// Weighted means over a group, and moments about them.
struct Moments {
  double weight = 0;
  Vector2d mean = Vector2d::Zero();
  double mean_ratio = 0;
  Matrix2d square = Matrix2d::Zero();
  Vector2d product = Vector2d::Zero();
};

double Weight(const Fit& fit, size_t group, const std::pair<Vector2d, double>& sample) {
  const double off = sample.second - fit.gains[group] - fit.falloff.dot(sample.first);
  return 1 / std::max(std::abs(off), kExact);
}

template <typename WeightOf>
Moments MomentsOf(const Group& group, const WeightOf& weight_of) {
  Moments moments;
  for (const auto& sample : group) {
    const double weight = weight_of(sample);
    moments.weight += weight;
    moments.mean += weight * sample.first;
    moments.mean_ratio += weight * sample.second;
  }
  if (moments.weight == 0) return moments;
  moments.mean /= moments.weight;
  moments.mean_ratio /= moments.weight;
  for (const auto& sample : group) {
    const double weight = weight_of(sample);
    const Vector2d away = sample.first - moments.mean;
    moments.square += weight * away * away.transpose();
    moments.product += weight * (sample.second - moments.mean_ratio) * away;
  }
  return moments;
}

// Weighted least squares: about their means the groups have nothing left but the falloff.
Fit Solved(const std::vector<Moments>& groups) {
  Matrix2d square = Matrix2d::Zero();
  Vector2d product = Vector2d::Zero();
  for (const Moments& group : groups) {
    square += group.square + kLeast * group.weight * Matrix2d::Identity();
    product += group.product;
  }
  Fit fit;
  if (square.trace() > 0) fit.falloff = square.ldlt().solve(product);
  for (const Moments& group : groups) {
    fit.gains.push_back(group.mean_ratio - fit.falloff.dot(group.mean));
  }
  return fit;
}

}  // namespace

double RadiusSquared(const Camera& camera, double x_px, double y_px) {
  const Vector2d centre = camera.PrincipalPoint();
  const Vector2d corner(std::max(centre.x(), camera.width_px - centre.x()),
                        std::max(centre.y(), camera.height_px - centre.y()));
  return (Vector2d(x_px, y_px) - centre).squaredNorm() / corner.squaredNorm();
}

double Falloff::At(double radius_squared) const {
  return std::exp(radius_squared * (square + radius_squared * fourth));
}

PhotoLight FitPhotoLight(const std::vector<std::vector<LightSample>>& photos) {
  const std::vector<Group> groups = GroupsOf(photos);
  Fit fit;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Moments> moments;
    for (size_t i = 0; i < groups.size(); ++i) {
      moments.push_back(MomentsOf(groups[i], [&](const auto& sample) {
        return round == 0 ? 1.0 : Weight(fit, i, sample);
      }));
    }
    fit = Solved(moments);
  }
  PhotoLight light;
  light.falloff = {fit.falloff[0], fit.falloff[1]};
  for (size_t i = 0; i < photos.size(); ++i) {
    std::array<double, 3>& gains = light.gains.emplace_back();
    for (size_t c = 0; c < 3; ++c) gains[c] = std::exp(fit.gains[3 * i + c]);
  }
  return light;
}

}  // namespace stucco::evaluate
