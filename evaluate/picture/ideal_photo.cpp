// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/ideal_photo.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "evaluate/figures/evaluation.h"
#include "evaluate/geometry/surface.h"
#include "simulate/flight/sensor.h"
#include "survey/encode_image.h"
#include "survey/median.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

constexpr size_t kPlaces = 40;  // of a wall, of which each asks all photos
constexpr uint64_t kPlaceSeed = 3;
constexpr double kOffTheWall_m = 0.05;  // rays begin here: reliefs as deep hide nothing
constexpr double kUsedShare = 0.9;      // of a photo's sides: lenses bend what lies beyond
constexpr int kMostTaps = 8;            // along a texel's side
constexpr uint64_t kNoiseSeed = 7;

double FinestAt(const SurfacePoint& place, std::span<const simulate::FlownPhoto> photos,
                const simulate::Renderer& scene) {
  double finest = std::numeric_limits<double>::infinity();
  for (const simulate::FlownPhoto& photo : photos) {
    if (photo.held_out) continue;
    const Vector3d to_camera = photo.cam_from_world.Center() - place.position;
    const double distance = to_camera.norm();
    const double height = to_camera.dot(place.normal);
    if (!(height > kOffTheWall_m) || distance * distance / height >= finest) continue;
    const auto pixel = photo.camera.Project(photo.cam_from_world * place.position);
    if (!pixel || !photo.camera.Contains(*pixel)) continue;
    const Vector3d from = place.position + kOffTheWall_m * place.normal;
    const auto hit = scene.Cast(from, photo.cam_from_world.Center() - from);
    if (hit && hit->distance < (photo.cam_from_world.Center() - from).norm()) continue;
    finest = distance * distance / height;
  }
  return finest;
}

// The texels of one photo.
struct Part {
  int left = 0, top = 0, width = 0, height = 0;
};

// A side in parts of about the same length, each at most `most` texels: from where to where.
std::vector<int> Cuts(int side, double most) {
  const int parts = std::max(1, static_cast<int>(std::ceil(side / std::max(1.0, most))));
  std::vector<int> cuts;
  for (int i = 0; i <= parts; ++i) {
    cuts.push_back(static_cast<int>(static_cast<int64_t>(side) * i / parts));
  }
  return cuts;
}

Pose PoseBefore(const simulate::PicturePlane& plane, const Vector3d& middle, double distance_m) {
  Eigen::Matrix3d axes;
  axes.row(0) = plane.u_axis;
  axes.row(1) = plane.v_axis;
  axes.row(2) = plane.u_axis.cross(plane.v_axis);
  Pose pose;
  pose.rotation = Eigen::Quaterniond(axes).normalized();
  pose.translation = -(pose.rotation * (middle - distance_m * axes.row(2).transpose()));
  return pose;
}

Vector3d PlaceOn(const simulate::PicturePlane& plane, double x, double y) {
  return plane.origin + plane.metres_per_texel * (x * plane.u_axis + y * plane.v_axis);
}

simulate::SensorEffects EffectsOf(const IdealShot& shot) {
  simulate::SensorEffects effects;
  effects.white_balance = {shot.gains[0], shot.gains[1], shot.gains[2]};
  effects.focus_blur_px = shot.faults.focus_blur_px;
  const double each_px = shot.faults.motion_blur_px / std::numbers::sqrt2;
  effects.turn_rad = {each_px / shot.lens.FocalX(), each_px / shot.lens.FocalY(), 0};
  effects.noise = shot.faults.noise;
  effects.seed = kNoiseSeed;
  effects.sharpening = shot.faults.sharpening;
  return effects;
}

cv::Mat Compressed(const Image& photo, int quality) {
  const std::string jpeg = EncodeImage(photo, "ideal.jpg", quality);
  const std::vector<uint8_t> bytes(jpeg.begin(), jpeg.end());
  cv::Mat rgb;
  cv::cvtColor(cv::imdecode(bytes, cv::IMREAD_COLOR), rgb, cv::COLOR_BGR2RGB);
  return rgb;
}

