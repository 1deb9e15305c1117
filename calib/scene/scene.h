// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "survey/camera.h"
#include "survey/pose.h"

namespace stucco {

// The working state of structure from motion. Photos, cameras and tracks are addressed by index. A
// photo with a pose is called registered, as in COLMAP.

struct SceneCamera {
  Camera intrinsics;  // model OPENCV or FULL_OPENCV or PINHOLE; changes while calibrating
  Camera prior;       // what the metadata said
  // One standard deviation of the prior focal length relative to it; 0 keeps all intrinsics fixed.
  double focal_sigma_ratio = 0.1;
};

struct PositionPrior {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // ENU, metres
  double sigma_horizontal_m = 5;
  double sigma_vertical_m = 10;
};

// Where the camera looks by its gimbal, in the frame of the positions.
struct AttitudePrior {
  Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity();
  double sigma_rad = 0.02;  // about each axis
};

struct ScenePhoto {
  std::string name;
  int camera = 0;
  std::vector<Eigen::Vector2d> keypoints;  // full-resolution pixels
  // Standard deviation of the sharpest keypoints, full-resolution pixels.
  double keypoint_sigma_px = 1;
  std::vector<float> blobs_px;  // by keypoint, standard deviation of its blob; empty: all sharp
  std::vector<std::array<uint8_t, 3>> colors;
  std::optional<Pose> pose;  // cam_from_world once it is known
  std::optional<PositionPrior> prior;
  std::optional<AttitudePrior> attitude;
  int hover = -1;  // photos with the same number were taken from one place; -1: by itself
  // What it shows repeats itself, so that matches may put it whole bays beside where it was taken.
  bool may_be_bays_off = false;

  // Standard deviation of a keypoint. A blob's place is known to a part of its size (Zeisl et al.,
  // "Estimation of location uncertainty for scale invariant feature points", 2009), and no better
  // than the pixels allow.
  double KeypointSigma(int keypoint) const;
};

// Where its priors put the photo: nothing unless it has both.
std::optional<Pose> RecordedPose(const ScenePhoto& photo);

struct SceneElement {
  int photo = 0;
  int keypoint = 0;
  bool used = false;  // agrees with the point's position
};

// Keypoints of different photos that show the same point.
struct SceneTrack {
  std::vector<SceneElement> elements;  // at most one per photo
  std::optional<Eigen::Vector3d> position;
};

// Where somebody marked a point in a photo, full-resolution pixels.
struct PhotoMark {
  int photo = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// A surveyed point that holds the scene.
struct ControlPoint {
  Eigen::Vector3d surveyed = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Ones();
  std::vector<PhotoMark> marks;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // where adjustment puts it
};

// Takes part in adjustments with priors; the scene is in the points' frame then.
struct SceneControl {
  std::vector<ControlPoint> points;  // none, or enough to hold the frame
  double mark_sigma_px = 1;
  // Points farther than this from what was surveyed, in standard deviations, lose weight.
  double loss_scale = 3;
  // By how much all recorded positions are off together, which only control points can tell.
  Eigen::Vector3d positions_shift_m = Eigen::Vector3d::Zero();
};

struct Scene {
  std::vector<SceneCamera> cameras;
  std::vector<ScenePhoto> photos;
  std::vector<SceneTrack> tracks;
  std::vector<std::vector<int>> tracks_of_photo;  // per photo: track of each keypoint, -1 for none
  SceneControl control;
  // Standard deviation of where photos were taken about the place of their hover, per axis; 0: not
  // known, and hovers hold nothing.
  double hover_sigma_m = 0;

  const Camera& CameraOf(int photo) const { return cameras[photos[photo].camera].intrinsics; }
};

// Distance in pixels between an element's keypoint and the projection of a point; infinite where
// the photo has no pose or the point is not in front of it.
double ReprojectionError(const Scene& scene, const SceneElement& element,
                         const Eigen::Vector3d& point);

// The same over the standard deviation of the photo's sharpest keypoints, which is what limits are
// stated in: photos of different sizes are detected at different scales.
double ReprojectionErrorInSigmas(const Scene& scene, const SceneElement& element,
                                 const Eigen::Vector3d& point);

// Whether every index of the scene leads somewhere: cameras of photos, keypoints of tracks, at most
// one per photo, and the tracks of keypoints where Scene::tracks_of_photo is filled (IndexTracks).
// What works on a scene requires it; O(n log n), for assertions where a stage's steps meet.
bool IsConsistent(const Scene& scene);

int NumRegistered(const Scene& scene);

// Tracks that keypoints of these photos belong to, ascending.
std::vector<int> TracksOf(const Scene& scene, const std::vector<int>& photos);

// Tracks whose points agree with the photo's keypoints, once each; in the keypoints' order.
std::vector<int> TracksSeenBy(const Scene& scene, int photo);

// By photo: in how many of the points that this one sees it has a part that agrees; 0 for itself.
std::vector<int> PointsShared(const Scene& scene, int photo);

// Elements in registered photos that agree with their track's point.
int NumUsedObservations(const Scene& scene, int photo);

// Largest angle between the rays of the used elements, in radians.
double LargestRayAngle(const Scene& scene, const SceneTrack& track);

}  // namespace stucco
