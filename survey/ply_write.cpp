// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "survey/error.h"
#include "survey/internal/bytes.h"
#include "survey/internal/output_file.h"
#include "survey/point_cloud.h"

namespace stucco {
namespace {

std::string HeaderText(const PointCloud& cloud, bool wide_views) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n",
      cloud.size());
  if (!cloud.normals.empty()) {
    header += "property float nx\nproperty float ny\nproperty float nz\n";
  }
  if (!cloud.colors.empty()) {
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  }
  if (!cloud.views.empty()) {
    header += fmt::format("property list {} uint view_indices\n", wide_views ? "uint" : "uchar");
  }
  return header + "end_header\n";
}

void AppendPoint(const PointCloud& cloud, size_t i, bool wide_views, std::string& out) {
  for (const double number : cloud.positions[i]) internal::AppendLittleEndian(out, number);
  if (!cloud.normals.empty()) {
    for (const float number : cloud.normals[i]) internal::AppendLittleEndian(out, number);
  }
  if (!cloud.colors.empty()) {
    for (const uint8_t byte : cloud.colors[i]) internal::AppendLittleEndian(out, byte);
  }
  if (cloud.views.empty()) return;
  const auto length = static_cast<uint32_t>(cloud.views[i].size());
  if (wide_views) {
    internal::AppendLittleEndian(out, length);
  } else {
    internal::AppendLittleEndian(out, static_cast<uint8_t>(length));
  }
  for (const uint32_t view : cloud.views[i]) internal::AppendLittleEndian(out, view);
}

}  // namespace

void WritePly(const PointCloud& cloud, const std::filesystem::path& path) {
  if (const auto problem = FindProblem(cloud)) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("{}: cannot be written: {}", path.string(), *problem));
  }
  constexpr size_t kFlushBytes = size_t{1} << 20;
  const bool wide_views =
      std::ranges::any_of(cloud.views, [](const auto& views) { return views.size() > 255; });
  internal::OutputFile file(path);
  std::string buffer = HeaderText(cloud, wide_views);
  for (size_t i = 0; i < cloud.size(); ++i) {
    AppendPoint(cloud, i, wide_views, buffer);
    if (buffer.size() < kFlushBytes) continue;
    file.Write(buffer);
    buffer.clear();
  }
  file.Write(buffer);
  file.Close();
}

}  // namespace stucco
