// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/background.h"

#include <algorithm>
#include <cmath>

namespace stucco {
namespace {

// Rays that fall by more than this per length hit the ground, not the sky; poses and up are a
// little off.
constexpr double kClearFall = 0.02;
constexpr float kSkyBrightness = 130;
constexpr float kSkyContrast = 8;    // largest difference to a neighbour
constexpr float kSkyWarmth = 2;      // red over blue
constexpr float kWallLikeness = 45;  // root mean square over the channels
constexpr double kWallShare = 0.15;  // of the wall that must be alike
constexpr size_t kWallSamples = 400;
constexpr double kMostDropped = 0.3;
constexpr int kGrowth = 12;  // raster texels
constexpr int kRim = 1;
constexpr float kGrowthContrast = 20;

bool CouldBeSky(const float* rgb) {
  return Brightness(rgb) >= kSkyBrightness && rgb[0] <= rgb[2] + kSkyWarmth;
}

// Bright, not warm, and the same as most of what is around it.
bool LooksLikeSky(const TexelGrid& raster, const std::vector<float>& rgb, int x, int y) {
  const float* own = &rgb[3 * (static_cast<size_t>(y) * raster.width + x)];
  if (!CouldBeSky(own)) return false;
  int alike = 0;
  int all = 0;
  for (int j = std::max(0, y - 1); j <= std::min(raster.height - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(raster.width - 1, x + 1); ++i) {
      const float* other = &rgb[3 * (static_cast<size_t>(j) * raster.width + i)];
      alike += std::abs(Brightness(other) - Brightness(own)) <= kSkyContrast;
      ++all;
    }
  }
  return 2 * alike >= all;
}

// Colours of texels where the cloud has points: certainly not the sky.
std::vector<const float*> SampleWall(const std::vector<uint8_t>& no_points,
                                     const std::vector<float>& rgb,
                                     const std::vector<Sight>& sight) {
  std::vector<const float*> wall;
  for (size_t i = 0; i < sight.size(); ++i) {
    if (sight[i] == Sight::kFree && !no_points[i]) wall.push_back(&rgb[3 * i]);
  }
  const size_t step = wall.size() / kWallSamples + 1;
  std::vector<const float*> samples;
  for (size_t i = 0; i < wall.size(); i += step) samples.push_back(wall[i]);
  return samples;
}

// Whether enough of the wall has about this colour.
bool LooksLikeWall(const std::vector<const float*>& wall, const float* rgb) {
  const auto alike = std::count_if(wall.begin(), wall.end(), [&](const float* other) {
    float sum = 0;
    for (int k = 0; k < 3; ++k) sum += (rgb[k] - other[k]) * (rgb[k] - other[k]);
    return sum < 3 * kWallLikeness * kWallLikeness;
  });
  return static_cast<double>(alike) >= kWallShare * static_cast<double>(wall.size());
}

struct Region {
  std::vector<size_t> texels;
  bool at_edge = false;  // reaches the left, right or upper edge
  double area = 0;
};

// The connected region of `marked` around `start`; unmarks it.
Region TakeRegion(const TexelGrid& raster, std::span<const uint16_t> inside,
                  std::vector<uint8_t>& marked, size_t start) {
  Region region;
  region.texels = {start};
  marked[start] = 0;
  for (size_t k = 0; k < region.texels.size(); ++k) {
    const size_t i = region.texels[k];
    const int x = static_cast<int>(i % raster.width);
    const int y = static_cast<int>(i / raster.width);
    region.area += inside[i];
    const auto visit = [&](int nx, int ny, bool counts_as_edge) {
      const bool within = nx >= 0 && ny >= 0 && nx < raster.width && ny < raster.height;
      const size_t next = static_cast<size_t>(ny) * raster.width + nx;
      if (!within || inside[next] == 0) {
        region.at_edge |= counts_as_edge;
      } else if (marked[next]) {
        marked[next] = 0;
        region.texels.push_back(next);
      }
    };
    visit(x - 1, y, true);
    visit(x + 1, y, true);
    visit(x, y - 1, true);
    visit(x, y + 1, false);
  }
  return region;
}

// Takes the owners of `dropped` and of the sky next to them, a few texels on: close to the outline
// the cloud cannot tell. Then a rim, where sky and wall mix.
void GrowDropped(const TexelGrid& raster, std::span<const RasterPicture> pictures,
                 std::vector<size_t> dropped, std::vector<int>& owner) {
  const std::vector<int> painter = owner;
  const size_t width = raster.width;
  for (int step = 0; step <= kGrowth + kRim && !dropped.empty(); ++step) {
    std::vector<size_t> next;
    for (size_t i : dropped) owner[i] = -1;
    for (size_t i : dropped) {
      const auto visit = [&](bool exists, size_t j) {
        if (!exists || owner[j] < 0 || owner[j] != painter[i]) return;
        const std::vector<float>& rgb = pictures[painter[i]].rgb;
        const float change = Brightness(&rgb[3 * i]) - Brightness(&rgb[3 * j]);
        const bool same = CouldBeSky(&rgb[3 * j]) && std::abs(change) <= kGrowthContrast;
        if (same || step >= kGrowth) next.push_back(j);
      };
      visit(i % width > 0, i - 1);
      visit(i % width + 1 < width, i + 1);
      visit(i >= width, i - width);
      visit(i + width < raster.size(), i + width);
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    dropped.insert(dropped.end(), next.begin(), next.end());
  }
}

}  // namespace

std::vector<uint8_t> FindSkyward(const TexelGrid& raster, const Eigen::Vector3d& camera,
                                 const Eigen::Vector3d& up) {
  std::vector<uint8_t> skyward;
  skyward.reserve(raster.size());
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const Eigen::Vector3d way = raster.Center(x, y) - camera;
      skyward.push_back(way.dot(up) > -kClearFall * way.norm());
    }
  }
  return skyward;
}

void MarkSky(const TexelGrid& raster, const SkyClues& clues, const std::vector<float>& rgb,
             std::vector<Sight>& sight) {
  const std::vector<const float*> wall = SampleWall(clues.no_points, rgb, sight);
  if (wall.empty()) return;
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const size_t i = static_cast<size_t>(y) * raster.width + x;
      if (!clues.no_points[i] || !clues.skyward[i] || sight[i] == Sight::kNot) continue;
      if (LooksLikeSky(raster, rgb, x, y) && !LooksLikeWall(wall, &rgb[3 * i])) {
        sight[i] = Sight::kBeyond;
      }
    }
  }
}

void DropBackground(const TexelGrid& raster, std::span<const uint16_t> inside,
                    std::span<const RasterPicture> pictures, std::vector<int>& owner) {
  std::vector<uint8_t> marked(raster.size(), 0);
  double area = 0;
  for (size_t i = 0; i < marked.size(); ++i) {
    marked[i] = owner[i] >= 0 && pictures[owner[i]].sight[i] == Sight::kBeyond;
    area += inside[i];
  }
  std::vector<size_t> dropped;
  double dropped_area = 0;
  for (size_t i = 0; i < raster.size(); ++i) {
    if (!marked[i]) continue;
    const Region region = TakeRegion(raster, inside, marked, i);
    if (!region.at_edge) continue;
    dropped.insert(dropped.end(), region.texels.begin(), region.texels.end());
    dropped_area += region.area;
  }
  if (dropped_area > kMostDropped * area) return;
  GrowDropped(raster, pictures, dropped, owner);
}

}  // namespace stucco
