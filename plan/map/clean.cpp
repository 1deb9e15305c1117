// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/clean.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "plan/map/internal/noding.h"
#include "plan/map/internal/ogr.h"
#include "plan/map/internal/outlines.h"
#include "site/box_grid.h"
#include "site/facades.h"
#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

constexpr double kSame = 0.9;     // shared share of both of two buildings that are one
constexpr double kInside = 0.95;  // shared share of a building that lies in another
constexpr double kCell_m = 30;    // of the search for neighbours: about a building
// Overlaps up to this come from snapping walls by 5 cm and are not worth a line.
constexpr double kNotable_m2 = 1;

std::vector<Footprint> FootprintsOf(const MapFeature& feature, RepairLog& repairs) {
  std::vector<Footprint> footprints;
  for (Polygon& outline : internal::CleanOutlines(feature, repairs)) {
    footprints.push_back({.building = feature.building,
                          .outline = std::move(outline),
                          .z_m = {feature.min_height_m,
                                  feature.height_m.value_or(feature.guessed_height_m.value_or(0))},
                          .top_known = feature.height_m.has_value()});
  }
  return footprints;
}

// A top that is known or guessed: what stands on what does not depend on the metre.
bool HasTop(const Footprint& footprint) {
  return footprint.top_known || footprint.z_m.to_m > footprint.z_m.from_m;
}

BoxGrid GridOf(const std::vector<Footprint>& footprints) {
  std::vector<Eigen::AlignedBox2d> boxes;
  boxes.reserve(footprints.size());
  for (const Footprint& footprint : footprints) {
    boxes.push_back(BoundsOf(footprint.outline));
  }
  return {boxes, kCell_m};
}

// Gives parts of unknown buildings the building that most of them lies in, and takes them out of
// its outline. One that begins higher up stands on the building, of which it takes the top only;
// where parts make up all of the outline, they alone say what stands there, passages included.
class PartAssigner {
 public:
  PartAssigner(std::vector<Footprint>& footprints, const std::vector<bool>& is_loose_part)
      : footprints_(footprints), is_loose_part_(is_loose_part), grid_(GridOf(footprints)) {}

  void Assign(RepairLog& repairs) {
    std::map<int, std::vector<Footprint>> parts_of;
    for (size_t i = 0; i < footprints_.size(); ++i) {
      if (!is_loose_part_[i]) continue;
      const int host = HostOf(static_cast<int>(i));
      if (host < 0) {
        repairs.Add(footprints_[i].building, "a part outside any building; taken as a building");
        continue;
      }
      footprints_[i].building = footprints_[host].building;
      parts_of[host].push_back(footprints_[i]);
    }
    for (const auto& [host, parts] : parts_of) TakeOut(parts, host);
    // Slivers and what is covered by parts altogether.
    std::erase_if(footprints_, [](const Footprint& f) { return f.outline.rings.empty(); });
    footprints_.insert(footprints_.end(), rest_.begin(), rest_.end());
  }

 private:
  int HostOf(int part) const {
    constexpr double kMostOfIt = 0.5;
    const Polygon& outline = footprints_[part].outline;
    double most = kMostOfIt * Area(outline);
    int host = -1;
    for (const int near : grid_.Touching(BoundsOf(outline))) {
      if (is_loose_part_[near]) continue;
      const double shared = internal::SharedArea(outline, footprints_[near].outline);
      if (shared <= most) continue;
      most = shared;
      host = near;
    }
    return host;
  }

  void TakeOut(const std::vector<Footprint>& parts, int host) {
    constexpr double kLeastRest = 0.05;  // of the outline: less is how it was drawn
    const Footprint whole = footprints_[host];
    std::vector<Polygon> all;
    std::vector<Polygon> from_the_ground;
    for (const Footprint& part : parts) {
      all.push_back(part.outline);
      if (!BeginsAbove(part, whole)) from_the_ground.push_back(part.outline);
    }
    std::vector<Polygon> rest = Without(whole.outline, internal::Union(all));
    double area = 0;
    for (const Polygon& piece : rest) area += Area(piece);
    const bool parts_are_all = !from_the_ground.empty() && area < kLeastRest * Area(whole.outline);
    std::vector<Footprint> pieces;
    pieces.reserve(rest.size());
    for (Polygon& piece : rest) pieces.push_back(Like(whole, std::move(piece)));
    if (!parts_are_all) {
      for (Footprint& below : Below(parts, whole, from_the_ground)) {
        pieces.push_back(std::move(below));
      }
    }
    footprints_[host] = pieces.empty() ? Like(whole, {}) : pieces.front();
    if (!pieces.empty()) rest_.insert(rest_.end(), pieces.begin() + 1, pieces.end());
  }

