// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/facade_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluate/picture/tone.h"
#include "survey/error.h"
#include "survey/image.h"
#include "survey/rasterize.h"

namespace stucco::evaluate {
namespace {

// Labels of textures.json.
constexpr uint8_t kOutside = 0;
constexpr uint8_t kInpainted = 255;

Image ReadTexels(const std::filesystem::path& path, const TexturedFacet& facet, int channels) {
  Image image = ReadImage(path);
  if (image.width_px != facet.width_px || image.height_px != facet.height_px ||
      image.channels != channels) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: {} x {} pixels with {} channels, but textures.json says {} x {} "
                            "with {}",
                            path.string(), image.width_px, image.height_px, image.channels,
                            facet.width_px, facet.height_px, channels),
                "run the stage texture again");
  }
  return image;
}

simulate::PicturePlane PlaneOf(const TexturedFacet& facet, const Similarity& truth_from_world) {
  simulate::PicturePlane plane;
  plane.origin = truth_from_world * facet.origin;
  plane.u_axis = truth_from_world.rotation * facet.u_axis;
  plane.v_axis = truth_from_world.rotation * facet.v_axis;
  plane.metres_per_texel = truth_from_world.scale * facet.metres_per_texel;
  plane.width_px = facet.width_px;
  plane.height_px = facet.height_px;
  return plane;
}

// Means of `count` values, each `stride` apart and of `depth` floats, over runs of `factor` values.
struct Averaging {
  double factor = 1;
  int count = 0;
  size_t stride = 0;
};

void Average(const Averaging& run, const float* from, size_t depth, int index, float* to) {
  const double start = index * run.factor;
  const double end = std::min((index + 1) * run.factor, static_cast<double>(run.count));
  for (size_t d = 0; d < depth; ++d) {
    double sum = 0;
    for (int i = static_cast<int>(start); i < run.count && i < end; ++i) {
      sum += (std::min(i + 1.0, end) - std::max(static_cast<double>(i), start)) *
             from[i * run.stride + d];
    }
    to[d] = static_cast<float>(sum / (end - start));
  }
}

// Channels by texel: light, and whether it is known.
constexpr size_t kDepth = 4;

std::vector<float> AveragedAcross(const std::vector<float>& values, int width, int height,
                                  double factor, int new_width) {
  std::vector<float> out(static_cast<size_t>(new_width) * height * kDepth);
  for (int y = 0; y < height; ++y) {
    const float* row = values.data() + static_cast<size_t>(y) * width * kDepth;
    for (int x = 0; x < new_width; ++x) {
      Average({factor, width, kDepth}, row, kDepth, x,
              &out[(static_cast<size_t>(y) * new_width + x) * kDepth]);
    }
  }
  return out;
}

std::vector<float> AveragedDown(const std::vector<float>& values, int width, int height,
                                double factor, int new_height) {
  std::vector<float> out(static_cast<size_t>(width) * new_height * kDepth);
  for (int y = 0; y < new_height; ++y) {
    for (int x = 0; x < width; ++x) {
      Average({factor, height, static_cast<size_t>(width) * kDepth},
              values.data() + static_cast<size_t>(x) * kDepth, kDepth, y,
              &out[(static_cast<size_t>(y) * width + x) * kDepth]);
    }
  }
  return out;
}

// A side that is a hair shorter than a whole number of texels has that number.
int CountOf(int side, double factor) {
  return std::max(1, static_cast<int>(std::floor(side / factor + 1e-9)));
}

std::vector<Eigen::Vector2d> OnPlane(const std::vector<Eigen::Vector3d>& ring,
                                     const simulate::PicturePlane& plane) {
  std::vector<Eigen::Vector2d> out;
  for (const Eigen::Vector3d& vertex : ring) {
    const Eigen::Vector3d offset = (vertex - plane.origin) / plane.metres_per_texel;
    out.emplace_back(offset.dot(plane.u_axis), offset.dot(plane.v_axis));
  }
  return out;
}

// From the left and upper texel to before the right and lower one.
struct Texels {
  int left, top, right, bottom;
};

