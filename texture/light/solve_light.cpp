// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/solve_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "survey/median.h"
#include "texture/light/robust_sums.h"

namespace stucco {
namespace {

// Deviations, of logarithms of colours: of a photo's gain and of a falloff's terms from nothing.
constexpr double kGainSigma = 0.5;
constexpr double kFalloffSigma = 0.25;
// Of a photo's light from what its exposure makes it: what a camera's curve departs from a power,
// what its metadata are rounded to, and clouds.
constexpr double kExposureSigma = 0.1;
// Of a wall's light an hour apart, and at most.
constexpr double kSunSigmaPerHour = 0.15;
constexpr double kLargestSunSigma = 0.5;
constexpr double kSignificant = 3;  // of its own standard deviation

// Hues of gains farther from the middle of all than both: logarithms, and times the median
// distance.
constexpr double kAlwaysLikely = 0.05;
constexpr double kFarFromUsual = 4;

// A tree or a car before most of what a photo shows makes its ratios those of leaves to plaster; a
// camera's white balance does no such thing to one photo. Hues that are far from those of the other
// photos in `logs` come back to where they are still likely.
void LimitHues(const std::vector<size_t>& compared, std::vector<Eigen::Vector3d>& logs) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    values.reserve(compared.size());
    for (const size_t i : compared) values.push_back(HueOf(logs[i])[k]);
    middle[k] = Median(std::move(values)).value_or(0);
  }
  std::vector<double> apart;
  apart.reserve(compared.size());
  for (const size_t i : compared) apart.push_back((HueOf(logs[i]) - middle).norm());
  const double most = std::max(kAlwaysLikely, kFarFromUsual * Median(apart).value_or(0));
  for (size_t n = 0; n < compared.size(); ++n) {
    if (!(apart[n] > most)) continue;
    Eigen::Vector3d& log = logs[compared[n]];
    const Eigen::Vector3d hue = middle + (HueOf(log) - middle) * (most / apart[n]);
    log = hue.array() + (log.mean() - hue.mean());
  }
}

// Unknowns are the logarithms of the photos' light, of what each lens makes of an exposure, and two
// terms of each lens's falloff.
struct Unknowns {
  explicit Unknowns(std::span<const TakenPhoto> taken)
      : photos(static_cast<int>(taken.size())), lenses(0) {
    for (const TakenPhoto& photo : taken) lenses = std::max(lenses, photo.lens + 1);
  }

  int Lens(int lens) const { return photos + lens; }
  int Falloff(int lens) const { return photos + lenses + 2 * lens; }
  int size() const { return photos + 3 * lenses; }
  Eigen::VectorXd PriorSigmas() const {
    Eigen::VectorXd sigmas = Eigen::VectorXd::Constant(size(), kGainSigma);
    sigmas.tail(2 * lenses).setConstant(kFalloffSigma);
    return sigmas;
  }

  int photos;
  int lenses;
};

// Of a ratio with many texels between two photos.
double RatioSigma(const TakenPhoto& a, const TakenPhoto& b) {
  return std::hypot(kRatioSigma, SunSigma(a.time_h, b.time_h));
}

// What metadata say of the photos' light, up to a factor for each lens.
std::vector<SumEquation> OfExposures(std::span<const TakenPhoto> photos, const Unknowns& unknowns) {
  std::vector<double> sums(unknowns.lenses, 0);
  std::vector<int> counts(unknowns.lenses, 0);
  for (const TakenPhoto& photo : photos) {
    sums[photo.lens] += photo.log_exposure.value_or(0);
    counts[photo.lens] += photo.log_exposure.has_value();
  }
  std::vector<SumEquation> equations;
  equations.reserve(photos.size());
  for (int i = 0; i < unknowns.photos; ++i) {
    const auto& [lens, log_exposure, time_h] = photos[i];
    if (!log_exposure) continue;
    equations.push_back({{{{i, 1.0}, {unknowns.Lens(lens), -1.0}}},
                         *log_exposure - sums[lens] / counts[lens],
                         kExposureSigma});
  }
  return equations;
}

