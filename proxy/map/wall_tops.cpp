// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wall_tops.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "survey/median.h"

namespace stucco {
namespace {

constexpr double kPiece_m = 1;
constexpr double kOutwards = 0.9;  // cosine of 25 degrees
// The top of a wall is where so many samples begin within so much height: strays are fewer.
constexpr size_t kOnTop = 8;
constexpr double kWithin_m = 2;
// Parapets, and walls that rise over a roof; roofs fall from walls at 55 degrees at most.
constexpr double kOverRoof_m = 3;
constexpr double kSteepest = 1.43;
constexpr size_t kFewestPieces = 5;

size_t PiecesOf(const Segment2d& line) {
  return std::max<size_t>(1, static_cast<size_t>(std::lround((line.b - line.a).norm() / kPiece_m)));
}

size_t PieceAt(const Segment2d& line, const Eigen::Vector2d& place, size_t pieces) {
  const Eigen::Vector2d along = line.b - line.a;
  const double share = along.dot(place - line.a) / std::max(along.squaredNorm(), 1e-12);
  const auto piece = static_cast<size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(pieces));
  return std::min(piece, pieces - 1);
}

std::optional<double> TopOfWall(std::vector<double> heights) {
  std::ranges::sort(heights, std::greater{});
  for (size_t i = 0; i + kOnTop <= heights.size(); ++i) {
    if (heights[i] - heights[i + kOnTop - 1] <= kWithin_m) return heights[i];
  }
  return std::nullopt;
}

}  // namespace

WallTops::WallTops(const FittedBuilding& building, const Samples& near, double reach) {
  for (const FittedEdge& edge : building.edges) {
    if (!edge.fitted || edge.party) continue;
    std::vector<std::vector<double>> heights(PiecesOf(edge.line));
    const Eigen::Vector2d outwards = OutwardsOf(edge.line);
    for (size_t i = 0; i < near.size(); ++i) {
      const Eigen::Vector2d place = near.positions[i].head<2>();
      if (!(outwards.dot(near.normals[i].head<2>()) > kOutwards)) continue;
      if (!(Distance(edge.line, place) < reach)) continue;
      heights[PieceAt(edge.line, place, heights.size())].push_back(near.positions[i].z());
    }
    const Eigen::Vector2d step = (edge.line.b - edge.line.a) / static_cast<double>(heights.size());
    for (size_t p = 0; p < heights.size(); ++p) {
      const std::optional<double> top = TopOfWall(std::move(heights[p]));
      const Eigen::Vector2d from = edge.line.a + static_cast<double>(p) * step;
      if (top) pieces_.push_back({.line = {from, from + step}, .top = *top});
    }
  }
}

bool WallTops::IsBelow(const Eigen::Vector3d& place) const {
  const Eigen::Vector2d at = place.head<2>();
  const auto beside = std::ranges::min_element(
      pieces_, {}, [&](const Piece& piece) { return SquaredDistance(piece.line, at); });
  if (beside == pieces_.end()) return false;
  return beside->top - place.z() > kOverRoof_m + kSteepest * Distance(beside->line, at);
}

std::optional<double> WallTops::Height() const {
  if (pieces_.size() < kFewestPieces) return std::nullopt;
  std::vector<double> tops;
  tops.reserve(pieces_.size());
  for (const Piece& piece : pieces_) tops.push_back(piece.top);
  return Median(std::move(tops));
}

}  // namespace stucco
