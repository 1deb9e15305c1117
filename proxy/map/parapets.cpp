// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/parapets.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "proxy/planes/consolidate.h"

namespace stucco {
namespace {

constexpr double kParapetHeight_m = 1.2;

// Share of a plane's samples within `width` of the outline.
double OnRim(const Plane& plane, const Samples& samples, const MapBuilding& building,
             double width) {
  const auto on_rim = std::ranges::count_if(plane.points, [&](int i) {
    return ToOutline(building, samples.positions[i].head<2>()) < width;
  });
  return static_cast<double>(on_rim) / static_cast<double>(plane.points.size());
}

// What of a plane lies away from the outline.
struct Inside {
  double samples = 0;
  double points = 0;  // of the cloud, that its samples stand for
  double Density() const { return points / std::max(1.0, samples); }
};

Inside InsideOf(const Plane& plane, const Samples& samples, const MapBuilding& building,
                double width) {
  Inside inside;
  for (const int i : plane.points) {
    if (ToOutline(building, samples.positions[i].head<2>()) < width) continue;
    inside.points += samples.weights[i];
    ++inside.samples;
  }
  return inside;
}

void DropLevelParapets(const Samples& samples, const MapBuilding& building, double width,
                       std::vector<Plane>& planes) {
  constexpr double kParallel = 0.999;  // cosine
  constexpr double kMost = 0.5;        // of its samples
  constexpr double kSparse = 0.5;      // of the roof's density
  std::vector<Inside> insides;
  insides.reserve(planes.size());
  for (const Plane& plane : planes) insides.push_back(InsideOf(plane, samples, building, width));
  std::vector<Plane> kept;
  for (size_t p = 0; p < planes.size(); ++p) {
    bool has_roof = false;
    for (size_t r = 0; r < planes.size(); ++r) {
      const double above = planes[p].offset - planes[r].offset;
      has_roof |= planes[p].normal.dot(planes[r].normal) > kParallel && above > 0 &&
                  above < kParapetHeight_m && insides[p].points < insides[r].points &&
                  insides[p].Density() < kSparse * insides[r].Density();
    }
    const bool parapet = has_roof && OnRim(planes[p], samples, building, width) > kMost;
    if (!parapet) kept.push_back(planes[p]);
  }
  planes = std::move(kept);
}

// Of some values: where a twentieth of them ends at either side.
struct Most {
  double low = 0;
  double high = 0;

  bool Holds(double value) const { return value >= low && value <= high; }
};

Most MostOf(std::vector<double> values) {
  const size_t cut = values.size() / 20;
  std::ranges::sort(values);
  return {values[cut], values[values.size() - 1 - cut]};
}

// A leaning plane and what lies around it.
class Strip {
 public:
  Strip(const Samples& samples, const Plane& plane)
      : samples_(samples), uphill_(-plane.normal.head<2>().normalized()) {
    std::vector<double> up, along;
    for (const int i : plane.points) {
      up.push_back(Up(i));
      along.push_back(Along(i));
    }
    up_ = MostOf(std::move(up));
    along_ = MostOf(std::move(along));
  }

  double Width() const { return up_.high - up_.low; }

  // Samples of another plane that lie within two metres of the strip, in plan.
  struct Neighbours {
    double below = 0;
    double above = 0;
  };
  Neighbours Beside(const Plane& plane) const {
    constexpr double kReach_m = 2;
    Neighbours beside;
    for (const int i : plane.points) {
      if (!along_.Holds(Along(i))) continue;
      const double up = Up(i);
      if (up > up_.low - kReach_m && up < up_.low) ++beside.below;
      if (up > up_.high && up < up_.high + kReach_m) ++beside.above;
    }
    return beside;
  }

 private:
  double Up(int i) const { return uphill_.dot(samples_.positions[i].head<2>()); }
  double Along(int i) const {
    return uphill_.x() * samples_.positions[i].y() - uphill_.y() * samples_.positions[i].x();
  }