  // What of a building stands below the parts that begin above its foot, the lowest one first.
  static std::vector<Footprint> Below(std::vector<Footprint> parts, const Footprint& whole,
                                      std::vector<Polygon> taken) {
    std::erase_if(parts, [&](const Footprint& part) { return !BeginsAbove(part, whole); });
    std::ranges::stable_sort(parts, {}, [](const Footprint& part) { return part.z_m.from_m; });
    std::vector<Footprint> pieces;
    for (const Footprint& part : parts) {
      for (const Polygon& under : internal::Intersection(part.outline, whole.outline)) {
        for (Polygon& piece : Without(under, internal::Union(taken))) {
          Footprint& below = pieces.emplace_back(Like(whole, std::move(piece)));
          if (HasTop(whole) && whole.z_m.to_m < part.z_m.from_m) continue;
          below.z_m.to_m = part.z_m.from_m;
          below.top_known = true;
        }
      }
      taken.push_back(part.outline);
    }
    return pieces;
  }

  static bool BeginsAbove(const Footprint& part, const Footprint& whole) {
    constexpr double kStep_m = 1;
    return part.z_m.from_m > whole.z_m.from_m + kStep_m;
  }

  static std::vector<Polygon> Without(const Polygon& outline, const std::vector<Polygon>& taken) {
    std::vector<Polygon> rest = internal::Difference(outline, taken);
    std::erase_if(rest, internal::IsSliver);
    return rest;
  }

  static Footprint Like(const Footprint& model, Polygon outline) {
    Footprint footprint = model;
    footprint.outline = std::move(outline);
    return footprint;
  }

  std::vector<Footprint>& footprints_;
  const std::vector<bool>& is_loose_part_;
  BoxGrid grid_;
  std::vector<Footprint> rest_;
};

// Takes apart what overlaps.
class OverlapCutter {
 public:
  OverlapCutter(std::vector<Footprint>& footprints, RepairLog& repairs)
      : footprints_(footprints), repairs_(repairs) {}

  // Buildings that are no more, with a note that says why.
  const std::set<std::string>& explained() const { return explained_; }

  // Returns whether anything had to be cut.
  bool Cut() {
    dropped_.assign(footprints_.size(), false);
    cuts_.clear();
    lifts_.clear();
    const BoxGrid grid = GridOf(footprints_);
    const std::vector<bool> known_apart = KnownApart();
    for (size_t i = 0; i < footprints_.size(); ++i) {
      const auto box = BoundsOf(footprints_[i].outline);
      for (const int j : grid.Touching(box)) {
        if (j <= static_cast<int>(i) || dropped_[i] || dropped_[j]) continue;
        if (known_apart[i] && known_apart[j]) continue;
        if (StandsAbove(footprints_[i], footprints_[j])) continue;
        if (!internal::InteriorsMeet(footprints_[i].outline, footprints_[j].outline)) continue;
        Separate(static_cast<int>(i), j);
      }
    }
    return Finish();
  }

 private:
  // Which outlines were there in the round before: most, and they need not be compared again.
  std::vector<bool> KnownApart() const {
    std::vector<bool> known;
    known.reserve(footprints_.size());
    for (const Footprint& footprint : footprints_) {
      known.push_back(apart_.contains(HashOf(footprint.outline)));
    }
    return known;
  }

  // FNV-1a over the corners.
  static uint64_t HashOf(const Polygon& outline) {
    uint64_t hash = 0xcbf29ce484222325;
    for (const Ring& ring : outline.rings) {
      for (const Eigen::Vector2d& corner : ring) {
        for (const double coordinate : {corner.x(), corner.y()}) {
          hash = (hash ^ std::bit_cast<uint64_t>(coordinate)) * 0x100000001b3;
        }
      }
    }
    return hash;
  }

  // Parts of one building at different heights may share ground.
  static bool StandsAbove(const Footprint& a, const Footprint& b) {
    return a.building == b.building &&
           ((HasTop(a) && a.z_m.to_m <= b.z_m.from_m) || (HasTop(b) && b.z_m.to_m <= a.z_m.from_m));
  }

  static bool IsHigher(const Footprint& a, const Footprint& b) {
    return HasTop(a) && HasTop(b) && a.z_m.to_m > b.z_m.to_m;
  }

