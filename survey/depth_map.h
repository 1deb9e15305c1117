// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stucco {

// Depth along the optical axis, surface normal in the camera frame (towards the camera) and
// matching cost per pixel of an undistorted photo. Depth 0: none.
struct DepthMap {
  int width = 0;
  int height = 0;
  std::vector<float> depths;
  std::vector<std::array<int8_t, 3>> normals;  // times 127
  std::vector<uint8_t> costs;                  // 1 - NCC, times 127

  size_t Index(int x, int y) const { return static_cast<size_t>(y) * width + x; }
  Eigen::Vector3f Normal(size_t index) const;
};

DepthMap EmptyDepthMap(int width, int height);

// Depths that are known without matching: costs of 0, and no normals.
DepthMap ExactDepths(int width, int height, std::vector<float> depths);

// "SDM1", width, height as 32-bit integers, then depths, normals, costs: little endian, as in
// memory. Reading throws Error (kBadInput) on anything that does not fit.
std::string Serialize(const DepthMap& map);
DepthMap DeserializeDepthMap(std::string_view bytes);

}  // namespace stucco
