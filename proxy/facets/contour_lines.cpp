// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/contour_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "survey/geometry2d.h"

namespace stucco {
namespace {

struct ContourEdge {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
  double length = 0;
};

// Edges of the simplified contours, in plane coordinates. The contour runs through the centres of
// the border cells: edges are moved out by half a cell.
std::vector<ContourEdge> EdgesOf(const PlaneRaster& raster, const std::vector<Evidence>& evidence,
                                 double detail) {
  cv::Mat mask(raster.height, raster.width, CV_8U);
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const Evidence e = evidence[raster.Index(x, y)];
      mask.at<uint8_t>(y, x) = e == Evidence::kSeen || e == Evidence::kGap ? 255 : 0;
    }
  }
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  std::vector<ContourEdge> edges;
  for (const auto& contour : contours) {
    std::vector<cv::Point> simple;
    cv::approxPolyDP(contour, simple, std::max(1.0, detail / raster.cell), /*closed=*/true);
    for (size_t i = 0; i < simple.size() && simple.size() >= 2; ++i) {
      const cv::Point a = simple[i], b = simple[(i + 1) % simple.size()];
      const Eigen::Vector2d p = raster.Center(a.x, a.y), q = raster.Center(b.x, b.y);
      ContourEdge edge;
      edge.length = (q - p).norm();
      if (edge.length < 3 * detail) continue;
      edge.direction = (q - p) / edge.length;
      edge.middle = (p + q) / 2;
      // Outer contours and holes run opposite ways: the mask itself tells which side is out.
      const Eigen::Vector2d side(-edge.direction.y(), edge.direction.x());
      const int left = raster.IndexAt(edge.middle + 1.5 * raster.cell * side);
      const int right = raster.IndexAt(edge.middle - 1.5 * raster.cell * side);
      const auto covered = [&](int index) {
        return index >= 0 &&
               (evidence[index] == Evidence::kSeen || evidence[index] == Evidence::kGap);
      };
      if (covered(left) != covered(right)) {
        edge.middle += (covered(left) ? -0.5 : 0.5) * raster.cell * side;
      }
      edges.push_back(edge);
    }
  }
  return edges;
}

// The preferred direction near the edge's; nothing for a short edge that has none.
std::optional<Eigen::Vector2d> SnapDirection(const ContourEdge& edge,
                                             const std::vector<CutLine>& creases,
                                             const ContourOptions& options) {
  const bool is_short = edge.length < options.free_length;
  const double axis = std::sin((is_short ? 30 : options.axis_deg) * std::numbers::pi / 180);
  std::optional<Eigen::Vector2d> best;
  double best_sine = std::sin(options.crease_deg * std::numbers::pi / 180);
  for (const CutLine& line : creases) {
    if (is_short && !options.follow_creases) break;
    const double sine = std::abs(Cross(edge.direction, line.direction));
    if (sine >= best_sine) continue;
    best_sine = sine;
    best = line.direction;
  }
  // An axis is preferred to a crease that is about as near.
  const double limit = best ? std::min(axis, best_sine + axis / 2) : axis;
  if (std::abs(edge.direction.y()) < limit) return Eigen::Vector2d::UnitX();
  if (std::abs(edge.direction.x()) < limit) return Eigen::Vector2d::UnitY();
  if (!best && !is_short) best = edge.direction;
  return best;
}

bool Repeats(const CutLine& line, const CutLine& other, double length, double detail) {
  constexpr double kAlike = 0.09;  // sine of 5 degrees
  if (std::abs(Cross(line.direction, other.direction)) > kAlike) return false;
  const Eigen::Vector2d half = line.direction * (length / 2);
  const double a = std::abs(Cross(other.direction, line.point - half - other.point));
  const double b = std::abs(Cross(other.direction, line.point + half - other.point));
  return std::max(a, b) < detail;
}

}  // namespace

std::vector<CutLine> ContourLines(const PlaneRaster& raster, const std::vector<Evidence>& evidence,
                                  const std::vector<CutLine>& creases,
                                  const ContourOptions& options) {
  auto edges = EdgesOf(raster, evidence, options.detail);
  std::stable_sort(edges.begin(), edges.end(),
                   [](const ContourEdge& a, const ContourEdge& b) { return a.length > b.length; });
  std::vector<CutLine> lines;
  for (const ContourEdge& edge : edges) {
    if (static_cast<int>(lines.size()) >= options.most_lines) break;
    const auto direction = SnapDirection(edge, creases, options);
    if (!direction) continue;
    const CutLine line{
        .point = edge.middle, .direction = *direction, .free = *direction == edge.direction};
    const auto repeats_crease = [&](const CutLine& crease) {
      return crease.IsActiveAt(edge.middle) && Repeats(line, crease, edge.length, options.detail);
    };
    const auto repeats_line = [&](const CutLine& other) {
      return Repeats(line, other, edge.length, 0.7 * options.detail);
    };
    if (std::any_of(creases.begin(), creases.end(), repeats_crease) ||
        std::any_of(lines.begin(), lines.end(), repeats_line)) {
      continue;
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace stucco
