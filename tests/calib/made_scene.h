// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "calib/scene/scene.h"
#include "calib/scene/tracks.h"
#include "calib/two_view/initial_pair.h"
#include "survey/camera.h"
#include "survey/pose.h"

namespace stucco::test {

// Seeded numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(uint32_t seed) : generator_(seed) {}
  double Uniform(double low, double high) { return low + (high - low) * generator_() * 0x1p-32; }
  double Gauss(double sigma);
  int Index(size_t count) { return static_cast<int>(generator_() % count); }
  Eigen::Vector3d Vector(double size) {
    const double x = Uniform(-size, size);
    const double y = Uniform(-size, size);
    return {x, y, Uniform(-size, size)};
  }

 private:
  std::mt19937 generator_;
};

// 1200 x 900 pixels, focal length about 1000, some distortion where the model has it.
Camera MadeCamera(CameraModel model = CameraModel::kOpenCv);

// cam_from_world of a level camera at `position` that has `target` in the middle of its picture.
// Up is +z.
Pose LookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target);

struct MadeOptions {
  int num_photos = 8;
  int num_points = 300;
  int num_planes = 2;          // walls of a corner; the third plane is the ground before it
  double clutter_share = 0.2;  // of the points, off the planes
  double arc_rad = 1.2;      // the cameras stand on an arc of 20 m around the corner; 0: one place
  double seen_share = 0.85;  // of the points in a picture that are detected
  double noise_px = 0;       // standard deviation per axis
  CameraModel model = CameraModel::kOpenCv;
  uint32_t seed = 1;
};

// A calibrated scene: true intrinsics, poses and points; keypoints are projections with noise, and
// every keypoint belongs to a track of at least two photos.
Scene MakeScene(const MadeOptions& options);

// The same without poses and points: what calibration starts from.
Scene Blank(const Scene& truth);

// Matches between all pairs of photos with common points. The share `wrong` of each pair's matches
// joins keypoints of different points.
std::vector<PhotoPair> MatchesOf(const Scene& truth, double wrong, uint32_t seed);

// Verified and classified with the cameras of `scene`; refused pairs left out.
std::vector<VerifiedPair> Verified(const Scene& scene, const std::vector<PhotoPair>& pairs);

// BuildTracks of pairs that are at hand by themselves.
std::vector<SceneTrack> TracksFrom(const std::vector<size_t>& num_keypoints,
                                   const std::vector<PhotoPair>& pairs);

// Replaces the tracks by those that the pairs give.
void SetTracks(const std::vector<VerifiedPair>& pairs, Scene& scene);

struct PoseErrors {
  int num_registered = 0;
  double position_m = 0;    // largest, after the best similarity
  double rotation_rad = 0;  // largest
};

// Compares poses that both scenes have; needs three of them.
PoseErrors ComparePoses(const Scene& actual, const Scene& truth);

// A small random motion of a pose.
Pose Disturbed(const Pose& pose, double angle_rad, double offset, Random& random);

}  // namespace stucco::test
