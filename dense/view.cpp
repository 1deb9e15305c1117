// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/view.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace stucco {
namespace {

cv::Mat Wrap(const Image& image) {
  return {image.height_px, image.width_px, CV_8UC3, const_cast<uint8_t*>(image.data.data())};
}

Image Undistort(const Image& source, const Camera& full, const PinholeCamera& view) {
  const Camera camera = Resized(full, source.width_px, source.height_px);
  cv::Mat map_x(view.height, view.width, CV_32F);
  cv::Mat map_y(view.height, view.width, CV_32F);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const Eigen::Vector2d pixel = camera.Distort(
          view.Ray(static_cast<float>(x), static_cast<float>(y)).head<2>().cast<double>());
      map_x.at<float>(y, x) = static_cast<float>(pixel.x() - 0.5);
      map_y.at<float>(y, x) = static_cast<float>(pixel.y() - 0.5);
    }
  }
  Image result{view.width, view.height, 3,
               std::vector<uint8_t>(size_t{3} * view.width * view.height)};
  cv::Mat target = Wrap(result);
  cv::remap(Wrap(source), target, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return result;
}

PinholeCamera Halved(const PinholeCamera& view) {
  PinholeCamera half = view;
  half.width = std::max(1, view.width / 2);
  half.height = std::max(1, view.height / 2);
  const float scale_x = static_cast<float>(half.width) / view.width;
  const float scale_y = static_cast<float>(half.height) / view.height;
  half.fx *= scale_x;
  half.fy *= scale_y;
  half.cx = (view.cx + 0.5f) * scale_x - 0.5f;
  half.cy = (view.cy + 0.5f) * scale_y - 0.5f;
  return half;
}

}  // namespace

PackedImage Pack(int width, int height, std::vector<uint8_t> gray) {
  PackedImage image{width, height, std::vector<uint32_t>(gray.size()), std::move(gray)};
  for (int y = 0; y < height; ++y) {
    const uint8_t* row = image.gray.data() + static_cast<size_t>(y) * width;
    const uint8_t* next = y + 1 < height ? row + width : row;
    for (int x = 0; x < width; ++x) {
      const int right = std::min(x + 1, width - 1);
      image.quads[static_cast<size_t>(y) * width + x] = row[x] | uint32_t{row[right]} << 8 |
                                                        uint32_t{next[x]} << 16 |
                                                        uint32_t{next[right]} << 24;
    }
  }
  return image;
}

std::vector<PinholeCamera> PinholeLevels(const Camera& camera, const Pose& cam_from_world,
                                         int max_image_px, int num_levels) {
  const ImageSize size = ScaledSize({camera.width_px, camera.height_px}, max_image_px);
  const Camera scaled = Resized(camera, size.width_px, size.height_px);
  PinholeCamera view;
  view.width = size.width_px;
  view.height = size.height_px;
  view.fx = static_cast<float>(scaled.FocalX());
  view.fy = static_cast<float>(scaled.FocalY());
  view.cx = static_cast<float>(scaled.PrincipalPoint().x() - 0.5);
  view.cy = static_cast<float>(scaled.PrincipalPoint().y() - 0.5);
  view.rotation = cam_from_world.rotation.toRotationMatrix().cast<float>();
  view.translation = cam_from_world.translation;
  std::vector<PinholeCamera> levels = {view};
  while (static_cast<int>(levels.size()) < num_levels) levels.push_back(Halved(levels.back()));
  return levels;
}

std::shared_ptr<const ViewPyramid> LoadView(const std::filesystem::path& photo_folder,
                                            const SurveyPhoto& photo, int max_image_px,
                                            int num_levels) {
  auto pyramid = std::make_shared<ViewPyramid>();
  pyramid->cameras = PinholeLevels(photo.camera, photo.cam_from_world, max_image_px, num_levels);
  pyramid->color = Undistort(ReadJpeg(photo_folder / photo.path(), 3, max_image_px), photo.camera,
                             pyramid->cameras[0]);
  cv::Mat gray;
  cv::cvtColor(Wrap(pyramid->color), gray, cv::COLOR_RGB2GRAY);
  for (const PinholeCamera& view : pyramid->cameras) {
    if (gray.cols != view.width || gray.rows != view.height) {
      cv::Mat smaller;
      cv::resize(gray, smaller, cv::Size(view.width, view.height), 0, 0, cv::INTER_AREA);
      gray = smaller;
    }
    pyramid->images.push_back(
        Pack(view.width, view.height, std::vector<uint8_t>(gray.data, gray.data + gray.total())));
  }
  return pyramid;
}

}  // namespace stucco
