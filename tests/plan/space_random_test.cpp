// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Safety of paths on random maps, checked with exact arithmetic and with none of the code that
// plans them: of plan/space only the answers are used.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "plan/space/safe_space.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Exact = Kernel::FT;
using ExactPoint = Kernel::Point_2;
using ExactSegment = Kernel::Segment_2;
using Random = std::mt19937_64;

double Uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

int Pick(Random& random, int count) {
  return std::uniform_int_distribution<int>(0, count - 1)(random);
}

Ring Box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

// Rectangle, L, U, courtyard, sliver or two that touch, of about `size` metres, around (0, 0).
std::vector<Polygon> RandomShape(Random& random, double size) {
  const double w = size * Uniform(random, 0.5, 1);
  const double h = size * Uniform(random, 0.5, 1);
  const double a = w * Uniform(random, 0.2, 0.8);
  const double b = h * Uniform(random, 0.2, 0.8);
  switch (Pick(random, 6)) {
    case 0:
      return {{{Box(0, 0, w, h)}}};
    case 1:
      return {{{{{0, 0}, {w, 0}, {w, b}, {a, b}, {a, h}, {0, h}}}}};
    case 2:
      return {{{{{0, 0},
                 {w, 0},
                 {w, h},
                 {0.8 * w, h},
                 {0.8 * w, b},
                 {0.2 * w, b},
                 {0.2 * w, h},
                 {0, h}}}}};
    case 3: {
      const Ring hole = Box(0.1 * w, 0.1 * h, 0.9 * w, 0.9 * h);
      return {{{Box(0, 0, w, h), {hole.rbegin(), hole.rend()}}}};
    }
    case 4:
      return {{{{{0, 0}, {w, 0.01 * Uniform(random, 0, 1)}, {0.5 * w, 0.02}}}}};
    default:
      return {{{Box(0, 0, a, h)}}, {{Box(a, 0, w, b)}}};
  }
}

void Place(Polygon& polygon, double angle, const Vector2d& at) {
  for (Ring& ring : polygon.rings) {
    for (Vector2d& p : ring) {
      p = at + Vector2d(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                        std::sin(angle) * p.x() + std::cos(angle) * p.y());
    }
  }
}

// One to six buildings, overlapping at times, none to two no-fly polygons, any distance to keep.
Site RandomSite(Random& random) {
  Site site;
  site.d_min_m = Pick(random, 3) == 0 ? 10 : Uniform(random, 0.5, 15);
  site.min_altitude_m = 3;
  site.safe_altitude_m = Uniform(random, 20, 80);
  const int shapes = 1 + Pick(random, 6);
  for (int k = 0; k < shapes; ++k) {
    const double angle = Pick(random, 2) == 0 ? 0 : Uniform(random, 0, 6.3);
    const Vector2d at(Uniform(random, -100, 100), Uniform(random, -100, 100));
    const double blocked =
        Pick(random, 2) == 0 ? site.safe_altitude_m : Uniform(random, 8, site.safe_altitude_m);
    for (Polygon& polygon : RandomShape(random, Uniform(random, 8, 120))) {
      if (site.footprints.size() == 6) break;
      Place(polygon, angle, at);
      site.footprints.push_back({});
      site.footprints.back().outline = std::move(polygon);
      site.footprints.back().blocked_to_m = blocked;
    }
  }
  for (int k = Pick(random, 3); k > 0; --k) {
    Polygon polygon = RandomShape(random, Uniform(random, 5, 60)).front();
    Place(polygon, Uniform(random, 0, 6.3),
          {Uniform(random, -120, 120), Uniform(random, -120, 120)});
    site.no_fly.push_back(std::move(polygon));
  }
  return site;
}

ExactPoint ToExact(const Vector2d& p) {
  return {p.x(), p.y()};
}

bool IsInside(const Polygon& polygon, const ExactPoint& p) {
  bool inside = false;
  for (const Ring& ring : polygon.rings) {
    std::vector<ExactPoint> points;
    CGAL::Bbox_2 around;
    for (const Vector2d& corner : ring) {
      points.push_back(ToExact(corner));
      around += points.back().bbox();
    }
    if (!CGAL::do_overlap(p.bbox(), around)) continue;
    const auto side = CGAL::bounded_side_2(points.begin(), points.end(), p, Kernel());
    if (side == CGAL::ON_BOUNDARY) return true;
    inside = inside != (side == CGAL::ON_BOUNDED_SIDE);
  }
  return inside;
}

// Whether what two boxes enclose lies farther apart by more than rounding could be wrong: most
// does, and needs no exact arithmetic.
bool AreFarther(const CGAL::Bbox_2& a, const CGAL::Bbox_2& b, const Exact& squared_distance) {
  const double x = std::max({0.0, a.xmin() - b.xmax(), b.xmin() - a.xmax()});
  const double y = std::max({0.0, a.ymin() - b.ymax(), b.ymin() - a.ymax()});
  return x * x + y * y > CGAL::to_double(squared_distance) + 1e-3;
}