std::vector<Falloff> FalloffsOfLenses(std::span<const ColourRatio> ratios,
                                      std::span<const TakenPhoto> photos) {
  const Unknowns unknowns(photos);
  std::vector<SumEquation> equations = OfExposures(photos, unknowns);
  equations.reserve(equations.size() + ratios.size());
  for (const ColourRatio& ratio : ratios) {
    SumEquation equation = OfRatio(ratio, ratio.a, ratio.b, ratio.log_ratio.mean(),
                                   RatioSigma(photos[ratio.a], photos[ratio.b]));
    const int of_a = unknowns.Falloff(photos[ratio.a].lens);
    const int of_b = unknowns.Falloff(photos[ratio.b].lens);
    equation.terms[2] = {of_a, ratio.corner_a[0]};
    equation.terms[3] = {of_a + 1, ratio.corner_a[1]};
    equation.terms[4] = {of_b, -ratio.corner_b[0]};
    equation.terms[5] = {of_b + 1, -ratio.corner_b[1]};
    equations.push_back(equation);
  }
  NormalFactors factors;
  const Eigen::VectorXd values = SolveSums(equations, unknowns.PriorSigmas(), factors);
  std::vector<Falloff> falloffs(unknowns.lenses);
  for (int lens = 0; lens < unknowns.lenses; ++lens) {
    const Falloff found{values.segment<2>(unknowns.Falloff(lens))};
    Eigen::VectorXd corner = Eigen::VectorXd::Zero(unknowns.size());
    corner.segment<2>(unknowns.Falloff(lens)).setOnes();
    const double sigma = std::sqrt(corner.dot(factors.solve(corner)));
    if (std::abs(found.LogAt(1)) > kSignificant * sigma) falloffs[lens] = found;
  }
  return falloffs;
}

// Logarithms of the photos' gains, with their lenses' falloffs taken off.
std::vector<Eigen::Vector3d> LogGains(std::span<const ColourRatio> ratios,
                                      std::span<const TakenPhoto> photos,
                                      std::span<const Falloff> falloffs) {
  const Unknowns unknowns(photos);
  std::vector<Eigen::Vector3d> logs(falloffs.size(), Eigen::Vector3d::Zero());
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<SumEquation> equations = OfExposures(photos, unknowns);
    equations.reserve(equations.size() + ratios.size());
    for (const ColourRatio& ratio : ratios) {
      const double lost = LostToCorners(ratio, falloffs);
      equations.push_back(OfRatio(ratio, ratio.a, ratio.b, ratio.log_ratio[channel] - lost,
                                  RatioSigma(photos[ratio.a], photos[ratio.b])));
    }
    NormalFactors factors;
    const Eigen::VectorXd values = SolveSums(equations, unknowns.PriorSigmas(), factors);
    for (size_t i = 0; i < logs.size(); ++i) {
      logs[i][channel] = -values[static_cast<Eigen::Index>(i)];
    }
  }
  return logs;
}

}  // namespace

double SunSigma(const std::optional<double>& a_h, const std::optional<double>& b_h) {
  const double apart_h = a_h && b_h ? std::abs(*a_h - *b_h) : 0;
  return std::min(kLargestSunSigma, kSunSigmaPerHour * apart_h);
}

PhotosLight SolveLight(std::span<const ColourRatio> ratios, std::span<const TakenPhoto> photos) {
  assert(std::ranges::all_of(ratios, [&](const ColourRatio& ratio) {
    return static_cast<size_t>(std::max(ratio.a, ratio.b)) < photos.size();
  }));
  PhotosLight light{std::vector<Eigen::Vector3d>(photos.size(), Eigen::Vector3d::Ones()),
                    std::vector<Falloff>(photos.size()),
                    {photos.begin(), photos.end()}};
  if (ratios.empty()) return light;
  const std::vector<Falloff> lenses = FalloffsOfLenses(ratios, photos);
  for (size_t i = 0; i < photos.size(); ++i) light.falloffs[i] = lenses[photos[i].lens];
  std::vector<Eigen::Vector3d> logs = LogGains(ratios, photos, light.falloffs);
  std::vector<uint8_t> is_compared(photos.size(), 0);
  for (const ColourRatio& ratio : ratios) is_compared[ratio.a] = is_compared[ratio.b] = 1;
  std::vector<size_t> compared;
  for (size_t i = 0; i < photos.size(); ++i) {
    if (is_compared[i]) compared.push_back(i);
  }
  LimitHues(compared, logs);
  for (const size_t i : compared) light.gains[i] = GainOf(logs[i]);
  return light;
}

}  // namespace stucco
