// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/flight_ties.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace stucco {
namespace {

using Motion = Eigen::Matrix<double, 6, 1>;  // shift, then rotation vector about the middle
using Information = Eigen::Matrix<double, 6, 6>;

// What all matches of a photo may be off by together, in standard deviations of its keypoints, and
// how many of them count as independent.
constexpr double kCommonError_sigmas = 0.5;
constexpr double kIndependent = 4;
// Fewer matches of a photo are as likely wrong ones.
constexpr double kLeastMatches = 15;

struct Flight {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  int num_photos = 0;
};

std::vector<Flight> FlightsIn(const std::vector<int>& flight_of_photo, const Scene& scene) {
  int count = 1;
  for (const int flight : flight_of_photo) count = std::max(count, flight + 1);
  std::vector<Flight> flights(count);
  for (size_t i = 0; i < flight_of_photo.size(); ++i) {
    if (!scene.photos[i].pose) continue;
    Flight& flight = flights[flight_of_photo[i]];
    flight.middle += scene.photos[i].pose->Center();
    ++flight.num_photos;
  }
  for (Flight& flight : flights) {
    if (flight.num_photos > 0) flight.middle /= flight.num_photos;
  }
  return flights;
}

// What a photo's view of a point says of a motion of either about `middle`.
Information SeenOf(const Scene& scene, int photo, const Eigen::Vector3d& point,
                   const Eigen::Vector3d& middle) {
  const Pose& pose = *scene.photos[photo].pose;
  const Eigen::Vector3d local = pose * point;
  if (local.z() <= 0) return Information::Zero();
  Eigen::Matrix<double, 2, 3> bearing;
  bearing << 1, 0, -local.x() / local.z(), 0, 1, -local.y() / local.z();
  const Eigen::Vector3d arm = point - middle;
  Eigen::Matrix<double, 3, 6> moved;
  moved.leftCols<3>().setIdentity();
  moved.rightCols<3>() << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  const double scale = scene.CameraOf(photo).FocalX() / local.z() /
                       (kCommonError_sigmas * scene.photos[photo].keypoint_sigma_px);
  const Eigen::Matrix<double, 2, 6> row =
      scale * bearing * pose.rotation.toRotationMatrix() * moved;
  return row.transpose() * row;
}

// Of one photo, what it says of one flight.
struct Share {
  Information sum = Information::Zero();
  double count = 0;

  Information Limited() const {
    return count < kLeastMatches ? Information::Zero() : Information(sum * (kIndependent / count));
  }
};

class Ties {
 public:
  Ties(const std::vector<int>& flight_of_photo, const Scene& scene)
      : flight_of_photo_(flight_of_photo),
        scene_(scene),
        flights_(FlightsIn(flight_of_photo, scene)) {}

  std::vector<FlightTie> Run() const {
    const auto flown =
        std::ranges::count_if(flights_, [](const Flight& f) { return f.num_photos; });
    const std::vector<const SceneTrack*> crossing = Crossing();
    std::vector<FlightTie> ties;
    for (int f = 0; f < static_cast<int>(flights_.size()); ++f) {
      if (flights_[f].num_photos == 0) {
        ties.emplace_back();
      } else if (flown == 1) {
        ties.push_back({0, 0});
      } else {
        ties.push_back(TieOf(f, crossing));
      }
    }
    return ties;
  }

 private:
  bool Counts(const SceneElement& e) const { return e.used && scene_.photos[e.photo].pose; }

  bool IsSeenBy(const SceneTrack& track, int flight) const {
    return std::ranges::any_of(track.elements, [&](const SceneElement& e) {
      return Counts(e) && flight_of_photo_[e.photo] == flight;
    });
  }

  // Those that photos of several flights see.
  std::vector<const SceneTrack*> Crossing() const {
    std::vector<const SceneTrack*> crossing;
    for (const SceneTrack& track : scene_.tracks) {
      if (!track.position) continue;
      const auto first =
          std::ranges::find_if(track.elements, [&](const SceneElement& e) { return Counts(e); });
      if (first == track.elements.end()) continue;
      const int flight = flight_of_photo_[first->photo];
      if (std::any_of(first, track.elements.end(), [&](const SceneElement& e) {
            return Counts(e) && flight_of_photo_[e.photo] != flight;
          })) {
        crossing.push_back(&track);
      }
    }
    return crossing;
  }

  FlightTie TieOf(int flight, const std::vector<const SceneTrack*>& crossing) const {
    std::vector<Share> shares(scene_.photos.size());
    const Eigen::Vector3d& middle = flights_[flight].middle;
    for (const SceneTrack* track : crossing) {
      if (!IsSeenBy(*track, flight)) continue;
      for (const SceneElement& e : track->elements) {
        if (!Counts(e)) continue;
        shares[e.photo].sum += SeenOf(scene_, e.photo, *track->position, middle);
        ++shares[e.photo].count;
      }
    }
    Information own = AlwaysKnown();
    Information other = own;
    for (size_t i = 0; i < shares.size(); ++i) {
      (flight_of_photo_[i] == flight ? own : other) += shares[i].Limited();
    }
    const Information control = ByControl(flight);
    const FlightTie one = SigmasOf(own + control);
    const FlightTie two = SigmasOf(other + control);
    return {std::max(one.position_m, two.position_m), std::max(one.yaw_rad, two.yaw_rad)};
  }

  Information ByControl(int flight) const {
    Information sum = Information::Zero();
    for (const ControlPoint& point : scene_.control.points) {
      for (const PhotoMark& mark : point.marks) {
        if (flight_of_photo_[mark.photo] != flight || !scene_.photos[mark.photo].pose) continue;
        sum += SeenOf(scene_, mark.photo, point.position, flights_[flight].middle);
      }
    }
    return sum;
  }

  static Information AlwaysKnown() {
    const FlightTie untied;
    Motion variances;
    variances.head<3>().setConstant(untied.position_m * untied.position_m);
    variances.tail<3>().setConstant(untied.yaw_rad * untied.yaw_rad);
    return variances.cwiseInverse().asDiagonal();
  }

  static FlightTie SigmasOf(const Information& information) {
    const Motion variances =
        information.ldlt().solve(Information::Identity()).diagonal().cwiseMax(0);
    return {std::sqrt(variances.head<3>().sum()), std::sqrt(variances[5])};
  }

  const std::vector<int>& flight_of_photo_;
  const Scene& scene_;
  std::vector<Flight> flights_;
};

}  // namespace

std::vector<FlightTie> TiesOfFlights(const std::vector<int>& flight_of_photo, const Scene& scene) {
  assert(flight_of_photo.size() == scene.photos.size());
  return Ties(flight_of_photo, scene).Run();
}

}  // namespace stucco
