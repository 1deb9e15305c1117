// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calib/made_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "calib/two_view/verify.h"

namespace stucco::test {
namespace {

constexpr double kRadius = 20;

// Two walls meet in a convex corner that points at the cameras (towards -y); ground before them.
Eigen::Vector3d PointOnPlane(int plane, Random& random) {
  const double along = random.Uniform(0, 1);
  const double across = random.Uniform(0, 1);
  switch (plane) {
    case 0:
      return {-8 * along, -2 + 5 * along, 8 * across};
    case 1:
      return {8 * along, -2 + 5 * along, 8 * across};
    default:
      return {-7 + 14 * along, -3 - 6 * across, 0};
  }
}

std::vector<Eigen::Vector3d> MakePoints(const MadeOptions& options, Random& random) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < options.num_points; ++i) {
    if (random.Uniform(0, 1) < options.clutter_share) {
      points.emplace_back(random.Uniform(-7, 7), random.Uniform(-7, 2), random.Uniform(0, 7));
    } else {
      points.push_back(PointOnPlane(i % options.num_planes, random));
    }
  }
  return points;
}

ScenePhoto MakePhoto(const MadeOptions& options, int index) {
  const double share = options.num_photos > 1 ? double(index) / (options.num_photos - 1) : 0.5;
  const double angle = options.arc_rad * (share - 0.5);
  const Eigen::Vector3d position(kRadius * std::sin(angle), -kRadius * std::cos(angle),
                                 options.arc_rad == 0 ? 4.0 : 4 + 2 * std::sin(2.0 * index));
  // From one place the camera turns by up to 0.3 rad; otherwise it looks around the corner a bit.
  const double pan = options.arc_rad == 0 ? 12 * (share - 0.5) : 1.5 * std::sin(1.0 + index);
  const Eigen::Vector3d target(pan, 0, 3.5 + std::cos(1.7 * index));
  ScenePhoto photo;
  photo.name = "made/" + std::to_string(1000 + index) + ".jpg";
  photo.pose = LookAt(position, target);
  return photo;
}

int KeypointOfTrack(const SceneTrack& track, int photo) {
  for (const SceneElement& e : track.elements) {
    if (e.photo == photo) return e.keypoint;
  }
  return -1;
}

}  // namespace

double Random::Gauss(double sigma) {
  const double radius = std::sqrt(-2 * std::log(1 - Uniform(0, 1)));
  return sigma * radius * std::cos(2 * std::numbers::pi * Uniform(0, 1));
}

Camera MadeCamera(CameraModel model) {
  const std::vector<double> all = {1000,   1001,    604,   446,  -0.08,  0.03,
                                   0.0006, -0.0004, 0.004, 0.01, -0.006, 0.002};
  Camera camera;
  camera.id = CameraId{1};
  camera.model = model;
  camera.width_px = 1200;
  camera.height_px = 900;
  const auto count = static_cast<std::ptrdiff_t>(ParameterNames(model).size());
  camera.params.assign(all.begin(), all.begin() + count);
  return camera;
}

Pose LookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - position).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rotation;
  rotation.row(0) = right;
  rotation.row(1) = forward.cross(right);
  rotation.row(2) = forward;
  Pose pose;
  pose.rotation = Eigen::Quaterniond(rotation).normalized();
  pose.translation = -(pose.rotation * position);
  return pose;
}

Scene MakeScene(const MadeOptions& options) {
  Random random(options.seed);
  Scene scene;
  const Camera camera = MadeCamera(options.model);
  scene.cameras = {{camera, camera, 0.1}};
  for (int i = 0; i < options.num_photos; ++i) scene.photos.push_back(MakePhoto(options, i));
  for (const Eigen::Vector3d& point : MakePoints(options, random)) {
    std::vector<std::pair<int, Eigen::Vector2d>> seen;
    for (int i = 0; i < options.num_photos; ++i) {
      const auto pixel = camera.Project(*scene.photos[i].pose * point);
      const Eigen::Vector2d noise(random.Gauss(options.noise_px), random.Gauss(options.noise_px));
      const bool detected = random.Uniform(0, 1) < options.seen_share;
      if (!pixel || !detected || !camera.Contains(*pixel + noise)) continue;
      seen.emplace_back(i, *pixel + noise);
    }
    if (seen.size() < 2) continue;
    SceneTrack track;
    track.position = point;
    for (const auto& [i, pixel] : seen) {
      ScenePhoto& photo = scene.photos[i];
      track.elements.push_back({i, static_cast<int>(photo.keypoints.size()), true});
      photo.keypoints.push_back(pixel);
      photo.colors.push_back({static_cast<uint8_t>(i), 100, 200});
    }
    scene.tracks.push_back(track);
  }
  IndexTracks(scene);
  return scene;
}

