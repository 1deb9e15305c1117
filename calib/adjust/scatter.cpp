// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/internal/scatter.h"

#include <algorithm>
#include <cmath>

#include "calib/adjust/adjust.h"
#include "calib/adjust/internal/linearise.h"

namespace stucco {
namespace {

// Robust residuals lose weight beyond this many deviations of their noise (AdjustOptions).
constexpr double kLossScale = 2;

}  // namespace

RobustVariance::RobustVariance(const Scene& scene, double scale)
    : scene_(scene),
      scale_(scale),
      sums_(scene.photos.size() * kCells * kCells, Eigen::Vector2d::Zero()) {}

void RobustVariance::Add(const SceneElement& element, const Eigen::Vector2d& residual) {
  const double weight = Weight(residual);
  sums_[CellOf(element)] += weight * residual;
  slope_ += weight * weight;
  ++count_;
}

double RobustVariance::Get(double num_unknowns) const {
  const double n = count_;
  const double redundancy = std::max(1.0, 2 * n - num_unknowns) / (2 * n);
  return LargestInfluence() / n / std::pow(slope_ / n, 2) / redundancy;
}

double RobustVariance::Weight(const Eigen::Vector2d& residual) const {
  return 1 / (1 + residual.squaredNorm() / (scale_ * scale_));
}

double RobustVariance::OfNeighbouringCells() const {
  const double of_single = Influence(1);
  return of_single > 0 ? LargestInfluence() / of_single : 1;
}

double RobustVariance::LargestInfluence() const {
  return std::max({Influence(1), Influence(kCells / 2), Influence(kCells)});
}

double RobustVariance::Influence(int cells) const {
  double influence = 0;
  const int blocks = kCells / cells;
  for (size_t photo = 0; photo < scene_.photos.size(); ++photo) {
    for (int block = 0; block < blocks * blocks; ++block) {
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      for (int i = 0; i < cells * cells; ++i) {
        const int row = block / blocks * cells + i / cells;
        const int column = block % blocks * cells + i % cells;
        sum += sums_[(photo * kCells + row) * kCells + column];
      }
      influence += sum.squaredNorm() / 2;
    }
  }
  return influence;
}

size_t RobustVariance::CellOf(const SceneElement& element) const {
  const Camera& camera = scene_.CameraOf(element.photo);
  const Eigen::Vector2d& pixel = scene_.photos[element.photo].keypoints[element.keypoint];
  const auto cell = [](double place, int size) {
    return static_cast<size_t>(std::clamp(static_cast<int>(place / size * kCells), 0, kCells - 1));
  };
  return (element.photo * kCells + cell(pixel.y(), camera.height_px)) * kCells +
         cell(pixel.x(), camera.width_px);
}

RobustVariance ScatterOf(const Scene& scene, int& num_points) {
  RobustVariance scatter(scene, kLossScale * MeasureNoise(scene));
  num_points = 0;
  for (const SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    ++num_points;
    for (const SceneElement& element : track.elements) {
      Linearised l;
      if (element.used && Linearise(scene, element, *track.position, l)) {
        scatter.Add(element, l.residual);
      }
    }
  }
  return scatter;
}

}  // namespace stucco