  void Separate(int first, int second) {
    const Footprint& a = footprints_[first];
    const Footprint& b = footprints_[second];
    const double shared = internal::SharedArea(a.outline, b.outline);
    const bool first_is_smaller = Area(a.outline) < Area(b.outline);
    const int smaller = first_is_smaller ? first : second;
    const int larger = first_is_smaller ? second : first;
    const double small_area = Area(footprints_[smaller].outline);
    const double large_area = Area(footprints_[larger].outline);
    if (shared > kSame * large_area) {
      Drop(second, first, "has the same outline as {}; left out");
    } else if (a.building == b.building) {
      SeparateParts(IsHigher(a, b) ? first : second, IsHigher(a, b) ? second : first);
    } else if (shared > kInside * small_area) {
      PutInside(smaller, larger);
    } else {
      cuts_[smaller].push_back(larger);
      if (shared > kNotable_m2) {
        Note(smaller, larger, fmt::format("overlaps {{}} by {:.0f} m2; cut off", shared));
      }
    }
  }

  // What begins higher up, such as a dormer, stands on the other part; what begins at the same
  // height is what is seen.
  void SeparateParts(int higher, int lower) {
    const Footprint& high = footprints_[higher];
    const Footprint& low = footprints_[lower];
    if (HasTop(high) && HasTop(low) && high.z_m.from_m > low.z_m.from_m) {
      lifts_.emplace(higher, lower);
    } else {
      cuts_[lower].push_back(higher);
    }
  }

  void PutInside(int smaller, int larger) {
    if (!IsHigher(footprints_[smaller], footprints_[larger])) {
      Drop(smaller, larger, "lies inside {}; left out");
      // It may rise above the other: nobody knows.
      if (!footprints_[smaller].top_known) footprints_[larger].top_known = false;
      return;
    }
    Note(smaller, larger, "stands inside {} and rises above it; made a part of it");
    explained_.insert(footprints_[smaller].building);
    footprints_[smaller].building = footprints_[larger].building;
    if (!StandsAbove(footprints_[smaller], footprints_[larger])) SeparateParts(smaller, larger);
  }

  // What stays must be as high as what it stands for.
  void Drop(int dropped, int kept, const std::string& what) {
    Note(dropped, kept, what);
    dropped_[dropped] = true;
    const Footprint& from = footprints_[dropped];
    Footprint& into = footprints_[kept];
    if (from.top_known && !into.top_known && Area(from.outline) > kSame * Area(into.outline)) {
      into.top_known = true;
      into.z_m.to_m = from.z_m.to_m;
    } else if (from.top_known || !into.top_known) {
      into.z_m.to_m = std::max(into.z_m.to_m, from.z_m.to_m);
    }
    explained_.insert(from.building);
    into.z_m.from_m = std::min(into.z_m.from_m, from.z_m.from_m);
  }

  void Note(int about, int other, const std::string& what) {
    repairs_.Add(footprints_[about].building,
                 fmt::format(fmt::runtime(what), footprints_[other].building));
  }

  bool Finish() {
    bool changed = false;
    std::vector<Footprint> left;
    apart_.clear();
    for (size_t i = 0; i < footprints_.size(); ++i) {
      const auto lift = lifts_.find(static_cast<int>(i));
      const auto cut = cuts_.find(static_cast<int>(i));
      if (dropped_[i]) {
        changed = true;
      } else if (lift != lifts_.end()) {
        changed = true;
        const Footprint& below = footprints_[lift->second];
        AddLike(footprints_[i], internal::Difference(footprints_[i].outline, {below.outline}),
                left);
        Footprint lifted = footprints_[i];
        lifted.z_m.from_m = below.z_m.to_m;
        AddLike(lifted, internal::Intersection(lifted.outline, below.outline), left);
      } else if (cut != cuts_.end()) {
        changed = true;
        std::vector<Polygon> winners;
        for (const int winner : cut->second) winners.push_back(footprints_[winner].outline);
        AddLike(footprints_[i], internal::Difference(footprints_[i].outline, winners), left);
      } else {
        left.push_back(footprints_[i]);
        apart_.insert(HashOf(footprints_[i].outline));
      }
    }
    footprints_ = std::move(left);
    return changed;
  }

  static void AddLike(const Footprint& model, std::vector<Polygon> outlines,
                      std::vector<Footprint>& list) {
    for (Polygon& outline : outlines) {
      if (internal::IsSliver(outline)) continue;
      list.push_back(model);
      list.back().outline = std::move(outline);
    }
  }

  std::vector<Footprint>& footprints_;
  RepairLog& repairs_;
  std::vector<bool> dropped_;
  std::map<int, std::vector<int>> cuts_;  // who is cut by whom
  std::map<int, int> lifts_;              // who stands on whom
  std::set<std::string> explained_;
  std::set<uint64_t> apart_;  // outlines that have been compared with each other
};