FacadePicture Cut(const FacadePicture& picture, const Texels& part) {
  const simulate::PicturePlane& plane = picture.plane;
  FacadePicture cut;
  cut.plane = plane;
  cut.plane.width_px = part.right - part.left;
  cut.plane.height_px = part.bottom - part.top;
  cut.plane.origin += plane.metres_per_texel * (part.left * plane.u_axis + part.top * plane.v_axis);
  const size_t texels = static_cast<size_t>(cut.plane.width_px) * cut.plane.height_px;
  cut.rgb.reserve(3 * texels);
  cut.known.reserve(texels);
  for (int y = part.top; y < part.bottom; ++y) {
    const size_t row = static_cast<size_t>(y) * plane.width_px;
    cut.rgb.insert(cut.rgb.end(), picture.rgb.data() + 3 * (row + part.left),
                   picture.rgb.data() + 3 * (row + part.right));
    cut.known.insert(cut.known.end(), picture.known.data() + row + part.left,
                     picture.known.data() + row + part.right);
  }
  return cut;
}

}  // namespace

FacadePicture ReadFacadePicture(const TexturedFacet& facet,
                                const std::filesystem::path& texture_folder,
                                const Similarity& truth_from_world) {
  FacadePicture picture;
  picture.plane = PlaneOf(facet, truth_from_world);
  const Image image = ReadTexels(texture_folder / facet.image, facet, 3);
  picture.rgb.reserve(image.data.size());
  for (const uint8_t code : image.data) picture.rgb.push_back(LightOfCode(code));
  picture.known.assign(image.data.size() / 3, 1);
  if (!facet.label_image.empty()) {
    const Image labels = ReadTexels(texture_folder / facet.label_image, facet, 1);
    for (size_t i = 0; i < picture.known.size(); ++i) {
      picture.known[i] = labels.data[i] != kOutside && labels.data[i] != kInpainted ? 1 : 0;
    }
  }
  return picture;
}

FacadePicture Coarsened(const FacadePicture& picture, double factor) {
  if (factor <= 1) return picture;
  const int width = picture.plane.width_px;
  const int height = picture.plane.height_px;
  std::vector<float> values(picture.known.size() * kDepth);
  for (size_t i = 0; i < picture.known.size(); ++i) {
    std::copy_n(&picture.rgb[3 * i], 3, &values[kDepth * i]);
    values[kDepth * i + 3] = picture.known[i] != 0 ? 1.0f : 0.0f;
  }
  FacadePicture coarse;
  coarse.plane = picture.plane;
  coarse.plane.metres_per_texel = picture.plane.metres_per_texel * factor;
  coarse.plane.width_px = CountOf(width, factor);
  coarse.plane.height_px = CountOf(height, factor);
  values = AveragedAcross(values, width, height, factor, coarse.plane.width_px);
  values = AveragedDown(values, coarse.plane.width_px, height, factor, coarse.plane.height_px);
  constexpr float kAll = 1 - 1e-5f;  // of floats' rounding
  for (size_t i = 0; i < values.size(); i += kDepth) {
    coarse.rgb.insert(coarse.rgb.end(), &values[i], &values[i] + 3);
    coarse.known.push_back(values[i + 3] >= kAll ? 1 : 0);
  }
  return coarse;
}

void KeepInside(const Facet& facet_in_scene, FacadePicture& picture) {
  std::vector<std::vector<Eigen::Vector2d>> rings = {OnPlane(facet_in_scene.outer, picture.plane)};
  for (const auto& hole : facet_in_scene.holes) rings.push_back(OnPlane(hole, picture.plane));
  const std::vector<uint8_t> inside =
      RasterizeRings(rings, picture.plane.width_px, picture.plane.height_px);
  for (size_t i = 0; i < inside.size(); ++i) picture.known[i] &= inside[i];
}

FacadePicture Cropped(const FacadePicture& picture) {
  const int width = picture.plane.width_px;
  int left = width, right = 0, top = picture.plane.height_px, bottom = 0;
  for (int y = 0; y < picture.plane.height_px; ++y) {
    for (int x = 0; x < width; ++x) {
      if (picture.known[static_cast<size_t>(y) * width + x] == 0) continue;
      left = std::min(left, x);
      right = std::max(right, x + 1);
      top = std::min(top, y);
      bottom = y + 1;
    }
  }
  if (right <= left) return Cut(picture, {0, 0, 0, 0});
  return Cut(picture, {left, top, right, bottom});
}

FacadePicture Middle(const FacadePicture& picture, int side_px) {
  const int left = std::max(0, (picture.plane.width_px - side_px) / 2);
  const int top = std::max(0, (picture.plane.height_px - side_px) / 2);
  return Cut(picture, {left, top, std::min(picture.plane.width_px, left + side_px),
                       std::min(picture.plane.height_px, top + side_px)});
}

size_t CountKnown(const FacadePicture& picture) {
  return static_cast<size_t>(std::count(picture.known.begin(), picture.known.end(), 1));
}

}  // namespace stucco::evaluate
