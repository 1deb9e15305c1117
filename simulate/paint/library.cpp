// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/paint/internal/library.h"

#include <toml++/toml.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "simulate/paint/internal/noise.h"

namespace stucco::simulate::internal {
namespace {

struct Rectangle {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
};

std::vector<Rectangle> Rectangles(const toml::table& entry, std::string_view key) {
  std::vector<Rectangle> result;
  if (const toml::array* list = entry[key].as_array()) {
    for (const toml::node& node : *list) {
      const toml::array& four = *node.as_array();
      const auto at = [&four](size_t i) { return four[i].value_or(0); };
      result.push_back({at(0), at(1), at(2), at(3)});
    }
  }
  return result;
}

cv::Mat Decode(std::span<const unsigned char> jpeg) {
  const cv::Mat bytes(1, static_cast<int>(jpeg.size()), CV_8U,
                      const_cast<unsigned char*>(jpeg.data()));
  return cv::imdecode(bytes, cv::IMREAD_COLOR);
}

Pane CutOut(const cv::Mat& picture, const Rectangle& at) {
  Pane pane{at.right - at.left, at.bottom - at.top, {}};
  for (int y = at.top; y < at.bottom; ++y) {
    for (int x = at.left; x < at.right; ++x) {
      const cv::Vec3b& bgr = picture.at<cv::Vec3b>(y, x);
      pane.colours.push_back(FromSrgb(bgr[2], bgr[1], bgr[0]));
    }
  }
  return pane;
}

Eigen::Vector3d Logarithm(Colour c) {
  constexpr double kBlack = 1e-3;  // an 8-bit level or two
  return {std::log(c.r + kBlack), std::log(c.g + kBlack), std::log(c.b + kBlack)};
}

Colour ToColour(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Palette PaletteOf(const std::vector<Pane>& walls) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double count = 0;
  for (const Pane& wall : walls) {
    for (const Colour& colour : wall.colours) {
      const Eigen::Vector3d v = Logarithm(colour);
      sum += v;
      squares += v * v.transpose();
      count += 1;
    }
  }
  const Eigen::Vector3d mean = sum / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / count -
                                                              mean * mean.transpose());
  Palette palette;
  palette.mean = ToColour(mean);
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d axis = solver.eigenvectors().col(2 - i);
    if (axis.sum() < 0) axis = -axis;  // an eigenvector's sign is free; ours makes brighter
    palette.axes[i] = ToColour(axis * std::sqrt(std::max(0.0, solver.eigenvalues()[2 - i])));
  }
  return palette;
}

Patch PatchOf(const Pane& wall) {
  Patch patch{wall.width, wall.height, {}};
  double sum = 0;
  for (const Colour& colour : wall.colours) {
    patch.values.push_back(std::log(Luminance(colour) + 1e-3f));
    sum += patch.values.back();
  }
  const float mean = static_cast<float>(sum / static_cast<double>(patch.values.size()));
  for (float& value : patch.values) value -= mean;
  // Pixel by pixel there is more of the JPEG than of the wall.
  cv::Mat values(patch.height, patch.width, CV_32F, patch.values.data());
  cv::GaussianBlur(values, values, {0, 0}, 1.5, 1.5, cv::BORDER_REFLECT);
  return patch;
}

FacadeLibrary Load() {
  FacadeLibrary library;
  const toml::table catalogue = toml::parse(CarriedCatalogue());
  for (const CarriedPicture& carried : CarriedPictures()) {
    const toml::table& entry = *catalogue[carried.name].as_table();
    const cv::Mat pixels = Decode(carried.jpeg);
    FacadePicture picture;
    picture.name = carried.name;
    picture.kind = entry["kind"].value_or(std::string());
    picture.metres_per_px =
        static_cast<float>(entry["width_m"].value_or(10.0)) / static_cast<float>(pixels.cols);
    std::vector<Pane> walls;
    for (const Rectangle& at : Rectangles(entry, "walls")) walls.push_back(CutOut(pixels, at));
    picture.palette = PaletteOf(walls);
    for (const Pane& wall : walls) picture.walls.push_back(PatchOf(wall));
    for (const Rectangle& at : Rectangles(entry, "windows")) {
      library.windows.push_back(CutOut(pixels, at));
    }
    for (const Rectangle& at : Rectangles(entry, "shops")) {
      library.shops.push_back(CutOut(pixels, at));
    }
    library.pictures.push_back(std::move(picture));
  }
  return library;
}

