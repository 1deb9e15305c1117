// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/depth_map.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "survey/error.h"

namespace stucco {
namespace {

constexpr char kMagic[] = "SDM1";
constexpr size_t kHead = 12;
constexpr size_t kBytesPerPixel = sizeof(float) + 3 + 1;

}  // namespace

Eigen::Vector3f DepthMap::Normal(size_t index) const {
  const auto& n = normals[index];
  return Eigen::Vector3f(n[0], n[1], n[2]).normalized();
}

DepthMap EmptyDepthMap(int width, int height) {
  const size_t count = static_cast<size_t>(width) * height;
  return {width, height, std::vector<float>(count, 0), std::vector<std::array<int8_t, 3>>(count),
          std::vector<uint8_t>(count, 255)};
}

DepthMap ExactDepths(int width, int height, std::vector<float> depths) {
  DepthMap map = EmptyDepthMap(width, height);
  map.depths = std::move(depths);
  std::fill(map.costs.begin(), map.costs.end(), uint8_t{0});
  return map;
}

std::string Serialize(const DepthMap& map) {
  const size_t count = map.depths.size();
  std::string bytes(kHead + count * kBytesPerPixel, '\0');
  const int32_t size[2] = {map.width, map.height};
  char* out = bytes.data();
  std::copy_n(kMagic, 4, out);
  std::memcpy(out + 4, size, 8);
  out += kHead;
  std::memcpy(out, map.depths.data(), count * 4);
  std::memcpy(out + count * 4, map.normals.data(), count * 3);
  std::memcpy(out + count * 7, map.costs.data(), count);
  return bytes;
}

DepthMap DeserializeDepthMap(std::string_view bytes) {
  int32_t size[2] = {0, 0};
  if (bytes.size() >= kHead) std::memcpy(size, bytes.data() + 4, 8);
  const bool sane =
      bytes.size() >= kHead && std::memcmp(bytes.data(), kMagic, 4) == 0 && size[0] > 0 &&
      size[1] > 0 &&
      (bytes.size() - kHead) / kBytesPerPixel / size[0] == static_cast<size_t>(size[1]) &&
      (bytes.size() - kHead) == kBytesPerPixel * size[0] * size[1];
  if (!sane) throw Error(ErrorKind::kBadInput, "depth map: the file is damaged");
  DepthMap map = EmptyDepthMap(size[0], size[1]);
  const size_t count = map.depths.size();
  const char* in = bytes.data() + kHead;
  std::memcpy(map.depths.data(), in, count * 4);
  std::memcpy(map.normals.data(), in + count * 4, count * 3);
  std::memcpy(map.costs.data(), in + count * 7, count);
  return map;
}

}  // namespace stucco
