// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/raster.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stucco {
namespace {

void CountUp(uint8_t& value) {
  if (value < 255) ++value;
}

cv::Mat Disk(int radius) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

// Closing that does not lose what touches the border.
cv::Mat Closed(const cv::Mat& mask, int radius) {
  if (radius < 1) return mask.clone();
  cv::Mat padded;
  cv::copyMakeBorder(mask, padded, radius, radius, radius, radius, cv::BORDER_CONSTANT, 0);
  cv::morphologyEx(padded, padded, cv::MORPH_CLOSE, Disk(radius));
  return padded(cv::Rect(radius, radius, mask.cols, mask.rows)).clone();
}

// Removes components with fewer than `fewest` cells.
void DropIslands(cv::Mat& mask, double fewest) {
  cv::Mat labels, stats, centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centroids, 8, CV_32S);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label > 0 && label < count && stats.at<int>(label, cv::CC_STAT_AREA) < fewest) {
        mask.at<uint8_t>(y, x) = 0;
      }
    }
  }
}

// Cells that the mask encloses, those a flood from outside does not reach, in holes of at most
// `most` cells.
cv::Mat Enclosed(const cv::Mat& mask, double most) {
  cv::Mat padded;
  cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::floodFill(padded, {0, 0}, 255, nullptr, 0, 0, 4);
  cv::Mat inner = padded(cv::Rect(1, 1, mask.cols, mask.rows));
  cv::Mat holes = inner == 0;
  cv::Mat labels, stats, centroids;
  cv::connectedComponentsWithStats(holes, labels, stats, centroids, 4, CV_32S);
  for (int y = 0; y < holes.rows; ++y) {
    for (int x = 0; x < holes.cols; ++x) {
      const int label = labels.at<int>(y, x);
      if (label > 0 && stats.at<int>(label, cv::CC_STAT_AREA) > most) holes.at<uint8_t>(y, x) = 0;
    }
  }
  return holes;
}

}  // namespace

int PlaneRaster::IndexAt(const Eigen::Vector2d& point) const {
  const double x = std::floor((point.x() - origin.x()) / cell);
  const double y = std::floor((point.y() - origin.y()) / cell);
  if (!(x >= 0 && y >= 0 && x < width && y < height)) return -1;
  return static_cast<int>(y) * width + static_cast<int>(x);
}

PlaneRaster RasteriseHits(const Samples& samples, const Plane& plane, const PlaneFrame& frame,
                          double cell, double margin) {
  constexpr double kWidest = 1500;
  PlaneRaster raster;
  raster.frame = frame;
  Eigen::AlignedBox2d box;
  for (const int i : plane.points) box.extend(frame.ToPlane(samples.positions[i]));
  if (box.isEmpty()) return raster;
  raster.cell = std::max(cell, (box.sizes().maxCoeff() + 2 * margin) / kWidest);
  raster.origin = box.min().array() - margin;
  raster.width = static_cast<int>(std::ceil((box.sizes().x() + 2 * margin) / raster.cell)) + 1;
  raster.height = static_cast<int>(std::ceil((box.sizes().y() + 2 * margin) / raster.cell)) + 1;
  raster.hits.assign(static_cast<size_t>(raster.width) * raster.height, 0);
  raster.through = raster.hits;
  for (const int i : plane.points) {
    const int index = raster.IndexAt(frame.ToPlane(samples.positions[i]));
    if (index >= 0) CountUp(raster.hits[index]);
  }
  return raster;
}

void CountThroughRays(const Samples& samples, const std::vector<int>& support, const Plane& plane,
                      double behind, PlaneRaster& raster) {
  for (const int i : support) {
    const Eigen::Vector3d* eye = samples.EyeOf(i);
    if (eye == nullptr) continue;
    const double end = plane.DistanceTo(samples.positions[i]);
    if (end > -behind) continue;
    const double start = plane.DistanceTo(*eye);
    if (start < behind) continue;
    const Eigen::Vector3d crossing = *eye + start / (start - end) * (samples.positions[i] - *eye);
    const int index = raster.IndexAt(raster.frame.ToPlane(crossing));
    if (index >= 0) CountUp(raster.through[index]);
  }
}

std::vector<float> DistancesTo(const PlaneRaster& raster, const std::vector<char>& cells) {
  cv::Mat away(raster.height, raster.width, CV_8U);
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      away.at<uint8_t>(y, x) = cells[raster.Index(x, y)] != 0 ? 0 : 255;
    }
  }
  cv::Mat distance;
  cv::distanceTransform(away, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  std::vector<float> result(cells.size());
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      result[raster.Index(x, y)] = static_cast<float>(raster.cell) * distance.at<float>(y, x);
    }
  }
  return result;
}

