// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/measure_points.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "calib/scene/triangulate.h"

namespace stucco {
namespace {

// A mark farther from its point than this is another point's, or a slip of the hand. Poses alone
// may err by some pixels.
constexpr double kWorstMark_px = 10;

// Cameras and poses, without keypoints.
Scene PosesOf(const Scene& scene) {
  Scene poses;
  poses.cameras = scene.cameras;
  for (const ScenePhoto& photo : scene.photos) {
    ScenePhoto& bare = poses.photos.emplace_back();
    bare.camera = photo.camera;
    bare.pose = photo.pose;
  }
  return poses;
}

SceneTrack TrackOf(const std::vector<PhotoMark>& marks, Scene& poses) {
  SceneTrack track;
  for (const PhotoMark& mark : marks) {
    std::vector<Eigen::Vector2d>& pixels = poses.photos[mark.photo].keypoints;
    track.elements.push_back({mark.photo, static_cast<int>(pixels.size()), false});
    pixels.push_back(mark.pixel);
  }
  return track;
}

std::string WhyNot(size_t num_marks, size_t num_posed) {
  if (num_marks == 0) return "no line for it could be used";
  if (num_posed < 2) {
    return fmt::format("marked in {} photo{} with a pose, two are needed; mark it in more",
                       num_posed, num_posed == 1 ? "" : "s");
  }
  return fmt::format(
      "its marks in {} photos meet in no point, or under too small an angle; check them",
      num_posed);
}

// What is left of the measurement once the point is known.
void Describe(const Scene& poses, const SceneTrack& track, MeasuredPoint& measured) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  double squares = 0;
  double pixels = 0;
  for (const SceneElement& element : track.elements) {
    const ScenePhoto& photo = poses.photos[element.photo];
    if (!photo.pose) continue;
    const PhotoMark mark{element.photo, photo.keypoints[element.keypoint]};
    (element.used ? measured.used : measured.refused).push_back(mark);
    if (!element.used) continue;
    const double error = ReprojectionError(poses, element, *track.position);
    squares += error * error;
    const Eigen::Vector3d to_point = *track.position - photo.pose->Center();
    const Eigen::Vector3d ray = to_point.normalized();
    const double pixel = to_point.norm() / poses.CameraOf(element.photo).FocalX();
    pixels += pixel;
    normal += (Eigen::Matrix3d::Identity() - ray * ray.transpose()) /
              (pixel * pixel * kMarkSigma_px * kMarkSigma_px);
  }
  const auto count = static_cast<double>(measured.used.size());
  measured.reprojection_error_px = std::sqrt(squares / count);
  measured.ground_pixel = pixels / count;
  measured.covariance = normal.inverse();
}

}  // namespace

std::vector<MeasuredPoint> MeasurePoints(const Scene& scene, std::span<const MarkedPoint> points,
                                         double min_angle_rad) {
  Scene poses = PosesOf(scene);
  std::vector<MeasuredPoint> result;
  for (const MarkedPoint& point : points) {
    MeasuredPoint& measured = result.emplace_back();
    SceneTrack track = TrackOf(point.marks, poses);
    if (TriangulateTrack(poses, {kWorstMark_px, min_angle_rad}, track)) {
      measured.position = track.position;
      Describe(poses, track, measured);
      continue;
    }
    size_t num_posed = 0;
    for (const PhotoMark& mark : point.marks) num_posed += scene.photos[mark.photo].pose ? 1 : 0;
    measured.why_not = WhyNot(point.marks.size(), num_posed);
  }
  return result;
}

}  // namespace stucco
