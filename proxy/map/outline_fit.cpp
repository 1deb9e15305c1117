// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/outline_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "proxy/map/move_edges.h"
#include "proxy/map/neighbours.h"
#include "proxy/map/shared_length.h"
#include "proxy/map/wall_among.h"
#include "survey/disjoint_sets.h"
#include "survey/median.h"

namespace stucco {
namespace {

constexpr double kParty_m = 0.06;   // neighbours are snapped to each other when they are read
constexpr double kStraight = 0.26;  // sine of 15 degrees: smaller turns do not end a run of edges
constexpr double kAboveGround_m = 0.5;

// Edges that go on in one another and move together.
struct Run {
  std::vector<int> edges;  // of one ring, in order
  Eigen::Vector2d outwards = Eigen::Vector2d::Zero();
  double length = 0;
  bool party = false;
  std::optional<double> offset;  // where the points are, outwards; nothing: too few
};

struct RingPlace {
  size_t part = 0, ring = 0;
  std::vector<Run> runs;
  std::vector<int> run_of_edge;
};

RingPlace RunsOf(const MapBuilding& building, size_t part, size_t ring_index,
                 const std::vector<bool>& party) {
  const Ring& ring = building.parts[part].rings[ring_index];
  RingPlace place{.part = part, .ring = ring_index, .runs = {}, .run_of_edge = {}};
  const auto goes_on = [&](size_t i) {  // edge i in edge i + 1
    const size_t next = (i + 1) % ring.size();
    const Eigen::Vector2d u = OutwardsOf(EdgeOf(ring, i)), v = OutwardsOf(EdgeOf(ring, next));
    return std::abs(Cross(u, v)) < kStraight && u.dot(v) > 0 && party[i] == party[next];
  };
  // Begin behind a corner, so that no run goes over the end of the ring.
  size_t first = 0;
  while (first < ring.size() && goes_on((first + ring.size() - 1) % ring.size())) ++first;
  if (first == ring.size()) first = 0;
  place.run_of_edge.resize(ring.size());
  for (size_t k = 0; k < ring.size(); ++k) {
    const size_t i = (first + k) % ring.size();
    const bool joins = k > 0 && goes_on((i + ring.size() - 1) % ring.size());
    if (!joins) place.runs.emplace_back().party = party[i];
    Run& run = place.runs.back();
    const double length = (EdgeOf(ring, i).b - EdgeOf(ring, i).a).norm();
    run.edges.push_back(static_cast<int>(i));
    run.outwards += length * OutwardsOf(EdgeOf(ring, i));
    run.length += length;
    place.run_of_edge[i] = static_cast<int>(place.runs.size()) - 1;
  }
  for (Run& run : place.runs) run.outwards.normalize();
  return place;
}

std::vector<WallHit> HitsOf(const Samples& upright, const std::vector<int>& near, const Ring& ring,
                            const Run& run, double ground) {
  constexpr double kLeastCosine = 0.8;  // 37 degrees: normals of stereo are rough
  constexpr double kCell_m = 0.5;
  std::vector<WallHit> hits;
  for (size_t e = 0; e < run.edges.size(); ++e) {
    const Segment2d edge = EdgeOf(ring, run.edges[e]);
    const double length = (edge.b - edge.a).norm();
    const Eigen::Vector2d along = (edge.b - edge.a) / length;
    const Eigen::Vector2d outwards = OutwardsOf(edge);
    for (const int i : near) {
      const Eigen::Vector3d& p = upright.positions[i];
      const double distance = outwards.dot(p.head<2>() - edge.a);
      const double at = along.dot(p.head<2>() - edge.a);
      if (std::abs(distance) > kMapReach_m || at < 0 || at > length) continue;
      if (p.z() < ground + kAboveGround_m || !LooksLikeWall(upright.normals[i]) ||
          upright.normals[i].head<2>().dot(outwards) < kLeastCosine) {
        continue;
      }
      // Cells of different edges of a run are told apart.
      hits.push_back({distance,
                      {static_cast<int>(at / kCell_m) + 100000 * static_cast<int>(e),
                       static_cast<int>(std::floor(p.z() / kCell_m))}});
    }
  }
  std::sort(hits.begin(), hits.end(),
            [](const WallHit& a, const WallHit& b) { return a.distance < b.distance; });
  return hits;
}

// What the fit of one building needs.
struct Fitting {
  std::vector<RingPlace> rings;
  std::vector<int> near;  // samples
  double ground = 0;
};

// Where the points of each run are, outwards of the building's edges.
void FindOffsets(const UprightSurvey& survey, const MapBuilding& building,
                 const ExpectedWall& expected, Fitting& fitting) {
  for (RingPlace& place : fitting.rings) {
    const Ring& ring = building.parts[place.part].rings[place.ring];
    for (Run& run : place.runs) {
      if (run.party) continue;
      run.offset = WallAmong(HitsOf(survey.samples, fitting.near, ring, run, fitting.ground),
                             survey.tolerances.level_of_detail, expected, run.length);
    }
  }
}

// The runs of a building that points hold.
void AddHeldRuns(const Fitting& fitting, std::vector<const Run*>& held) {
  for (const RingPlace& place : fitting.rings) {
    for (const Run& run : place.runs) {
      if (run.offset) held.push_back(&run);
    }
  }
}

double HeldShare(const Fitting& fitting) {
  double held = 0, free = 0;
  for (const RingPlace& place : fitting.rings) {
    for (const Run& run : place.runs) {
      if (run.party) continue;
      free += run.length;
      if (run.offset) held += run.length;
    }
  }
  return free > 0 ? held / free : 0;
}

constexpr double kRunSigma_m = 0.15;  // of one run, beside what it shares with others

// A run that stands far out of line has less to say (Huber).
double WeightOf(double off) {
  const double sigmas = std::abs(off) / kRunSigma_m;
  return (sigmas > 1 ? 1 / sigmas : 1) / (kRunSigma_m * kRunSigma_m);
}

// How far the buildings of a map are shifted, each by itself.
struct ShiftPrior {
  std::vector<Eigen::Vector2d> done;  // by group: what they have been shifted by already
  double sigma = kMapSigma_m;         // of all of it, per axis
};

// The shift that runs agree on, where all of them lie `outset` outside of the map's, of a group
// that has been shifted by `done`.
Eigen::Vector2d CommonShift(const std::vector<const Run*>& runs, double outset,
                            const Eigen::Vector2d& done, double sigma) {
  constexpr int kRounds = 10;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Identity() / (sigma * sigma);
    Eigen::Vector2d right = -done / (sigma * sigma);
    for (const Run* run : runs) {
      const double offset = *run->offset - outset;
      const double weight = WeightOf(offset - run->outwards.dot(shift));
      normal += weight * run->outwards * run->outwards.transpose();
      right += weight * offset * run->outwards;
    }
    shift = normal.inverse() * right;
  }
  return shift;
}

// How the map's buildings lie against the walls: each group shifted, and all of them too large or
// too small, as where a map traces eaves. Found together: of a building that shows one wall only,
// nothing else tells the one from the other.
struct MapErrors {
  std::vector<Eigen::Vector2d> shifts;  // by group
  double outset = 0;                    // of the walls from the outlines
};

MapErrors ErrorsOf(const std::vector<std::vector<const Run*>>& groups, const ShiftPrior& prior) {
  constexpr int kRounds = 30;
  MapErrors errors{.shifts = std::vector<Eigen::Vector2d>(groups.size(), Eigen::Vector2d::Zero())};
  for (int round = 0; round < kRounds; ++round) {
    double total = 1 / (kMapSigma_m * kMapSigma_m), sum = 0;
    for (size_t g = 0; g < groups.size(); ++g) {
      errors.shifts[g] = CommonShift(groups[g], errors.outset, prior.done[g], prior.sigma);
      for (const Run* run : groups[g]) {
        const double off = *run->offset - run->outwards.dot(errors.shifts[g]);
        const double weight = WeightOf(off - errors.outset);
        total += weight;
        sum += weight * off;
      }
    }
    errors.outset = sum / total;
  }
  return errors;
}

// How far buildings are shifted, by what most of them are: of a map that puts others where they
// stand, one wall that is seen badly does not move a building.
double SpreadOf(const std::vector<Eigen::Vector2d>& shifts,
                const std::vector<std::vector<const Run*>>& groups) {
  constexpr size_t kFewest = 3;
  constexpr double kMedianOfPlane = 1.1774;  // of lengths, for normal distributions along both axes
  constexpr double kLeast_m = 0.05;
  std::vector<double> lengths;
  for (size_t g = 0; g < groups.size(); ++g) {
    if (!groups[g].empty()) lengths.push_back(shifts[g].norm());
  }
  if (lengths.size() < kFewest) return kMapSigma_m;
  return std::clamp(*Median(lengths) / kMedianOfPlane, kLeast_m, kMapSigma_m);
}

// How far walls lie from where the errors of the map put them, by what most of them do.
double SpreadOf(const std::vector<std::vector<const Run*>>& groups, const MapErrors& errors) {
  constexpr size_t kFewest = 6;
  constexpr double kSigmaOfMedian = 1.4826;  // of absolute deviations, for a normal distribution
  std::vector<double> off;
  for (size_t g = 0; g < groups.size(); ++g) {
    for (const Run* run : groups[g]) {
      off.push_back(std::abs(*run->offset - run->outwards.dot(errors.shifts[g]) - errors.outset));
    }
  }
  if (off.size() < kFewest) return kMapSigma_m;
  return std::clamp(kSigmaOfMedian * *Median(off), kRunSigma_m, kMapSigma_m);
}

// The building with every run where its points are; as it was where that crosses itself.
MapBuilding Fitted(const MapBuilding& building, const Fitting& fitting, double outset) {
  std::vector<std::vector<double>> offsets(building.parts.size());
  for (const RingPlace& place : fitting.rings) {
    for (const int run_index : place.run_of_edge) {
      const Run& run = place.runs[run_index];
      offsets[place.part].push_back(run.offset.value_or(run.party ? 0 : outset));
    }
  }
  MapBuilding fitted = building;
  for (size_t p = 0; p < fitted.parts.size(); ++p) {
    auto moved = WithEdgesMoved(building.parts[p], offsets[p]);
    if (!moved) return building;
    fitted.parts[p] = std::move(*moved);
  }
  return fitted;
}

// Which edges of a building touch another building, or another of its parts, and which others.
struct Touching {
  std::vector<std::vector<std::vector<bool>>> party;  // by part, ring, edge
  std::set<int> neighbours;
};

// Metres of an edge that edges of a polygon run against.
double Against(const Segment2d& edge, const Polygon& polygon) {
  double shared = 0;
  for (const Ring& ring : polygon.rings) {
    for (size_t k = 0; k < ring.size(); ++k) {
      shared += SharedLength(edge, EdgeOf(ring, k), kParty_m, Heading::kOpposite);
    }
  }
  return shared;
}

// The polygons that part `p` of a building may touch, with the building that each is of.
std::vector<std::pair<int, const Polygon*>> Beside(std::span<const MapBuilding> buildings, size_t b,
                                                   size_t p) {
  std::vector<std::pair<int, const Polygon*>> beside;
  const Eigen::AlignedBox2d box = BoundsOf(buildings[b], kParty_m);
  for (size_t o = 0; o < buildings.size(); ++o) {
    if (!box.intersects(BoundsOf(buildings[o], 0))) continue;
    for (size_t q = 0; q < buildings[o].parts.size(); ++q) {
      if (o != b || q != p) beside.emplace_back(static_cast<int>(o), &buildings[o].parts[q]);
    }
  }
  return beside;
}

// Whether an edge of building `b` runs against others, whose buildings join `neighbours`.
bool IsParty(const Segment2d& edge, const std::vector<std::pair<int, const Polygon*>>& beside,
             size_t b, std::set<int>& neighbours) {
  constexpr double kLeastShare = 0.5;  // of an edge
  double shared = 0;
  for (const auto& [owner, polygon] : beside) {
    const double with = Against(edge, *polygon);
    shared += with;
    if (with > 0 && owner != static_cast<int>(b)) neighbours.insert(owner);
  }
  return shared > kLeastShare * (edge.b - edge.a).norm();
}

Touching TouchingOf(std::span<const MapBuilding> buildings, size_t b) {
  Touching touching;
  for (size_t p = 0; p < buildings[b].parts.size(); ++p) {
    const auto beside = Beside(buildings, b, p);
    auto& of_part = touching.party.emplace_back();
    for (const Ring& ring : buildings[b].parts[p].rings) {
      auto& of_ring = of_part.emplace_back(ring.size(), false);
      for (size_t i = 0; i < ring.size(); ++i) {
        of_ring[i] = IsParty(EdgeOf(ring, i), beside, b, touching.neighbours);
      }
    }
  }
  return touching;
}

// The facades of the plan that an edge (as the map has it) is a part of, by metres of it.
std::vector<std::string> FacadesOn(const Segment2d& edge, const std::string& building,
                                   std::span<const Facade> facades) {
  constexpr double kOnLine_m = 0.15;  // straight walls of a map have corners up to 5 cm beside
  constexpr double kLeast_m = 0.05;
  std::vector<std::pair<double, const Facade*>> found;
  for (const Facade& facade : facades) {
    const bool own = facade.id.starts_with(building) && facade.id.size() > building.size() &&
                     facade.id[building.size()] == '/';
    if (!own) continue;
    const double shared = SharedLength(edge, {facade.a, facade.b}, kOnLine_m, Heading::kAlike);
    if (shared > kLeast_m) found.emplace_back(shared, &facade);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> ids;
  ids.reserve(found.size());
  for (const auto& [shared, facade] : found) ids.push_back(facade->id);
  return ids;
}

std::vector<FittedEdge> EdgesOf(const MapBuilding& mapped, const MapBuilding& fitted,
                                const Fitting& fitting, std::span<const Facade> facades) {
  std::vector<FittedEdge> edges;
  for (const RingPlace& place : fitting.rings) {
    const Ring& before = mapped.parts[place.part].rings[place.ring];
    const Ring& after = fitted.parts[place.part].rings[place.ring];
    for (size_t i = 0; i < after.size(); ++i) {
      const Run& run = place.runs[place.run_of_edge[i]];
      edges.push_back({.line = EdgeOf(after, i),
                       .facades = FacadesOn(EdgeOf(before, i), mapped.id, facades),
                       .party = run.party,
                       .fitted = run.offset.has_value()});
    }
  }
  return edges;
}

struct Fittings {
  std::vector<Fitting> of_buildings;
  std::vector<std::vector<size_t>> groups;  // of buildings that touch
};

Fittings FittingsOf(const UprightSurvey& survey, std::span<const MapBuilding> buildings,
                    double plan_to_survey_m) {
  Fittings result;
  DisjointSets sets(buildings.size());
  for (size_t b = 0; b < buildings.size(); ++b) {
    const Touching touching = TouchingOf(buildings, b);
    for (const int o : touching.neighbours) sets.Join(static_cast<int>(b), o);
    Fitting& fitting = result.of_buildings.emplace_back();
    fitting.near = survey.bins.In(BoundsOf(buildings[b], 2 * kMapReach_m));
    fitting.ground =
        GroundAround(survey, buildings[b]).value_or(buildings[b].z_m.from_m + plan_to_survey_m);
    for (size_t p = 0; p < buildings[b].parts.size(); ++p) {
      for (size_t r = 0; r < buildings[b].parts[p].rings.size(); ++r) {
        fitting.rings.push_back(RunsOf(buildings[b], p, r, touching.party[p][r]));
      }
    }
  }
  std::map<int, std::vector<size_t>> members;
  for (size_t b = 0; b < buildings.size(); ++b) {
    members[sets.Find(static_cast<int>(b))].push_back(b);
  }
  result.groups.reserve(members.size());
  for (auto& [first, group] : members) result.groups.push_back(std::move(group));
  return result;
}

// By group: the runs that points hold.
std::vector<std::vector<const Run*>> HeldRuns(const std::vector<Fitting>& fittings,
                                              const std::vector<std::vector<size_t>>& groups) {
  std::vector<std::vector<const Run*>> held;
  for (const std::vector<size_t>& group : groups) {
    auto& runs = held.emplace_back();
    for (const size_t b : group) AddHeldRuns(fittings[b], runs);
  }
  return held;
}

}  // namespace

std::vector<FittedBuilding> FitOutlines(const UprightSurvey& survey,
                                        std::span<const MapBuilding> buildings,
                                        std::span<const Facade> facades, double plan_to_survey_m) {
  auto [fittings, groups] = FittingsOf(survey, buildings, plan_to_survey_m);
  std::vector<MapBuilding> shifted(buildings.begin(), buildings.end());
  ExpectedWall expected;
  ShiftPrior prior{.done = std::vector<Eigen::Vector2d>(groups.size(), Eigen::Vector2d::Zero())};
  // Once the buildings are shifted, more of their walls are within reach.
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    for (size_t b = 0; b < buildings.size(); ++b) {
      FindOffsets(survey, shifted[b], expected, fittings[b]);
    }
    const auto held = HeldRuns(fittings, groups);
    const MapErrors errors = ErrorsOf(held, prior);
    expected = {.distance = errors.outset, .sigma = SpreadOf(held, errors)};
    for (size_t g = 0; g < groups.size(); ++g) {
      Eigen::Isometry2d motion = Eigen::Isometry2d::Identity();
      motion.translation() = errors.shifts[g];
      prior.done[g] += errors.shifts[g];
      for (const size_t b : groups[g]) shifted[b] = Moved(shifted[b], motion);
    }
    prior.sigma = SpreadOf(prior.done, held);
  }
  std::vector<FittedBuilding> fitted(buildings.size());
  for (size_t b = 0; b < buildings.size(); ++b) {
    FindOffsets(survey, shifted[b], expected, fittings[b]);
    fitted[b].building = Fitted(shifted[b], fittings[b], expected.distance);
    fitted[b].edges = EdgesOf(buildings[b], fitted[b].building, fittings[b], facades);
    fitted[b].ground = fittings[b].ground;
    fitted[b].held = HeldShare(fittings[b]);
  }
  // Of a scan from above, without walls, a map is all that is known of them.
  const bool has_walls =
      std::ranges::any_of(fitted, [](const FittedBuilding& building) { return building.held > 0; });
  if (has_walls) MeetNeighbours(survey, prior.sigma, fitted);
  return fitted;
}

}  // namespace stucco
