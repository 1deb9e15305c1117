// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/internal/sweep.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "survey/geometry2d.h"

namespace stucco::internal {
namespace {

using Eigen::Vector2d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_2 ToCgal(const Vector2d& p) {
  return {p.x(), p.y()};
}

// +1: p, q, r turn left; -1: right; 0: on one line. Exact.
int Orientation(const Vector2d& p, const Vector2d& q, const Vector2d& r) {
  return CGAL::orientation(ToCgal(p), ToCgal(q), ToCgal(r));
}

// Quarter turns from the direction of -x, which comes first when seen from below.
int Half(const Vector2d& d) {
  if (d.y() < 0) return 0;
  if (d.y() > 0) return 2;
  return d.x() > 0 ? 1 : 3;
}

// Order of directions from p, counter-clockwise from -x. Exact.
bool ComesBefore(const Vector2d& p, const Vector2d& u, const Vector2d& v) {
  const int half_u = Half(u - p), half_v = Half(v - p);
  if (half_u != half_v) return half_u < half_v;
  return Orientation(p, u, v) > 0;
}

// Facing walls run clockwise about p: the sweep meets b first.
struct Event {
  Vector2d at;
  int wall = 0;
  bool begins = false;
  double angle = 0;  // about right; decides where it can
};

constexpr double kAngleSlack = 1e-9;  // far above the error of atan2

class Sweeper {
 public:
  Sweeper(std::span<const MapWall> walls, const Vector2d& p)
      : walls_(walls), p_(p), active_(Nearer{walls, p}), place_(walls.size(), active_.end()) {}

  std::vector<SeenPiece> Run() {
    std::vector<Event> events = SortedEvents();
    for (size_t i = 0; i < walls_.size(); ++i) {
      // The wall crosses the first direction when its end comes before its beginning.
      if (ComesBefore(p_, walls_[i].a, walls_[i].b)) Insert(static_cast<int>(i));
    }
    Open(p_ - Vector2d::UnitX());
    for (size_t i = 0; i < events.size();) {
      size_t end = i;
      const int before = Front();
      for (; end < events.size() && !Before(events[i], events[end]); ++end) {
        if (!events[end].begins) Erase(events[end].wall);
      }
      for (size_t k = i; k < end; ++k) {
        if (events[k].begins) Insert(events[k].wall);
      }
      if (Front() != before) {
        Close(before, events[i].at);
        Open(events[i].at);
      }
      i = end;
    }
    Close(Front(), p_ - Vector2d::UnitX());
    return std::move(pieces_);
  }

 private:
  // Of two walls that a ray from p meets, which it meets first.
  struct Nearer {
    std::span<const MapWall> walls;
    Vector2d p;
    bool operator()(int i, int j) const {
      if (i == j) return false;
      const MapWall &s = walls[i], &t = walls[j];
      // All of t behind the line of s, or all of s in front of the line of t.
      const int ta = Orientation(s.a, s.b, t.a), tb = Orientation(s.a, s.b, t.b);
      if (ta == 0 && tb == 0) return i < j;  // on one line: never under the same ray but by an end
      if (ta >= 0 && tb >= 0) return true;
      if (ta <= 0 && tb <= 0) return false;
      const int sa = Orientation(t.a, t.b, s.a), sb = Orientation(t.a, t.b, s.b);
      return sa <= 0 && sb <= 0;
    }
  };
  // Walls that cross after all, by less than a map can say, leave no order: with equal ones
  // allowed, every wall keeps a place of its own.
  using Active = std::multiset<int, Nearer>;

  bool Before(const Event& a, const Event& b) const {
    if (a.angle < b.angle - kAngleSlack) return true;
    if (a.angle > b.angle + kAngleSlack) return false;
    return ComesBefore(p_, a.at, b.at);
  }

  std::vector<Event> SortedEvents() const {
    std::vector<Event> events;
    events.reserve(2 * walls_.size());
    const auto add = [&](const Vector2d& at, size_t wall, bool begins) {
      const Vector2d d = at - p_;
      // -pi only for directions below -x; -x itself is +pi, as in ComesBefore.
      const double angle =
          d.y() == 0 ? (d.x() > 0 ? 0 : std::numbers::pi) : std::atan2(d.y(), d.x());
      events.push_back({at, static_cast<int>(wall), begins, angle});
    };
    for (size_t i = 0; i < walls_.size(); ++i) {
      add(walls_[i].b, i, true);
      add(walls_[i].a, i, false);
    }
    std::sort(events.begin(), events.end(),
              [this](const Event& a, const Event& b) { return Before(a, b); });
    return events;
  }

  int Front() const { return active_.empty() ? -1 : *active_.begin(); }
  void Insert(int wall) {
    if (place_[wall] == active_.end()) place_[wall] = active_.insert(wall);
  }
  void Erase(int wall) {
    if (place_[wall] == active_.end()) return;
    active_.erase(place_[wall]);
    place_[wall] = active_.end();
  }

  // Where the ray from p through `at` meets the line of the wall, in metres from a.
  double MeetingPoint(const MapWall& wall, const Vector2d& at) const {
    const double length = (wall.b - wall.a).norm();
    if (at == wall.a) return 0;
    if (at == wall.b) return length;
    const Vector2d along = wall.b - wall.a, ray = at - p_, to_a = wall.a - p_;
    const double turn = Cross(ray, along);
    const double t = Cross(to_a, ray) / turn;
    return std::clamp(t, 0.0, 1.0) * length;  // clamp takes care of a turn of 0 but not of NaN
  }

  void Open(const Vector2d& at) {
    if (Front() >= 0) opened_m_ = MeetingPoint(walls_[Front()], at);
  }
  void Close(int wall, const Vector2d& at) {
    if (wall < 0) return;
    // The sweep runs from b to a.
    const double closed_m = MeetingPoint(walls_[wall], at);
    if (closed_m < opened_m_) pieces_.push_back({wall, {closed_m, opened_m_}});
  }

  std::span<const MapWall> walls_;
  Vector2d p_;
  Active active_;
  std::vector<Active::iterator> place_;
  std::vector<SeenPiece> pieces_;
  double opened_m_ = 0;
};

}  // namespace

bool IsInFrontOf(const MapWall& wall, const Vector2d& p) {
  return Orientation(wall.a, wall.b, p) < 0;
}

std::vector<SeenPiece> Sweep(std::span<const MapWall> walls, const Vector2d& p) {
  return Sweeper(walls, p).Run();
}

}  // namespace stucco::internal
