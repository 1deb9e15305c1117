// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/resect.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <set>

namespace stucco {
namespace {

// Rays are given to OpenCV as pixels of a camera with this focal length.
constexpr double kFocal = 1000;

struct Correspondences {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> rays;
};

Correspondences Collect(const Scene& scene, int photo) {
  Correspondences result;
  const Camera& camera = scene.CameraOf(photo);
  for (size_t k = 0; k < scene.tracks_of_photo[photo].size(); ++k) {
    const int track = scene.tracks_of_photo[photo][k];
    if (track < 0 || !scene.tracks[track].position) continue;
    const auto ray = camera.Unproject(scene.photos[photo].keypoints[k]);
    if (!ray) continue;
    const Eigen::Vector3d& p = *scene.tracks[track].position;
    result.points.emplace_back(p.x(), p.y(), p.z());
    result.rays.emplace_back(ray->x() * kFocal, ray->y() * kFocal);
  }
  return result;
}

Pose PoseFromOpenCv(const cv::Mat& rvec, const cv::Mat& tvec) {
  const Eigen::Vector3d axis(rvec.at<double>(0), rvec.at<double>(1), rvec.at<double>(2));
  Pose pose;
  if (axis.norm() > 0) {
    pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(axis.norm(), axis.normalized()));
  }
  pose.translation = {tvec.at<double>(0), tvec.at<double>(1), tvec.at<double>(2)};
  return pose;
}

std::vector<int> InliersOf(const Correspondences& all, const Pose& pose, double max_error) {
  std::vector<int> inliers;
  for (size_t i = 0; i < all.points.size(); ++i) {
    const Eigen::Vector3d p =
        pose * Eigen::Vector3d(all.points[i].x, all.points[i].y, all.points[i].z);
    if (p.z() <= 0) continue;
    const Eigen::Vector2d error =
        p.hnormalized() * kFocal - Eigen::Vector2d(all.rays[i].x, all.rays[i].y);
    if (error.squaredNorm() < max_error * max_error) inliers.push_back(static_cast<int>(i));
  }
  return inliers;
}

}  // namespace

std::optional<Resection> Resect(const Scene& scene, int photo, double max_error_px,
                                int min_inliers) {
  assert(scene.tracks_of_photo.size() == scene.photos.size());
  const Correspondences all = Collect(scene, photo);
  if (static_cast<int>(all.points.size()) < std::max(4, min_inliers)) return std::nullopt;
  const double max_error = max_error_px / scene.CameraOf(photo).FocalX() * kFocal;
  cv::Mat k = (cv::Mat_<double>(3, 3) << kFocal, 0, 0, 0, kFocal, 0, 0, 0, 1);
  cv::UsacParams params;
  params.confidence = 0.9999;
  params.maxIterations = 5000;
  params.threshold = max_error;
  params.isParallel = false;
  params.randomGeneratorState = 0;
  params.score = cv::SCORE_METHOD_MAGSAC;
  params.sampler = cv::SAMPLING_UNIFORM;
  params.loMethod = cv::LOCAL_OPTIM_INNER_LO;
  cv::Mat rvec;
  cv::Mat tvec;
  cv::Mat mask;
  cv::Mat distortion;
  try {
    if (!cv::solvePnPRansac(all.points, all.rays, k, distortion, rvec, tvec, mask, params)) {
      return std::nullopt;
    }
  } catch (const cv::Exception&) {
    return std::nullopt;  // degenerate points
  }
  Pose pose = PoseFromOpenCv(rvec, tvec);
  std::vector<int> inliers = InliersOf(all, pose, max_error);
  if (inliers.size() < 4) return std::nullopt;
  Correspondences good;
  for (const int i : inliers) {
    good.points.push_back(all.points[i]);
    good.rays.push_back(all.rays[i]);
  }
  cv::solvePnPRefineLM(good.points, good.rays, k, distortion, rvec, tvec);
  const Pose refined = PoseFromOpenCv(rvec, tvec);
  const std::vector<int> refined_inliers = InliersOf(all, refined, max_error);
  if (refined_inliers.size() >= inliers.size()) {
    pose = refined;
    inliers = refined_inliers;
  }
  if (static_cast<int>(inliers.size()) < min_inliers || !pose.translation.allFinite()) {
    return std::nullopt;
  }
  return Resection{pose, static_cast<int>(inliers.size()), static_cast<int>(all.points.size())};
}

int NumVisiblePoints(const Scene& scene, int photo) {
  int count = 0;
  for (const int track : scene.tracks_of_photo[photo]) {
    if (track >= 0 && scene.tracks[track].position) ++count;
  }
  return count;
}

int VisibilityScore(const Scene& scene, int photo) {
  const Camera& camera = scene.CameraOf(photo);
  int score = 0;
  for (int side = 2; side <= 16; side *= 2) {
    std::set<std::pair<int, int>> filled;
    for (size_t k = 0; k < scene.tracks_of_photo[photo].size(); ++k) {
      const int track = scene.tracks_of_photo[photo][k];
      if (track < 0 || !scene.tracks[track].position) continue;
      const Eigen::Vector2d& pixel = scene.photos[photo].keypoints[k];
      filled.emplace(static_cast<int>(pixel.x() / camera.width_px * side),
                     static_cast<int>(pixel.y() / camera.height_px * side));
    }
    score += static_cast<int>(filled.size()) * side;
  }
  return score;
}

}  // namespace stucco