// Whether the straight line from p to q (one point, if they are equal) keeps off the polygon.
bool KeepsOff(const Polygon& polygon, const ExactPoint& p, const ExactPoint& q,
              const Exact& squared_distance) {
  const CGAL::Bbox_2 way = p.bbox() + q.bbox();
  for (const Ring& ring : polygon.rings) {
    for (size_t k = 0; k < ring.size(); ++k) {
      const ExactPoint a = ToExact(ring[k]);
      const ExactPoint b = ToExact(ring[(k + 1) % ring.size()]);
      if (AreFarther(a.bbox() + b.bbox(), way, squared_distance)) continue;
      const ExactSegment edge(a, b);
      const Exact squared = p == q ? CGAL::squared_distance(p, edge)
                                   : CGAL::squared_distance(ExactSegment(p, q), edge);
      if (squared < squared_distance || squared == 0) return false;
    }
  }
  return !IsInside(polygon, p);
}

// The rule of the planner for a straight flight, to the last digit.
bool IsSafe(const Site& site, const Vector3d& p, const Vector3d& q) {
  if (p.z() < site.min_altitude_m || q.z() < site.min_altitude_m) return false;
  const ExactPoint a = ToExact(p.head<2>());
  const ExactPoint b = ToExact(q.head<2>());
  for (const Polygon& polygon : site.no_fly) {
    if (!KeepsOff(polygon, a, b, 0)) return false;
  }
  const Exact d_min(site.d_min_m);
  for (const Footprint& footprint : site.footprints) {
    const Exact top(footprint.blocked_to_m);
    const bool starts_above = p.z() >= footprint.blocked_to_m;
    const bool ends_above = q.z() >= footprint.blocked_to_m;
    if (starts_above && ends_above) continue;
    ExactPoint low = a;
    ExactPoint high = b;
    if (starts_above || ends_above) {
      const Exact t = (top - Exact(p.z())) / (Exact(q.z()) - Exact(p.z()));
      (starts_above ? low : high) = a + t * (b - a);
    }
    if (!KeepsOff(footprint.outline, low, high, d_min * d_min)) return false;
  }
  return true;
}

Vector3d RandomPosition(Random& random) {
  return {Uniform(random, -130, 130), Uniform(random, -130, 130), Uniform(random, 2, 90)};
}

TEST(SafeSpaceRandom, TenThousandMapsHaveOnlySafePaths) {
  constexpr uint64_t kMaps = 10000;
  int routes = 0;
  int bent = 0;
  int without = 0;
  for (uint64_t map = 0; map < kMaps; ++map) {
    Random random(map);
    const Site site = RandomSite(random);
    const Obstacles obstacles(site);
    const SafeSpace space(obstacles);
    Vector3d p;
    Vector3d q;
    for (int trial = 0; trial < 20; ++trial) {
      p = RandomPosition(random);
      q = RandomPosition(random);
      // Where the planner may be is safe, and what is unsafe is not free.
      ASSERT_TRUE(!obstacles.IsFree(p) || IsSafe(site, p, p)) << "map " << map;
      if (obstacles.IsFree(p) && obstacles.IsFree(q) && !IsSafe(site, p, q)) break;
    }
    if (!obstacles.IsFree(p) || !obstacles.IsFree(q)) continue;
    const auto route = space.ShortestRoute(p, q);
    if (!route) {
      ++without;
      continue;
    }
    ++routes;
    ASSERT_EQ(route->points.front(), p);
    ASSERT_EQ(route->points.back(), q);
    bent += route->points.size() > 2;
    for (size_t k = 1; k < route->points.size(); ++k) {
      ASSERT_TRUE(IsSafe(site, route->points[k - 1], route->points[k]))
          << "map " << map << ", segment " << k;
    }
  }
  RecordProperty("routes", routes);
  EXPECT_GT(routes, 9000);
  EXPECT_GT(bent, 5000);
  EXPECT_LT(without, 200);  // no way is left in a courtyard of a no-fly polygon only
}

// What the check itself is worth: paths a little nearer than allowed do not pass.
TEST(SafeSpaceRandom, TheCheckSeesAMillimetre) {
  Site site;
  site.d_min_m = 10;
  site.footprints.push_back({});
  site.footprints.back().outline.rings = {Box(0, 0, 10, 10)};
  site.footprints.back().blocked_to_m = 30;
  EXPECT_TRUE(IsSafe(site, {-10, -20, 10}, {-10, 40, 10}));
  EXPECT_FALSE(IsSafe(site, {-9.999, -20, 10}, {-9.999, 40, 10}));
  EXPECT_TRUE(IsSafe(site, {5, 5, 30}, {-20, 5, 30}));
  EXPECT_FALSE(IsSafe(site, {5, 5, 30}, {-20, 5, 29.999}));
  EXPECT_FALSE(IsSafe(site, {5, 5, 20}, {5, 5, 20}));
}