// What a part's texels show, each the mean of `taps` times `taps` places in it.
cv::Mat Sampled(const cv::Mat& photo, const IdealShot& shot, const Pose& pose,
                const simulate::PicturePlane& plane, const Part& part) {
  const double texel_px = plane.metres_per_texel * shot.lens.FocalX() / shot.distance_m;
  const int taps = std::clamp(static_cast<int>(std::ceil(texel_px - 0.2)), 1, kMostTaps);
  cv::Mat sum = cv::Mat::zeros(part.height, part.width, CV_32FC3);
  cv::Mat x(part.height, part.width, CV_32F);
  cv::Mat y(part.height, part.width, CV_32F);
  cv::Mat sample;
  for (int tap = 0; tap < taps * taps; ++tap) {
    const int across = tap % taps;
    const int down = tap / taps;
    for (int row = 0; row < part.height; ++row) {
      for (int column = 0; column < part.width; ++column) {
        const Vector3d place = PlaceOn(plane, part.left + column + (across + 0.5) / taps,
                                       part.top + row + (down + 0.5) / taps);
        const Eigen::Vector2d pixel = shot.lens.Distort((pose * place).hnormalized());
        x.at<float>(row, column) = static_cast<float>(pixel.x() - 0.5);
        y.at<float>(row, column) = static_cast<float>(pixel.y() - 0.5);
      }
    }
    cv::remap(photo, sample, x, y, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    cv::accumulate(sample, sum);
  }
  cv::Mat mean;
  sum.convertTo(mean, CV_8UC3, 1.0 / (taps * taps));
  return mean;
}

void Take(const IdealShot& shot, const simulate::PicturePlane& plane, const Part& part,
          IdealPicture& out) {
  const Vector3d middle =
      PlaceOn(plane, part.left + 0.5 * part.width, part.top + 0.5 * part.height);
  const Pose pose = PoseBefore(plane, middle, shot.distance_m);
  const simulate::RenderOptions options{.threads = 1, .left_out = shot.left_out};
  const Image photo = simulate::Develop(shot.scene.Photograph(shot.lens, pose, shot.light, options),
                                        shot.lens, EffectsOf(shot), 1);
  const DepthMap depth = shot.scene.Depth(shot.lens, pose, options);
  const cv::Mat texels =
      Sampled(Compressed(photo, shot.faults.jpeg_quality), shot, pose, plane, part);
  for (int row = 0; row < part.height; ++row) {
    for (int column = 0; column < part.width; ++column) {
      const int to_x = part.left + column;
      const int to_y = part.top + row;
      const Vector3d in_cam = pose * PlaceOn(plane, to_x + 0.5, to_y + 0.5);
      const auto pixel = shot.lens.Project(in_cam);
      if (!pixel || !shot.lens.Contains(*pixel)) continue;
      const float way = depth.depths[static_cast<size_t>(pixel->y()) * shot.lens.width_px +
                                     static_cast<size_t>(pixel->x())];
      if (!(way > in_cam.z() - plane.from_m)) continue;
      const auto& rgb = texels.at<cv::Vec3b>(row, column);
      std::copy_n(rgb.val, 3, out.picture.Pixel(to_x, to_y));
      out.shown[static_cast<size_t>(to_y) * plane.width_px + to_x] = 1;
    }
  }
}

}  // namespace

double IdealDistance(const Facet& wall, std::span<const simulate::FlownPhoto> photos,
                     const simulate::Renderer& scene) {
  Surface surface;
  Append(wall, surface);
  std::vector<double> finest;
  for (SurfacePoint& place : SamplePoints(surface, kPlaces, kPlaceSeed)) {
    place.normal = wall.normal;
    const double at = FinestAt(place, photos, scene);
    if (std::isfinite(at)) finest.push_back(at);
  }
  return Median(std::move(finest)).value_or(kNotMeasured);
}

IdealPicture TakeIdealPhotos(const IdealShot& shot, const simulate::PicturePlane& plane) {
  assert(shot.distance_m > 0 && plane.width_px > 0 && plane.height_px > 0);
  const size_t texels = static_cast<size_t>(plane.width_px) * plane.height_px;
  IdealPicture out{{plane.width_px, plane.height_px, 3, {}}, std::vector<uint8_t>(texels, 0)};
  out.picture.data.assign(3 * texels, 0);
  const double used = kUsedShare * shot.distance_m / plane.metres_per_texel;
  const std::vector<int> across =
      Cuts(plane.width_px, used * shot.lens.width_px / shot.lens.FocalX());
  const std::vector<int> down =
      Cuts(plane.height_px, used * shot.lens.height_px / shot.lens.FocalY());
  for (size_t j = 0; j + 1 < down.size(); ++j) {
    for (size_t i = 0; i + 1 < across.size(); ++i) {
      Take(shot, plane, {across[i], down[j], across[i + 1] - across[i], down[j + 1] - down[j]},
           out);
    }
  }
  return out;
}

}  // namespace stucco::evaluate
