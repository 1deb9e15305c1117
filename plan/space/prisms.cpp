// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/space/prisms.h"

#include <limits>

#include "plan/space/part_near.h"

namespace stucco::plan {

using Eigen::Vector2d;
using Eigen::Vector3d;

void Prisms::Add(const Polygon& outline, double top_m) {
  Prism prism;
  prism.top_m = top_m;
  std::vector<Box2> boxes;
  for (const Ring& ring : outline.rings) {
    for (size_t k = 0; k < ring.size(); ++k) {
      const Segment2d edge{ring[k], ring[(k + 1) % ring.size()]};
      prism.edges.push_back(edge);
      boxes.emplace_back();
      boxes.back().Add(edge.a);
      boxes.back().Add(edge.b);
    }
  }
  if (prism.edges.empty()) return;
  prism.tree = BoxTree(boxes);
  prisms_.push_back(std::move(prism));
}

void Prisms::Index() {
  std::vector<Box2> boxes;
  for (const Prism& prism : prisms_) boxes.push_back(prism.tree.box());
  tree_ = BoxTree(boxes);
}

// Crossings of a ray to the east, by even and odd over all rings: as Contains of
// survey/geometry2d.h, which goes through every edge. Outlines of towns have thousands, and the
// tree finds those few that the ray can meet.
bool Prisms::Prism::Contains(const Vector2d& position) const {
  if (!tree.box().Contains(position)) return false;
  bool inside = false;
  tree.Any(
      [&](const Box2& box) {
        return position.y() >= box.min.y() && position.y() <= box.max.y() &&
               position.x() <= box.max.x();
      },
      [&](int k) {
        const Segment2d& e = edges[k];
        if ((e.a.y() > position.y()) == (e.b.y() > position.y())) return false;
        const double side = Cross(e.b - e.a, position - e.a);
        if ((e.b.y() > e.a.y()) == (side > 0)) inside = !inside;
        return false;
      });
  return inside;
}

bool Prisms::Prism::IsNear(const Segment2d& segment, double radius) const {
  const double squared = radius * radius;
  return tree.Any([&](const Box2& box) { return box.MayTouch(segment, radius); },
                  [&](int k) { return SquaredDistance(segment, edges[k]) < squared; }) ||
         Contains(segment.a);
}

bool Prisms::Touches(const Vector3d& p, const Vector3d& q, double radius) const {
  const Segment2d whole{p.head<2>(), q.head<2>()};
  return tree_.Any([&](const Box2& box) { return box.MayTouch(whole, radius); },
                   [&](int k) {
                     const Prism& prism = prisms_[k];
                     const double top = prism.top_m;
                     if (p.z() >= top && q.z() >= top) return false;
                     Segment2d below = whole;
                     if (p.z() >= top || q.z() >= top) {
                       const double t = (top - p.z()) / (q.z() - p.z());
                       (p.z() >= top ? below.a : below.b) = whole.a + t * (whole.b - whole.a);
                     }
                     return prism.tree.box().MayTouch(below, radius) && prism.IsNear(below, radius);
                   });
}

double Prisms::Distance(const Vector2d& position, double z) const {
  double squared = std::numeric_limits<double>::infinity();
  const auto nearer = [&](const Box2& box) { return box.SquaredDistance(position) < squared; };
  tree_.Any(nearer, [&](int k) {
    const Prism& prism = prisms_[k];
    if (!(prism.top_m > z) || !nearer(prism.tree.box())) return false;
    if (prism.Contains(position)) {
      squared = 0;
      return true;
    }
    prism.tree.Any(nearer, [&](int e) {
      squared = std::min(squared, SquaredDistance(prism.edges[e], position));
      return false;
    });
    return false;
  });
  return std::sqrt(squared);
}

double Prisms::TopWithin(const Vector2d& position, double radius) const {
  double top = -std::numeric_limits<double>::infinity();
  const Segment2d point{position, position};
  tree_.Any([&](const Box2& box) { return box.MayTouch(point, radius); },
            [&](int k) {
              const Prism& prism = prisms_[k];
              if (prism.top_m > top && prism.IsNear(point, radius)) top = prism.top_m;
              return false;
            });
  return top;
}

void Prisms::FindCrossings(const Segment2d& segment, double above_m, double radius,
                           std::vector<Crossing>& crossings) const {
  tree_.Any([&](const Box2& box) { return box.MayTouch(segment, radius); },
            [&](int k) {
              const Prism& prism = prisms_[k];
              if (!(prism.top_m > above_m)) return false;
              Interval part{2, -1};
              prism.tree.Any([&](const Box2& box) { return box.MayTouch(segment, radius); },
                             [&](int e) {
                               if (const auto near = PartNear(segment, prism.edges[e], radius)) {
                                 part.from_m = std::min(part.from_m, near->from_m);
                                 part.to_m = std::max(part.to_m, near->to_m);
                               }
                               return false;
                             });
              if (prism.Contains(segment.a)) part.from_m = 0;
              if (prism.Contains(segment.b)) part.to_m = 1;
              if (part.from_m <= 1) {
                crossings.push_back({{part.from_m, std::max(part.from_m, part.to_m)}, prism.top_m});
              }
              return false;
            });
}

}  // namespace stucco::plan