// Snaps and nodes all outlines and mends those that this spoils.
bool NodeAll(internal::Noder& noder, std::vector<Footprint>& footprints) {
  std::vector<Polygon> outlines;
  outlines.reserve(footprints.size());
  for (Footprint& footprint : footprints) outlines.push_back(std::move(footprint.outline));
  const bool changed = noder.Apply(outlines);
  std::vector<Footprint> valid;
  for (size_t i = 0; i < footprints.size(); ++i) {
    for (Polygon& part : internal::ValidParts(outlines[i])) {
      valid.push_back(footprints[i]);
      valid.back().outline = std::move(part);
    }
  }
  footprints = std::move(valid);
  return changed;
}

// Corners on straight walls that joined a neighbour which has since been cut back.
void DropIdleCorners(std::vector<Footprint>& footprints) {
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  };
  std::map<Eigen::Vector2d, int, decltype(before)> uses(before);
  for (const Footprint& footprint : footprints) {
    for (const Ring& ring : footprint.outline.rings) {
      for (const Eigen::Vector2d& corner : ring) ++uses[corner];
    }
  }
  for (Footprint& footprint : footprints) {
    for (Ring& ring : footprint.outline.rings) {
      Ring kept;
      for (size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d& last = kept.empty() ? ring.back() : kept.back();
        const Eigen::Vector2d& next = ring[(i + 1) % ring.size()];
        constexpr double kStraight = 0.999;  // a bend that snapping makes, not one of a round wall
        const double ahead = (ring[i] - last).normalized().dot((next - ring[i]).normalized());
        const bool idle = uses.at(ring[i]) == 1 && ahead > kStraight &&
                          Distance(Segment2d{last, next}, ring[i]) <= kSnap_m;
        if (!idle) kept.push_back(ring[i]);
      }
      if (kept.size() >= 3) ring = std::move(kept);
    }
  }
}

// Snapping makes slivers of overlaps and cutting makes corners to snap; a few rounds settle it.
void SeparateAll(std::vector<Footprint>& footprints, RepairLog& repairs) {
  constexpr int kMostRounds = 10;
  const std::vector<Footprint> before = footprints;
  internal::Noder noder(kSnap_m);
  OverlapCutter cutter(footprints, repairs);
  const auto settle = [&] {
    for (int round = 0; round < kMostRounds; ++round) {
      const bool noded = NodeAll(noder, footprints);
      const bool cut = cutter.Cut();
      if (!noded && !cut) break;
    }
  };
  settle();
  DropIdleCorners(footprints);
  settle();
  if (noder.moved() > 0) {
    repairs.Add("", fmt::format("{} corners moved by up to {:.0f} cm to join neighbours",
                                noder.moved(), kSnap_m * 100));
  }
  std::set<std::string> there = cutter.explained();
  for (const Footprint& footprint : footprints) there.insert(footprint.building);
  for (const Footprint& footprint : before) {
    if (!there.insert(footprint.building).second) continue;
    repairs.Add(footprint.building, "its neighbours leave nothing of it; left out");
  }
}

void SortCorners(Polygon& outline) {
  for (Ring& ring : outline.rings) ring = FromSouthWest(std::move(ring));
  std::sort(outline.rings.begin() + 1, outline.rings.end(), [](const Ring& a, const Ring& b) {
    return std::pair(a[0].x() + a[0].y(), a[0].x()) < std::pair(b[0].x() + b[0].y(), b[0].x());
  });
}

}  // namespace

CleanedMap CleanMap(const std::vector<MapFeature>& features) {
  CleanedMap map;
  std::map<std::string, int> features_of;
  for (const MapFeature& feature : features) ++features_of[feature.building];
  std::vector<bool> is_loose_part;
  for (const MapFeature& feature : features) {
    for (Footprint& footprint : FootprintsOf(feature, map.repairs)) {
      map.footprints.push_back(std::move(footprint));
      is_loose_part.push_back(feature.is_part && features_of.at(feature.building) == 1);
    }
  }
  PartAssigner(map.footprints, is_loose_part).Assign(map.repairs);
  SeparateAll(map.footprints, map.repairs);
  // The parts of a building one after another, buildings in the order of the map.
  std::map<std::string, size_t> order;
  for (const MapFeature& feature : features) order.emplace(feature.building, order.size());
  std::stable_sort(map.footprints.begin(), map.footprints.end(),
                   [&](const Footprint& a, const Footprint& b) {
                     return order.at(a.building) < order.at(b.building);
                   });
  for (Footprint& footprint : map.footprints) SortCorners(footprint.outline);
  return map;
}

}  // namespace stucco::plan
