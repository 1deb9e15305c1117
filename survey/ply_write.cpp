// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <string>

#include "survey/error.h"
#include "survey/internal/bytes.h"
#include "survey/internal/output_file.h"
#include "survey/ply.h"
#include "survey/point_cloud.h"

namespace stucco {
namespace {

constexpr size_t kFlushBytes = size_t{1} << 20;
constexpr size_t kMostNarrowViews = 255;

std::string HeaderText(const PlyLayout& layout, bool wide_views) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n",
      layout.points);
  if (layout.normals) header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (layout.colors) header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (layout.views) {
    header += fmt::format("property list {} uint view_indices\n", wide_views ? "uint" : "uchar");
  }
  return header + "end_header\n";
}

}  // namespace

PlyWriter::PlyWriter(const std::filesystem::path& path, const PlyLayout& layout, size_t most_views)
    : layout_(layout),
      wide_views_(most_views > kMostNarrowViews),
      file_(std::make_unique<internal::OutputFile>(path)),
      buffer_(HeaderText(layout, wide_views_)) {}

PlyWriter::~PlyWriter() = default;

void PlyWriter::Add(const CloudPoint& point) {
  assert(wide_views_ || point.views.size() <= kMostNarrowViews);
  for (const double number : point.position) internal::AppendLittleEndian(buffer_, number);
  if (layout_.normals) {
    for (const float number : point.normal) internal::AppendLittleEndian(buffer_, number);
  }
  if (layout_.colors) {
    for (const uint8_t byte : point.color) internal::AppendLittleEndian(buffer_, byte);
  }
  if (layout_.views) {
    const auto length = static_cast<uint32_t>(point.views.size());
    if (wide_views_) {
      internal::AppendLittleEndian(buffer_, length);
    } else {
      internal::AppendLittleEndian(buffer_, static_cast<uint8_t>(length));
    }
    for (const uint32_t view : point.views) internal::AppendLittleEndian(buffer_, view);
  }
  ++written_;
  if (buffer_.size() < kFlushBytes) return;
  file_->Write(buffer_);
  buffer_.clear();
}

void PlyWriter::Close() {
  assert(written_ == layout_.points);
  file_->Write(buffer_);
  file_->Close();
}

void WritePly(const PointCloud& cloud, const std::filesystem::path& path) {
  if (const auto problem = FindProblem(cloud)) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("{}: cannot be written: {}", path.string(), *problem));
  }
  size_t most_views = 0;
  for (const auto& views : cloud.views) most_views = std::max(most_views, views.size());
  PlyWriter writer(path,
                   {.points = cloud.size(),
                    .normals = !cloud.normals.empty(),
                    .colors = !cloud.colors.empty(),
                    .views = !cloud.views.empty()},
                   most_views);
  CloudPoint point;
  for (size_t i = 0; i < cloud.size(); ++i) {
    point.position = cloud.positions[i];
    if (!cloud.normals.empty()) point.normal = cloud.normals[i];
    if (!cloud.colors.empty()) point.color = cloud.colors[i];
    if (!cloud.views.empty()) point.views = cloud.views[i];
    writer.Add(point);
  }
  writer.Close();
}

}  // namespace stucco