std::vector<Evidence> Classify(const PlaneRaster& raster, double fill_gap, double min_area) {
  std::vector<Evidence> evidence(raster.hits.size(), Evidence::kUnknown);
  if (evidence.empty()) return evidence;
  cv::Mat seen(raster.height, raster.width, CV_8U), open(raster.height, raster.width, CV_8U);
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      seen.at<uint8_t>(y, x) = raster.IsSeen(raster.Index(x, y)) ? 255 : 0;
      open.at<uint8_t>(y, x) = raster.IsOpen(raster.Index(x, y)) ? 255 : 0;
    }
  }
  // Points and rays are samples: single cells between them say nothing.
  seen = Closed(seen, 1);
  open = Closed(open, 1);
  cv::morphologyEx(open, open, cv::MORPH_OPEN, Disk(1));
  const double cell_area = raster.cell * raster.cell;
  DropIslands(seen, 0.25 * min_area / cell_area);
  const int radius = static_cast<int>(std::lround(fill_gap / 2 / raster.cell));
  cv::Mat closed = Closed(seen, radius);
  DropIslands(closed, min_area / cell_area);
  // Windows and what they mirror are no openings; a passage reaches the ground, a court is larger.
  const cv::Mat window = Enclosed(closed & ~open, 16 * fill_gap * fill_gap / cell_area);
  const cv::Mat enclosed = Enclosed(closed, 1e18);
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      Evidence& e = evidence[raster.Index(x, y)];
      const bool inside = closed.at<uint8_t>(y, x) != 0;
      const bool in_window = window.at<uint8_t>(y, x) != 0;
      if (!in_window && open.at<uint8_t>(y, x) != 0) {
        e = Evidence::kOpen;
      } else if (!in_window && inside && seen.at<uint8_t>(y, x) != 0) {
        e = Evidence::kSeen;
      } else if (in_window || inside || enclosed.at<uint8_t>(y, x) != 0) {
        e = Evidence::kGap;
      }
    }
  }
  return evidence;
}

namespace {

// Distance in cells to the nearest seen cell in one direction; far when there is none.
constexpr int kFar = 1 << 20;

std::vector<int> CellsToSeen(const PlaneRaster& raster, const std::vector<Evidence>& evidence,
                             int dx, int dy) {
  std::vector<int> distance(evidence.size(), kFar);
  for (int j = 0; j < raster.height; ++j) {
    const int y = dy > 0 ? raster.height - 1 - j : j;
    for (int i = 0; i < raster.width; ++i) {
      const int x = dx > 0 ? raster.width - 1 - i : i;
      const size_t at = raster.Index(x, y);
      if (evidence[at] == Evidence::kSeen) {
        distance[at] = 0;
        continue;
      }
      const int nx = x + dx, ny = y + dy;
      if (nx < 0 || ny < 0 || nx >= raster.width || ny >= raster.height) continue;
      distance[at] = std::min(kFar, distance[raster.Index(nx, ny)] + 1);
    }
  }
  return distance;
}

}  // namespace

void FillBays(const PlaneRaster& raster, double reach, std::vector<Evidence>& evidence) {
  assert(evidence.size() == raster.hits.size());
  const int most = static_cast<int>(reach / raster.cell);
  const auto left = CellsToSeen(raster, evidence, -1, 0);
  const auto right = CellsToSeen(raster, evidence, 1, 0);
  const auto below = CellsToSeen(raster, evidence, 0, -1);
  const auto above = CellsToSeen(raster, evidence, 0, 1);
  for (size_t i = 0; i < evidence.size(); ++i) {
    if (evidence[i] != Evidence::kUnknown || above[i] >= kFar) continue;
    if (left[i] + right[i] <= most || above[i] + below[i] <= most) evidence[i] = Evidence::kGap;
  }
  // Where such gaps cross they enclose cells that no seen cell is in line with.
  cv::Mat wall(raster.height, raster.width, CV_8U);
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const Evidence e = evidence[raster.Index(x, y)];
      wall.at<uint8_t>(y, x) = e == Evidence::kSeen || e == Evidence::kGap ? 255 : 0;
    }
  }
  const cv::Mat enclosed = Enclosed(wall, double(most) * most);
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      if (enclosed.at<uint8_t>(y, x) != 0) evidence[raster.Index(x, y)] = Evidence::kGap;
    }
  }
}

}  // namespace stucco