// --- Lengths, against a visibility graph of all corners by brute force. ---

double Distance(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + t * (b - a) - p).norm();
}

bool IsLeft(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  return (b - a).x() * (p - a).y() - (b - a).y() * (p - a).x() > 0;
}

bool KeepsOff(const Site& site, const Vector2d& p, const Vector2d& q, double distance) {
  for (const Footprint& footprint : site.footprints) {
    const Ring& ring = footprint.outline.rings.front();
    bool inside = false;
    for (size_t k = 0; k < ring.size(); ++k) {
      const Vector2d& a = ring[k];
      const Vector2d& b = ring[(k + 1) % ring.size()];
      if (IsLeft(a, b, p) != IsLeft(a, b, q) && IsLeft(p, q, a) != IsLeft(p, q, b)) return false;
      if (std::min({Distance(p, a, b), Distance(q, a, b), Distance(a, p, q), Distance(b, p, q)}) <
          distance) {
        return false;
      }
      if ((a.y() > p.y()) != (b.y() > p.y()) && (b.y() > a.y()) == IsLeft(a, b, p)) {
        inside = !inside;
      }
    }
    if (inside) return false;
  }
  return true;
}

// Dijkstra over all pairs of points on circles of `radius` around the corners that see each other
// at `distance` from everything.
double BruteForce(const Site& site, std::vector<Vector2d> points, double radius, double distance) {
  constexpr int kSides = 48;
  for (const Footprint& footprint : site.footprints) {
    for (const Vector2d& corner : footprint.outline.rings.front()) {
      for (int k = 0; k < kSides; ++k) {
        const double angle = 2 * std::numbers::pi * k / kSides;
        const Vector2d p = corner + radius * Vector2d(std::cos(angle), std::sin(angle));
        if (KeepsOff(site, p, p + Vector2d(1e-9, 0), distance)) points.push_back(p);
      }
    }
  }
  std::vector<double> length(points.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(points.size());
  length[0] = 0;
  while (true) {
    int best = -1;
    for (size_t k = 0; k < points.size(); ++k) {
      if (!done[k] && (best < 0 || length[k] < length[best])) best = static_cast<int>(k);
    }
    if (best < 0 || best == 1 || std::isinf(length[best])) return length[1];
    done[best] = true;
    for (size_t k = 0; k < points.size(); ++k) {
      const double through = length[best] + (points[k] - points[best]).norm();
      if (!done[k] && through < length[k] && KeepsOff(site, points[best], points[k], distance)) {
        length[k] = through;
      }
    }
  }
}

TEST(SafeSpaceRandom, LengthsAreThoseOfBruteForce) {
  int compared = 0;
  double largest_excess = 0;
  for (uint64_t map = 0; map < 60; ++map) {
    Random random(1000000 + map);
    Site site;
    site.d_min_m = 10;
    site.safe_altitude_m = 5000;  // nobody climbs
    for (int k = 0; k < 4; ++k) {
      site.footprints.push_back({});
      Footprint& footprint = site.footprints.back();
      const double w = Uniform(random, 5, 40);
      const double h = Uniform(random, 5, 40);
      footprint.outline.rings = {Pick(random, 2) == 0
                                     ? Box(0, 0, w, h)
                                     : Ring{{0, 0}, {w, 0}, {w, 3}, {3, 3}, {3, h}, {0, h}}};
      footprint.blocked_to_m = 5000;
      Place(footprint.outline, Uniform(random, 0, 6.3),
            {Uniform(random, -50, 50), Uniform(random, -50, 50)});
    }
    const Vector3d p(-90, Uniform(random, -90, 90), 10);
    const Vector3d q(90, Uniform(random, -90, 90), 10);
    const Obstacles obstacles(site);
    const auto route = SafeSpace(obstacles).ShortestRoute(p, q);
    const std::vector<Vector2d> ends{p.head<2>(), q.head<2>()};
    // Points on the true circles that may cut the arcs between them: no path is shorter. Points
    // outside them that see each other past the true circles: a path, if not the shortest.
    const double cut = std::cos(std::numbers::pi / 48);
    const double shortest = BruteForce(site, ends, 10, 10 * cut - 1e-9);
    const double possible = BruteForce(site, ends, 10.001 / cut + 1e-9, 10.001);
    ASSERT_EQ(route.has_value(), std::isfinite(possible)) << "map " << map;
    if (!route) continue;
    compared += route->points.size() > 2;
    EXPECT_GE(route->length_m, shortest - 1e-6) << "map " << map;
    EXPECT_LE(route->length_m, 1.006 * possible) << "map " << map;
    largest_excess = std::max(largest_excess, route->length_m / shortest - 1);
  }
  EXPECT_GT(compared, 40);
  EXPECT_LT(largest_excess, 0.006);
  RecordProperty("largest_excess", std::to_string(largest_excess));
}

}  // namespace
}  // namespace stucco::plan