int Mirrored(int index, int size) {
  const int period = 2 * size;
  const int within = ((index % period) + period) % period;
  return within < size ? within : period - 1 - within;
}

}  // namespace

Colour Pick(const Palette& palette, float a, float b, float c) {
  const Colour log = palette.mean + a * palette.axes[0] + b * palette.axes[1] + c * palette.axes[2];
  return {std::exp(log.r), std::exp(log.g), std::exp(log.b)};
}

Palette Calmed(const Palette& palette, float most, float darkest) {
  constexpr float kChroma = 0.7f;  // old compact cameras saturate colours
  constexpr float kLightest = 0.62f;
  Palette calmed = palette;
  Colour& mean = calmed.mean;
  // Paint that is made lighter becomes paler.
  const float photographed = Luminance(Pick(palette, 0, 0, 0));
  const float pale = std::min(1.0f, std::sqrt(photographed / darkest));
  const float grey = (mean.r + mean.g + mean.b) / 3;
  mean = Mix({grey, grey, grey}, mean, kChroma * pale);
  const float light = Luminance(Pick(calmed, 0, 0, 0));
  const float lift = std::log(std::clamp(light, darkest, kLightest) / light);
  mean = mean + Grey(lift);
  const Colour& first = palette.axes[0];
  const float length = std::sqrt(first.r * first.r + first.g * first.g + first.b * first.b);
  const float scale = std::min(1.0f, most / std::max(length, 1e-6f));
  for (Colour& axis : calmed.axes) axis = axis * scale;
  return calmed;
}

float At(const Patch& patch, float x_px, float y_px) {
  const int x = Floor(x_px - 0.5f);
  const int y = Floor(y_px - 0.5f);
  const float u = Smooth(0, 1, x_px - 0.5f - static_cast<float>(x));
  const float v = Smooth(0, 1, y_px - 0.5f - static_cast<float>(y));
  const auto value = [&patch](int column, int row) {
    return patch.values[static_cast<size_t>(Mirrored(row, patch.height)) * patch.width +
                        Mirrored(column, patch.width)];
  };
  return Mix(Mix(value(x, y), value(x + 1, y), u), Mix(value(x, y + 1), value(x + 1, y + 1), u), v);
}

Colour At(const Pane& pane, float u, float v) {
  const float px = std::clamp(u, 0.0f, 1.0f) * static_cast<float>(pane.width) - 0.5f;
  const float py = std::clamp(v, 0.0f, 1.0f) * static_cast<float>(pane.height) - 0.5f;
  const int x = Floor(px);
  const int y = Floor(py);
  const float su = Smooth(0, 1, px - static_cast<float>(x));
  const float sv = Smooth(0, 1, py - static_cast<float>(y));
  const auto colour = [&pane](int column, int row) {
    return pane.colours[static_cast<size_t>(std::clamp(row, 0, pane.height - 1)) * pane.width +
                        std::clamp(column, 0, pane.width - 1)];
  };
  return Mix(Mix(colour(x, y), colour(x + 1, y), su),
             Mix(colour(x, y + 1), colour(x + 1, y + 1), su), sv);
}

const FacadeLibrary& Facades() {
  static const FacadeLibrary library = Load();
  return library;
}

const FacadePicture& PictureOf(std::string_view kind, int choice) {
  const std::vector<FacadePicture>& all = Facades().pictures;
  const auto is_of_kind = [kind](const FacadePicture& picture) { return picture.kind == kind; };
  const int count = static_cast<int>(std::count_if(all.begin(), all.end(), is_of_kind));
  assert(count > 0);
  int skip = ((choice % count) + count) % count;
  return *std::find_if(all.begin(), all.end(), [&](const FacadePicture& picture) {
    return is_of_kind(picture) && skip-- == 0;
  });
}

}  // namespace stucco::simulate::internal
