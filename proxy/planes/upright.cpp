// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/upright.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "survey/degree.h"

namespace stucco {
namespace {

// How a camera is held: unit vectors in the world.
struct Attitude {
  Eigen::Vector3d right;      // x of the camera
  Eigen::Vector3d upwards;    // -y of the camera
  Eigen::Vector3d backwards;  // -z of the camera
};

Attitude AttitudeOf(const SurveyPhoto& photo) {
  const Eigen::Matrix3d world_from_cam =
      photo.cam_from_world.rotation.conjugate().toRotationMatrix();
  return {world_from_cam.col(0), -world_from_cam.col(1), -world_from_cam.col(2)};
}

// Plausible pitches: the picture's top points up, and on the whole nobody photographs the sky.
bool IsPlausible(std::span<const SurveyPhoto> photos, const Eigen::Vector3d& up) {
  double top = 0, back = 0;
  for (const SurveyPhoto& photo : photos) {
    const Attitude attitude = AttitudeOf(photo);
    top += attitude.upwards.dot(up);
    back += attitude.backwards.dot(up);
  }
  const auto count = static_cast<double>(photos.size());
  return photos.empty() ||
         (top > -0.15 * count && top + back > 0.2 * count && back > -0.75 * count);
}

// Share of the area whose planes are walls or flat under this up.
double Explained(const std::vector<Plane>& planes, const Eigen::Vector3d& up) {
  constexpr double kSinOfWall = 0.09;   // 5 degrees
  constexpr double kCosOfFlat = 0.996;  // 5 degrees
  double explained = 0, total = 0;
  for (const Plane& plane : planes) {
    const double along = plane.normal.dot(up);
    total += plane.area;
    if (std::abs(along) < kSinOfWall) explained += plane.area;
    if (along > kCosOfFlat) explained += plane.area;
  }
  return total > 0 ? explained / total : 0;
}

}  // namespace

std::vector<Eigen::Vector3d> UpFromPhotos(std::span<const SurveyPhoto> photos) {
  std::vector<Eigen::Vector3d> guesses;
  if (photos.empty()) return guesses;
  Eigen::Matrix3d level = Eigen::Matrix3d::Zero();
  Eigen::Vector3d top = Eigen::Vector3d::Zero();
  Eigen::Vector3d back = Eigen::Vector3d::Zero();
  for (const SurveyPhoto& photo : photos) {
    const Attitude attitude = AttitudeOf(photo);
    level += attitude.right * attitude.right.transpose();
    top += attitude.upwards;
    back += attitude.backwards;
  }
  const auto count = static_cast<double>(photos.size());
  // Photos all taken towards one side leave the pitch open: the picture's top decides then.
  constexpr double kPull = 0.02;
  const Eigen::Matrix3d system = level / count + kPull * (Eigen::Matrix3d::Identity() -
                                                          top * top.transpose() / (count * count));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(system);
  Eigen::Vector3d up = solver.eigenvectors().col(0);
  if (up.dot(top + back) < 0) up = -up;
  guesses.push_back(up);
  if (top.norm() > 1e-6) guesses.push_back(top.normalized());
  if (back.norm() > 1e-6) guesses.push_back(back.normalized());  // photos straight down
  return guesses;
}

Eigen::Vector3d RefineUp(const std::vector<Plane>& planes, const UpGuess& guess) {
  constexpr int kRounds = 12;
  constexpr double kHold = 0.01;  // keeps up where walls of one direction leave it free
  constexpr double kWallLean_deg = 0.5;
  constexpr double kLeastSigma_deg = 0.01;
  // Grounds and terraces slope more often than walls lean: they decide only what walls leave open.
  constexpr double kFlatWeight = 0.2;
  constexpr double kFlatShare = 0.1;  // at most, of the walls' weight
  Eigen::Vector3d up = guess.up;
  double gate = std::sin(guess.tolerance_deg * kDegree);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d system = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d flats = Eigen::Matrix3d::Zero();
    double walls_total = 0, walls_squares = 0, flats_total = 0;
    for (const Plane& plane : planes) {
      const double along = plane.normal.dot(up);
      // Tukey's weights, the gate narrowing to 3 degrees: leaning planes lose their say.
      const double lean = std::abs(along) / gate;
      if (lean < 1) {
        const double weight = plane.area * std::pow(1 - lean * lean, 2);
        system += weight * plane.normal * plane.normal.transpose();
        walls_total += weight;
        walls_squares += weight * weight;
      }
      const double tilt = std::sqrt(std::max(0.0, 1 - along * along)) / gate;
      if (along > 0 && tilt < 1) {
        const double weight = kFlatWeight * plane.area * std::pow(1 - tilt * tilt, 2);
        flats += weight * (Eigen::Matrix3d::Identity() - plane.normal * plane.normal.transpose());
        flats_total += weight;
      }
    }
    const double share = walls_total > 0 && flats_total > kFlatShare * walls_total
                             ? kFlatShare * walls_total / flats_total
                             : 1;
    system += share * flats;
    const double total = walls_total + share * flats_total;
    if (!(total > 0)) break;
    double hold = kHold * total;
    if (guess.sigma_deg && walls_total > 0) {
      const double of_one_wall = walls_squares / walls_total;
      hold +=
          of_one_wall * std::pow(kWallLean_deg / std::max(*guess.sigma_deg, kLeastSigma_deg), 2);
    }
    system += hold * (Eigen::Matrix3d::Identity() - guess.up * guess.up.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(system);
    Eigen::Vector3d next = solver.eigenvectors().col(0);
    if (next.dot(up) < 0) next = -next;
    up = next;
    gate = std::max(std::sin(3 * kDegree), 0.75 * gate);
  }
  return up;
}

UpEstimate EstimateUp(const std::vector<Plane>& planes, std::span<const SurveyPhoto> photos) {
  assert(std::ranges::none_of(planes, [](const Plane& plane) { return !(plane.area > 0); }));
  constexpr size_t kLargePlanes = 6;
  constexpr double kTolerance_deg = 20;
  constexpr double kPreferPhotos = 0.05;  // planes must explain this much more than the photos' up
  struct Candidate {
    Eigen::Vector3d up;
    bool from_photos;
  };
  std::vector<Candidate> candidates;
  for (const auto& up : UpFromPhotos(photos)) candidates.push_back({up, true});
  std::vector<const Plane*> largest;
  largest.reserve(planes.size());
  for (const Plane& plane : planes) largest.push_back(&plane);
  std::stable_sort(largest.begin(), largest.end(),
                   [](const Plane* a, const Plane* b) { return a->area > b->area; });
  largest.resize(std::min(largest.size(), kLargePlanes));
  for (const Plane* plane : largest) candidates.push_back({plane->normal, false});
  UpEstimate best;
  best.source = "nothing: z is taken for up";
  double best_score = -1;
  for (size_t c = 0; c < candidates.size(); ++c) {
    const auto& [guess, from_photos] = candidates[c];
    const Eigen::Vector3d up = RefineUp(planes, {guess, kTolerance_deg});
    if (!IsPlausible(photos, up)) continue;
    const double explained = Explained(planes, up);
    // Walls can be taken for floors: the first guess, from level cameras, breaks such ties.
    const double score = explained + (from_photos ? kPreferPhotos : 0) + (c == 0 ? 0.1 : 0);
    if (score <= best_score) continue;
    best_score = score;
    best.up = up;
    best.explained = explained;
    best.source = from_photos ? (planes.empty() ? "photos" : "photos and walls") : "planes";
    best.from_first_guess_deg = std::acos(std::clamp(up.dot(guess), -1.0, 1.0)) / kDegree;
  }
  return best;
}

}  // namespace stucco
