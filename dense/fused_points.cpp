// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/fused_points.h"

#include <span>

namespace stucco {
namespace {

// A point in the file; its views follow.
struct Record {
  double position[3];
  float normal[3];
  float spacing;
  uint8_t color[4];  // the last is not used
  uint32_t num_views;
};

}  // namespace

FusedPoint FusedPoints::at(size_t index) const {
  FusedPoint point = points_[index];
  const size_t begin = index == 0 ? 0 : views_end_[index - 1];
  point.point.views = std::span(views_).subspan(begin, views_end_[index] - begin);
  return point;
}

void FusedPoints::Add(const FusedPoint& point) {
  views_.insert(views_.end(), point.point.views.begin(), point.point.views.end());
  views_end_.push_back(views_.size());
  points_.push_back(point);
  points_.back().point.views = {};
}

void FusedPoints::Add(const FusedPoints& points) {
  for (size_t i = 0; i < points.size(); ++i) Add(points.at(i));
}

void FusedPointsFile::Add(const FusedPoint& added) {
  const CloudPoint& point = added.point;
  Record record{};
  for (int k = 0; k < 3; ++k) {
    record.position[k] = point.position[k];
    record.normal[k] = point.normal[k];
    record.color[k] = point.color[k];
  }
  record.spacing = added.spacing;
  record.num_views = static_cast<uint32_t>(point.views.size());
  file_.Write(record);
  file_.Write(point.views.data(), point.views.size_bytes());
  ++size_;
}

void FusedPointsFile::ForEach(const std::function<void(const FusedPoint&)>& visit) {
  std::vector<uint32_t> views;
  file_.Rewind();
  for (size_t i = 0; i < size_; ++i) {
    const auto record = file_.Read<Record>();
    views.resize(record.num_views);
    file_.Read(views.data(), views.size() * sizeof(uint32_t));
    FusedPoint read;
    read.point.position = {record.position[0], record.position[1], record.position[2]};
    read.point.normal = {record.normal[0], record.normal[1], record.normal[2]};
    read.point.color = {record.color[0], record.color[1], record.color[2]};
    read.point.views = views;
    read.spacing = record.spacing;
    visit(read);
  }
  file_.SeekEnd();
}

}  // namespace stucco
