// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/foliage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <span>
#include <utility>

namespace stucco {
namespace {

constexpr float kLeastGreen = 0.1f;     // excess green index; of leaves 0.2 to 0.6, of plaster 0
constexpr float kLeastBrightness = 12;  // darker, colours are noise
constexpr int kReach = 3;               // raster texels: half a window
constexpr double kGreenShare = 0.25;    // of a window: crowns have gaps
constexpr double kRestless = 0.1;       // of what is green: standard deviation over mean brightness
constexpr double kSamePattern = 0.5;    // correlation of windows
constexpr double kMoved = 2;            // raster texels: windows of leaves are no longer alike
constexpr double kMostLeaves = 0.3;
constexpr double kLiesBack = -0.05;   // behind the wall's plane, world units: a pane, a niche
constexpr double kMirrored = 0.9;     // of a patch of leaves
constexpr int kAmid = 6;              // raster texels: half a window of a crown
constexpr float kAmidLeaves = 0.35f;  // of such a window
constexpr float kAmidLeavesBehind = 0.25f;
constexpr float kEnclosed = 0.7f;  // of a border
constexpr int kCell = 8;           // texels of a picture, a side

bool IsGreen(const float* rgb) {
  const float sum = rgb[0] + rgb[1] + rgb[2];
  if (sum < 3 * kLeastBrightness || rgb[1] <= rgb[0] || rgb[1] <= rgb[2]) return false;
  return (2 * rgb[1] - rgb[0] - rgb[2]) / sum >= kLeastGreen;
}

bool HasGreen(const RasterPicture& picture) {
  for (size_t i = 0; i < picture.sight.size(); ++i) {
    if (picture.sight[i] != Sight::kNot && IsGreen(&picture.rgb[3 * i])) return true;
  }
  return false;
}

// The texels around one, as indices.
template <typename Fn>
void ForEachAround(const TexelGrid& raster, size_t texel, Fn&& fn) {
  const int x = static_cast<int>(texel % raster.width);
  const int y = static_cast<int>(texel / raster.width);
  for (int j = std::max(0, y - kReach); j <= std::min(raster.height - 1, y + kReach); ++j) {
    for (int i = std::max(0, x - kReach); i <= std::min(raster.width - 1, x + kReach); ++i) {
      fn(static_cast<size_t>(j) * raster.width + i);
    }
  }
}

bool ShowsLeaves(const RasterPicture& picture, const TexelGrid& raster, size_t texel) {
  double seen = 0;
  double green = 0;
  double sum = 0;
  double squares = 0;
  ForEachAround(raster, texel, [&](size_t i) {
    if (picture.sight[i] == Sight::kNot) return;
    seen += 1;
    if (!IsGreen(&picture.rgb[3 * i])) return;
    const double grey = Brightness(&picture.rgb[3 * i]);
    green += 1;
    sum += grey;
    squares += grey * grey;
  });
  if (green == 0 || green < kGreenShare * seen) return false;
  const double mean = sum / green;
  return squares / green - mean * mean >= kRestless * kRestless * mean * mean;
}

// Whether two cameras show what stands before the wall in different places of it. Always where one
// of them is not known.
bool LookFromElsewhere(const RasterPicture& one, const RasterPicture& other,
                       const TexelGrid& raster, size_t texel, double before) {
  if (!(one.camera.z() > 0) || !(other.camera.z() > 0)) return true;
  const size_t column = texel % raster.width;
  const size_t row = texel / raster.width;
  const Eigen::Vector2d place(static_cast<double>(column), static_cast<double>(row));
  const Eigen::Vector2d way = (one.camera.head<2>() - place) / one.camera.z() -
                              (other.camera.head<2>() - place) / other.camera.z();
  return before * way.norm() >= kMoved;
}

// Whether two pictures have the same pattern around a texel.
bool LookAlike(const RasterPicture& one, const RasterPicture& other, const TexelGrid& raster,
               size_t texel) {
  double n = 0;
  double a = 0;
  double b = 0;
  double aa = 0;
  double bb = 0;
  double ab = 0;
  ForEachAround(raster, texel, [&](size_t i) {
    if (one.sight[i] == Sight::kNot || other.sight[i] == Sight::kNot) return;
    const double p = Brightness(&one.rgb[3 * i]);
    const double q = Brightness(&other.rgb[3 * i]);
    n += 1;
    a += p;
    b += q;
    aa += p * p;
    bb += q * q;
    ab += p * q;
  });
  const double variances = (n * aa - a * a) * (n * bb - b * b);
  return variances > 0 && n * ab - a * b >= kSamePattern * std::sqrt(variances);
}

// A picture's texels that show leaves.
std::vector<uint8_t> LeafMask(const RasterPicture& picture, const TexelGrid& raster) {
  std::vector<uint8_t> out(raster.size(), 0);
  if (!HasGreen(picture)) return out;
  for (size_t i = 0; i < raster.size(); ++i) {
    out[i] = picture.sight[i] != Sight::kNot && ShowsLeaves(picture, raster, i);
  }
  return out;
}

// By texel: a picture shows leaves, and the cloud has something there in front of the wall, or
// those from elsewhere that see it freely do not show the same.
std::vector<uint8_t> LeavesBeforeWall(std::span<const RasterPicture> pictures,
                                      std::span<const std::vector<uint8_t>> leaves, size_t asked,
                                      const TexelGrid& raster, double before) {
  const RasterPicture& picture = pictures[asked];
  std::vector<uint8_t> out(raster.size(), 0);
  for (size_t i = 0; i < raster.size(); ++i) {
    if (!leaves[asked][i]) continue;
    if (picture.sight[i] == Sight::kBehind) {
      out[i] = 1;
      continue;
    }
    bool seen_elsewhere = false;
    bool agreed = false;
    for (size_t other = 0; other < pictures.size() && !agreed; ++other) {
      if (other == asked || pictures[other].sight[i] != Sight::kFree) continue;
      if (!LookFromElsewhere(picture, pictures[other], raster, i, before)) continue;
      seen_elsewhere = true;
      agreed = leaves[other][i] && LookAlike(picture, pictures[other], raster, i);
    }
    out[i] = seen_elsewhere && !agreed;
  }
  return out;
}

// Leaves that end where a part of the wall that lies back does are a tree in a mirror: a pane shows
// every photo another one, and none of them is in front of it. Takes such patches out of a mask.
void KeepMirrors(const RasterPicture& picture, const TexelGrid& raster,
                 std::vector<uint8_t>& dropped) {
  if (!raster.relief) return;
  struct Patch {
    int green = 0;
    int back = 0;
  };
  const cv::Mat mask(raster.height, raster.width, CV_8UC1, dropped.data());
  cv::Mat number;
  std::vector<Patch> patches(cv::connectedComponents(mask, number, 8, CV_32S));
  const auto patch_of = [&](size_t i) -> Patch& {
    const auto texel = static_cast<int>(i);
    return patches[number.at<int>(texel / raster.width, texel % raster.width)];
  };
  for (size_t i = 0; i < dropped.size(); ++i) {
    if (dropped[i] == 0 || !IsGreen(&picture.rgb[3 * i])) continue;
    const size_t column = i % raster.width;
    const size_t row = i / raster.width;
    const double height =
        raster.HeightAt(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    ++patch_of(i).green;
    patch_of(i).back += height <= kLiesBack;
  }
  for (size_t i = 0; i < dropped.size(); ++i) {
    const bool is_mirrored = dropped[i] != 0 && patch_of(i).back > kMirrored * patch_of(i).green;
    if (is_mirrored) dropped[i] = 0;
  }
}

// What a picture shows amid leaves is of the same crown: dark leaves and boughs, which are not
// green, and gaps that are too small to tell a wall by. Where the cloud, too, has something in
// front fewer leaves around it are enough.
void FillCrowns(const RasterPicture& picture, const TexelGrid& raster,
                std::vector<uint8_t>& dropped) {
  cv::Mat seen(raster.height, raster.width, CV_32F);
  for (size_t i = 0; i < dropped.size(); ++i) {
    seen.ptr<float>()[i] = picture.sight[i] != Sight::kNot;
  }
  const cv::Size window(2 * kAmid + 1, 2 * kAmid + 1);
  cv::Mat leaves;
  cv::boxFilter(cv::Mat(raster.height, raster.width, CV_8UC1, dropped.data()), leaves, CV_32F,
                window, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(seen, seen, CV_32F, window, {-1, -1}, false, cv::BORDER_CONSTANT);
  for (size_t i = 0; i < dropped.size(); ++i) {
    if (picture.sight[i] == Sight::kNot) continue;
    const float most = picture.sight[i] == Sight::kBehind ? kAmidLeavesBehind : kAmidLeaves;
    if (leaves.ptr<float>()[i] > most * seen.ptr<float>()[i]) dropped[i] = 1;
  }
}

// What leaves enclose is the inside of a crown, or too little of the wall to be told from it:
// pieces with leaves along most of their border, and much smaller than all leaves.
void FillEnclosed(const RasterPicture& picture, const TexelGrid& raster,
                  std::vector<uint8_t>& dropped) {
  struct Piece {
    int texels = 0;
    int border = 0;
    int leaves = 0;  // along the border
  };
  cv::Mat left(raster.height, raster.width, CV_8UC1);
  int most = 0;
  for (int i = 0; i < static_cast<int>(dropped.size()); ++i) {
    left.data[i] = dropped[i] == 0 && picture.sight[i] != Sight::kNot;
    most += dropped[i];
  }
  cv::Mat number;
  std::vector<Piece> pieces(cv::connectedComponents(left, number, 4, CV_32S));
  const auto number_of = [&](int x, int y) { return number.at<int>(y, x); };
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      if (number_of(x, y) == 0) continue;
      Piece& piece = pieces[number_of(x, y)];
      ++piece.texels;
      for (const auto& [i, j] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
        const bool outside = i < 0 || j < 0 || i >= raster.width || j >= raster.height;
        if (!outside && number_of(i, j) != 0) continue;
        ++piece.border;
        piece.leaves += !outside && dropped[static_cast<size_t>(j) * raster.width + i];
      }
    }
  }
  for (size_t i = 0; i < dropped.size(); ++i) {
    const Piece& piece = pieces[number.ptr<int>()[i]];
    const bool enclosed = piece.leaves > kEnclosed * piece.border && 4 * piece.texels < most;
    if (left.data[i] != 0 && enclosed) dropped[i] = 1;
  }
}

// Whether so much would be left that no picture sees that green must be the wall's own.
bool WouldLoseTooMuch(std::span<const RasterPicture> pictures,
                      std::span<const std::vector<uint8_t>> dropped,
                      std::span<const uint16_t> inside) {
  double seen = 0;
  double left = 0;
  for (size_t i = 0; i < inside.size(); ++i) {
    bool is_seen = false;
    bool is_left = false;
    for (size_t p = 0; p < pictures.size(); ++p) {
      const bool sees = pictures[p].sight[i] != Sight::kNot;
      is_seen |= sees;
      is_left |= sees && !dropped[p][i];
    }
    if (is_seen) seen += inside[i];
    if (is_left) left += inside[i];
  }
  return seen - left > kMostLeaves * seen;
}

}  // namespace

void DropFoliage(const FacetRaster& raster, double before, std::vector<RasterPicture>& pictures) {
  std::vector<std::vector<uint8_t>> leaves(pictures.size());
  for (size_t p = 0; p < pictures.size(); ++p) leaves[p] = LeafMask(pictures[p], raster.grid);
  std::vector<std::vector<uint8_t>> dropped(pictures.size());
  for (size_t p = 0; p < pictures.size(); ++p) {
    dropped[p] = LeavesBeforeWall(pictures, leaves, p, raster.grid, before);
    KeepMirrors(pictures[p], raster.grid, dropped[p]);
    FillCrowns(pictures[p], raster.grid, dropped[p]);
    FillEnclosed(pictures[p], raster.grid, dropped[p]);
  }
  if (WouldLoseTooMuch(pictures, dropped, raster.inside)) return;
  for (size_t p = 0; p < pictures.size(); ++p) {
    for (size_t i = 0; i < raster.grid.size(); ++i) {
      if (dropped[p][i]) pictures[p].sight[i] = Sight::kNot;
    }
  }
}

std::vector<uint8_t> LeafTexels(const Image& picture, const std::vector<uint8_t>& painted) {
  TexelGrid raster;
  raster.width = (picture.width_px + kCell - 1) / kCell;
  raster.height = (picture.height_px + kCell - 1) / kCell;
  std::vector<int> count(raster.size(), 0);
  RasterPicture cells;
  cells.rgb.assign(3 * raster.size(), 0);
  const auto cell_of = [&](size_t texel) {
    const size_t x = texel % picture.width_px, y = texel / picture.width_px;
    return y / kCell * raster.width + x / kCell;
  };
  for (size_t i = 0; i < painted.size(); ++i) {
    if (!painted[i]) continue;
    const size_t cell = cell_of(i);
    ++count[cell];
    for (size_t k = 0; k < 3; ++k) cells.rgb[3 * cell + k] += picture.data[3 * i + k];
  }
  for (size_t cell = 0; cell < count.size(); ++cell) {
    cells.sight.push_back(count[cell] > 0 ? Sight::kFree : Sight::kNot);
    for (size_t k = 0; k < 3 && count[cell] > 0; ++k) {
      cells.rgb[3 * cell + k] /= static_cast<float>(count[cell]);
    }
  }
  const std::vector<uint8_t> leafy = LeafMask(cells, raster);
  std::vector<uint8_t> out(painted.size(), 0);
  for (size_t i = 0; i < out.size(); ++i) out[i] = painted[i] && leafy[cell_of(i)];
  return out;
}

}  // namespace stucco
