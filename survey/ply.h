// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include "survey/point_cloud.h"

namespace stucco {

namespace internal {
class OutputFile;
}

// One point of a cloud, for clouds too large to be held. What the file does not have is zero.
struct CloudPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  std::array<uint8_t, 3> color{};
  std::span<const uint32_t> views;  // as in PointCloud; valid during the visit only
};

// What a PLY file has, by its header.
struct PlyLayout {
  uint64_t points = 0;
  bool normals = false;
  bool colors = false;
  bool views = false;
};

// Reads the header alone, and checks that the file is long enough for what it promises.
PlyLayout ReadPlyLayout(const std::filesystem::path& path);

using PointVisit = std::function<void(const CloudPoint&)>;

// Visits the points in the order of the file with about a megabyte of memory, whatever the file's
// size. Takes and refuses the same files as ReadPly (point_cloud.h), but damage far into the file
// is only found after the points before it were visited.
void ForEachPoint(const std::filesystem::path& path, const PointVisit& visit);

// Where a point of a file begins.
struct PlyPlace {
  uint64_t point = 0;  // how many come before it
  uint64_t byte = 0;   // known where points were read up to it
};

// The same for up to `count` points from a place on: that of the first one, or one that another
// such call returned. Returns the place behind them.
PlyPlace ForSomePoints(const std::filesystem::path& path, const PlyPlace& from, uint64_t count,
                       const PointVisit& visit);

// Writes a cloud point by point, as WritePly does (point_cloud.h). The layout promises how many
// points come and what they have; no point may have more than `most_views` views.
class PlyWriter {
 public:
  PlyWriter(const std::filesystem::path& path, const PlyLayout& layout, size_t most_views);
  ~PlyWriter();
  PlyWriter(const PlyWriter&) = delete;
  PlyWriter& operator=(const PlyWriter&) = delete;

  void Add(const CloudPoint& point);
  void Close();  // after as many points as were promised

 private:
  PlyLayout layout_;
  bool wide_views_ = false;
  std::unique_ptr<internal::OutputFile> file_;
  std::string buffer_;
  uint64_t written_ = 0;
};

}  // namespace stucco
