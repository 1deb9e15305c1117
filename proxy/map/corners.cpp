// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/corners.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "proxy/map/outlines.h"

namespace stucco {
namespace {

// Where the line of `before`, run on, meets that of `after`, run back; both keep their direction.
std::optional<Eigen::Vector2d> CornerOf(const Segment2d& before, const Segment2d& after) {
  constexpr double kParallel = 0.2;  // sine
  const Eigen::Vector2d along = (before.b - before.a).normalized();
  const Eigen::Vector2d onwards = (after.b - after.a).normalized();
  const double turn = Cross(along, onwards);
  if (!(std::abs(turn) > kParallel)) return std::nullopt;
  const Eigen::Vector2d corner = before.a + along * (Cross(after.a - before.a, onwards) / turn);
  if (along.dot(corner - before.a) <= 0 || onwards.dot(after.b - corner) <= 0) return std::nullopt;
  return corner;
}

double OffLine(const Segment2d& line, const Eigen::Vector2d& p) {
  return std::abs(Cross((line.b - line.a).normalized(), p - line.a));
}

// Whether `after` goes on along the line of `before`.
bool IsOneLine(const Segment2d& before, const Segment2d& after) {
  constexpr double kOnIt_m = 0.01;
  return OffLine(before, after.a) < kOnIt_m && OffLine(before, after.b) < kOnIt_m &&
         (before.b - before.a).dot(after.b - after.a) > 0 &&
         (before.b - before.a).dot(after.a - before.b) > 0;
}

// What stands for the corners of steps between two held edges: one corner, or none where these are
// of one line; nothing where the steps are no such ones.
std::optional<Ring> InPlaceOf(const Ring& steps, const Segment2d& before, const Segment2d& after,
                              double reach, double depth) {
  const bool shallow = std::ranges::all_of(steps, [&](const Eigen::Vector2d& p) {
    return std::min(OffLine(before, p), OffLine(after, p)) < depth;
  });
  if (!shallow) return std::nullopt;
  if (IsOneLine(before, after)) {
    if (!((steps.back() - steps.front()).norm() < reach)) return std::nullopt;
    return Ring{};
  }
  const auto corner = CornerOf(before, after);
  const bool near = corner && std::ranges::all_of(steps, [&](const Eigen::Vector2d& p) {
                      return (p - *corner).norm() < reach;
                    });
  if (!near) return std::nullopt;
  return Ring{*corner};
}

}  // namespace

Ring WithCorners(Ring ring, const IsHeld& is_held, double reach) {
  for (size_t i = 0; i < ring.size() && ring.size() > 3;) {
    const size_t count = ring.size();
    const auto edge = [&](size_t k) { return Segment2d{ring[k % count], ring[(k + 1) % count]}; };
    const Segment2d before = edge(i + count - 1), cut = edge(i), after = edge(i + 1);
    std::optional<Eigen::Vector2d> corner;
    if (!is_held(cut) && is_held(before) && is_held(after)) corner = CornerOf(before, after);
    if (corner && (*corner - cut.a).norm() < reach && (*corner - cut.b).norm() < reach) {
      ring[i] = *corner;
      ring.erase(ring.begin() + static_cast<ptrdiff_t>((i + 1) % count));
    } else {
      ++i;
    }
  }
  return ring;
}

Ring WithoutSteps(Ring ring, const IsHeld& is_held, double reach, double depth) {
  // Every edge is the first one once: what steps come after it, up to the next held edge?
  for (size_t turn = ring.size(); turn > 0; --turn) {
    size_t next = 1;
    while (next < ring.size() && !is_held(EdgeOf(ring, next))) ++next;
    if (next > 1 && next < ring.size() && is_held(EdgeOf(ring, 0))) {
      const auto begin = ring.begin() + 1, end = begin + static_cast<ptrdiff_t>(next);
      const auto instead =
          InPlaceOf({begin, end}, EdgeOf(ring, 0), EdgeOf(ring, next), reach, depth);
      if (instead && ring.size() - next + instead->size() >= 3) {
        ring.insert(ring.erase(begin, end), instead->begin(), instead->end());
      }
    }
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  }
  return ring;
}

}  // namespace stucco