Scene Blank(const Scene& truth) {
  Scene scene = truth;
  for (ScenePhoto& photo : scene.photos) photo.pose.reset();
  for (SceneTrack& track : scene.tracks) {
    track.position.reset();
    for (SceneElement& e : track.elements) e.used = false;
  }
  return scene;
}

std::vector<PhotoPair> MatchesOf(const Scene& truth, double wrong, uint32_t seed) {
  Random random(seed);
  std::vector<PhotoPair> pairs;
  const int count = static_cast<int>(truth.photos.size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      PhotoPair pair{a, b, {}};
      std::vector<size_t> wrong_ones;
      for (const SceneTrack& track : truth.tracks) {
        const int first = KeypointOfTrack(track, a);
        const int second = KeypointOfTrack(track, b);
        if (first < 0 || second < 0) continue;
        if (random.Uniform(0, 1) < wrong) wrong_ones.push_back(pair.matches.size());
        pair.matches.push_back({first, second});
      }
      // Each wrong match gets the second keypoint of the next one.
      for (size_t i = 0; i + 1 < wrong_ones.size(); ++i) {
        std::swap(pair.matches[wrong_ones[i]].second, pair.matches[wrong_ones[i + 1]].second);
      }
      std::sort(pair.matches.begin(), pair.matches.end());
      if (!pair.matches.empty()) pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

std::vector<VerifiedPair> Verified(const Scene& scene, const std::vector<PhotoPair>& pairs) {
  std::vector<VerifiedPair> verified;
  for (const PhotoPair& pair : pairs) {
    auto geometry = VerifyPair(scene.photos[pair.first].keypoints,
                               scene.photos[pair.second].keypoints, pair.matches, {});
    if (!geometry) continue;
    VerifiedPair result;
    result.pair = {pair.first, pair.second, geometry->inliers};
    result.geometry = std::move(*geometry);
    ClassifyMotion(scene, 4, result);
    verified.push_back(std::move(result));
  }
  return verified;
}

std::vector<SceneTrack> TracksFrom(const std::vector<size_t>& num_keypoints,
                                   const std::vector<PhotoPair>& pairs) {
  std::vector<const PhotoPair*> pointers;
  for (const PhotoPair& pair : pairs) pointers.push_back(&pair);
  return BuildTracks(num_keypoints, std::move(pointers));
}

void SetTracks(const std::vector<VerifiedPair>& pairs, Scene& scene) {
  std::vector<size_t> num_keypoints;
  for (const ScenePhoto& photo : scene.photos) num_keypoints.push_back(photo.keypoints.size());
  std::vector<PhotoPair> matches;
  for (const VerifiedPair& pair : pairs) matches.push_back(pair.pair);
  scene.tracks = TracksFrom(num_keypoints, matches);
  IndexTracks(scene);
}

PoseErrors ComparePoses(const Scene& actual, const Scene& truth) {
  std::vector<int> common;
  for (size_t i = 0; i < actual.photos.size(); ++i) {
    if (actual.photos[i].pose && truth.photos[i].pose) common.push_back(static_cast<int>(i));
  }
  Eigen::Matrix3Xd from(3, common.size());
  Eigen::Matrix3Xd to(3, common.size());
  for (size_t k = 0; k < common.size(); ++k) {
    from.col(k) = actual.photos[common[k]].pose->Center();
    to.col(k) = truth.photos[common[k]].pose->Center();
  }
  const Similarity truth_from_actual = AlignPoints(from, to);
  PoseErrors errors;
  errors.num_registered = static_cast<int>(common.size());
  for (const int i : common) {
    const Pose moved = Transformed(*actual.photos[i].pose, truth_from_actual);
    const Pose& expected = *truth.photos[i].pose;
    errors.position_m = std::max(errors.position_m, (moved.Center() - expected.Center()).norm());
    errors.rotation_rad =
        std::max(errors.rotation_rad, moved.rotation.angularDistance(expected.rotation));
  }
  return errors;
}

Pose Disturbed(const Pose& pose, double angle_rad, double offset, Random& random) {
  Pose motion;
  motion.rotation = Eigen::AngleAxisd(angle_rad, random.Vector(1).normalized());
  motion.translation = random.Vector(offset);
  return motion * pose;
}

}  // namespace stucco::test