  const Samples& samples_;
  Eigen::Vector2d uphill_;
  Most up_, along_;
};

constexpr double kSlack_m = 0.3;

bool IsLevel(const Plane& plane) {
  constexpr double kLevel = 0.995;  // cosine: 6 degrees
  return plane.normal.z() > kLevel;
}

// Whether `plane` is what a parapet of the roof smears: no roof goes on beyond it.
bool IsSmearedParapet(const Plane& plane, const Plane& roof, std::span<const Plane> planes,
                      const Samples& samples) {
  constexpr double kWidest_m = 2.5;
  constexpr double kFew = 0.15;
  if (IsLevel(plane) || !IsLevel(roof)) return false;
  if (roof.points.size() < 2 * plane.points.size()) return false;
  std::vector<double> heights;
  for (const int i : plane.points) heights.push_back(roof.DistanceTo(samples.positions[i]));
  const Most height = MostOf(std::move(heights));
  if (height.low < -kSlack_m || height.high > kParapetHeight_m + kSlack_m) return false;
  const Strip strip(samples, plane);
  if (strip.Width() >= kWidest_m) return false;
  const double few = kFew * strip.Beside(roof).below;
  return std::ranges::all_of(planes, [&](const Plane& other) {
    return !IsLevel(other) || strip.Beside(other).above < few;
  });
}

// Whether `plane` is the smeared wall between two roofs.
bool IsSmearedWall(const Plane& plane, const Plane& low, const Plane& high,
                   const Samples& samples) {
  constexpr double kSteep = 0.6;  // cosine: 53 degrees
  constexpr double kWidest_m = 1.5;
  constexpr double kBeside = 0.25;  // of the strip's samples, on either roof
  if (plane.normal.z() > kSteep || !IsLevel(low) || !IsLevel(high)) return false;
  std::vector<double> above_low, below_high;
  for (const int i : plane.points) {
    above_low.push_back(low.DistanceTo(samples.positions[i]));
    below_high.push_back(-high.DistanceTo(samples.positions[i]));
  }
  const Most from_low = MostOf(std::move(above_low)), from_high = MostOf(std::move(below_high));
  if (from_low.low < -kSlack_m || from_high.low < -kSlack_m) return false;
  const Strip strip(samples, plane);
  const double enough = kBeside * static_cast<double>(plane.points.size());
  return strip.Width() < kWidest_m && strip.Beside(low).below > enough &&
         strip.Beside(high).above > enough;
}

double RmsOf(const Plane& plane, const Samples& samples) {
  double sum = 0;
  for (const int i : plane.points) sum += std::pow(plane.DistanceTo(samples.positions[i]), 2);
  return std::sqrt(sum / static_cast<double>(plane.points.size()));
}

// Whether `plane` is rougher than roofs are, and than a roof of twice its size at least. Normals
// alone do not tell: those of a small smooth plane are off near its edges, and all of them in
// clouds thinner than details ask for.
bool IsRough(const Plane& plane, std::span<const Plane> planes, const Samples& samples,
             const Tolerances& tolerances) {
  constexpr double kMore_deg = 6;
  constexpr double kRough_deg = 10;
  constexpr double kThick = 0.125;  // of the level of detail
  if (tolerances.coarseness > 1) return false;
  const double scatter = NormalScatterDeg(samples, plane);
  if (scatter < kRough_deg) return false;
  if (RmsOf(plane, samples) < kThick * tolerances.level_of_detail) return false;
  return std::ranges::any_of(planes, [&](const Plane& roof) {
    return roof.area > 2 * plane.area && scatter > NormalScatterDeg(samples, roof) + kMore_deg;
  });
}

bool IsSmeared(const Plane& plane, std::span<const Plane> planes, const Samples& samples) {
  return std::ranges::any_of(planes, [&](const Plane& roof) {
    return IsSmearedParapet(plane, roof, planes, samples) ||
           std::ranges::any_of(planes, [&](const Plane& high) {
             return IsSmearedWall(plane, roof, high, samples);
           });
  });
}

}  // namespace

void DropRims(const Samples& samples, const MapBuilding& building, double width,
              std::vector<Plane>& planes) {
  constexpr double kMost = 0.9;  // of its samples
  std::erase_if(planes,
                [&](const Plane& plane) { return OnRim(plane, samples, building, width) > kMost; });
}

void DropParapets(const Samples& samples, const MapBuilding& building, const Tolerances& tolerances,
                  std::vector<Plane>& planes) {
  DropLevelParapets(samples, building, 2 * tolerances.level_of_detail, planes);
  std::vector<Plane> kept;
  for (const Plane& plane : planes) {
    const bool smeared =
        IsRough(plane, planes, samples, tolerances) || IsSmeared(plane, planes, samples);
    if (!smeared) kept.push_back(plane);
  }
  planes = std::move(kept);
}

}  // namespace stucco
