// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "dense/scratch_file.h"
#include "survey/ply.h"

namespace stucco {

// A point of the cloud before outliers are looked for.
struct FusedPoint {
  CloudPoint point;
  float spacing = 0;  // of pixels on the surface there, in the photo that sees it closest
};

// Points whose lists of views lie in one piece of memory.
class FusedPoints {
 public:
  size_t size() const { return points_.size(); }
  FusedPoint at(size_t index) const;  // its views are valid until the next call of Add
  void Add(const FusedPoint& point);
  void Add(const FusedPoints& points);

 private:
  std::vector<FusedPoint> points_;  // their views are empty
  std::vector<size_t> views_end_;   // by point, in views_
  std::vector<uint32_t> views_;
};

// Points on disk while the stage runs.
class FusedPointsFile {
 public:
  explicit FusedPointsFile(const std::filesystem::path& folder) : file_(folder) {}

  void Add(const FusedPoint& added);
  size_t size() const { return size_; }
  // In the order in which they were added.
  void ForEach(const std::function<void(const FusedPoint&)>& visit);

 private:
  ScratchFile file_;
  size_t size_ = 0;
};

}  // namespace stucco
