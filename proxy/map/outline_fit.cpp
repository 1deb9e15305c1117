// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/outline_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "proxy/map/ground_around.h"
#include "proxy/map/map_errors.h"
#include "proxy/map/move_edges.h"
#include "proxy/map/neighbours.h"
#include "proxy/map/shared_length.h"
#include "proxy/map/wall_among.h"
#include "proxy/map/wall_turn.h"
#include "survey/disjoint_sets.h"

namespace stucco {
namespace {

constexpr double kParty_m = 0.06;   // neighbours are snapped to each other when they are read
constexpr double kStraight = 0.26;  // sine of 15 degrees: smaller turns do not end a run of edges
constexpr double kAboveGround_m = 0.5;

// Edges that go on in one another and move together.
struct Run {
  std::vector<int> edges;  // of one ring, in order
  Eigen::Vector2d middle = Eigen::Vector2d::Zero(), outwards = Eigen::Vector2d::Zero();
  double length = 0;
  bool party = false;
  std::optional<HeldWall> held;  // where the points are; nothing: too few
  double own_turn = 0;           // radians, where it is surely turned against its building
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
    const Segment2d edge = EdgeOf(ring, i);
    const double length = (edge.b - edge.a).norm();
    run.edges.push_back(static_cast<int>(i));
    run.middle += length * (edge.a + edge.b) / 2;
    run.outwards += length * OutwardsOf(edge);
    run.length += length;
    place.run_of_edge[i] = static_cast<int>(place.runs.size()) - 1;
  }
  for (Run& run : place.runs) {
    run.outwards.normalize();
    run.middle /= run.length;
  }
  return place;
}

// In no order.
std::vector<WallHit> HitsOf(const Samples& upright, const std::vector<int>& near, const Ring& ring,
                            const Run& run, double ground) {
  constexpr double kLeastCosine = 0.8;  // 37 degrees: normals of stereo are rough
  constexpr double kCell_m = 0.5;
  const Eigen::Vector2d onwards(-run.outwards.y(), run.outwards.x());
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
      hits.push_back({.distance = distance,
                      .cell = {static_cast<int>(at / kCell_m) + 100000 * static_cast<int>(e),
                               static_cast<int>(std::floor(p.z() / kCell_m))},
                      .along = onwards.dot(p.head<2>() - run.middle)});
    }
  }
  return hits;
}

// What the fit of one building needs.
struct Fitting {
  std::vector<RingPlace> rings;
  std::vector<int> near;  // samples
  double ground = 0;
};

// How far a wall is turned by itself, as where the corners of a map were measured one by one.
double OwnTurn(const WallTurn& turn, double length) {
  constexpr double kLeast_m = 0.05;  // at its ends: walls of a house are square to each other
  constexpr double kLeastShare = 0.6;
  constexpr double kLeastGain = 1.15;
  const bool is_sure = turn.gain > kLeastGain && turn.span > kLeastShare * length &&
                       std::abs(turn.turn) * length / 2 > kLeast_m;
  return is_sure ? turn.turn : 0;
}

// Where the points of each run are, outwards of the building's edges.
void FindWalls(const UprightSurvey& survey, const MapBuilding& building,
               const ExpectedWall& expected, Fitting& fitting) {
  for (RingPlace& place : fitting.rings) {
    const Ring& ring = building.parts[place.part].rings[place.ring];
    for (Run& run : place.runs) {
      run.held.reset();
      if (run.party) continue;
      const auto hits = HitsOf(survey.samples, fitting.near, ring, run, fitting.ground);
      const WallTurn turn = TurnAmong(hits, expected, run.length);
      const auto offset = WallAmong(Turned(hits, turn.turn), survey.tolerances.level_of_detail,
                                    expected, run.length);
      run.own_turn = offset ? OwnTurn(turn, run.length) : 0;
      if (!offset) continue;
      run.held = {.middle = run.middle,
                  .outwards = run.outwards,
                  .offset = *offset,
                  .turn = turn.turn,
                  .span = turn.span};
    }
  }
}

// Where a neighbour stands against a part of a straight wall only, that part stays in line with
// what is seen of the rest.
void CarryOn(Fitting& fitting) {
  constexpr double kInLine = 0.9994;  // cosine of two degrees
  for (RingPlace& place : fitting.rings) {
    const size_t count = place.runs.size();
    const std::vector<Run> before = place.runs;
    for (size_t r = 0; r < count; ++r) {
      Run& run = place.runs[r];
      if (!run.party) continue;
      const Run* longest = nullptr;
      for (const size_t beside : {(r + count - 1) % count, (r + 1) % count}) {
        const Run& other = before[beside];
        const bool goes_on =
            !other.party && other.held && other.outwards.dot(run.outwards) > kInLine;
        if (goes_on && (longest == nullptr || other.length > longest->length)) longest = &other;
      }
      if (longest == nullptr) continue;
      run.middle = longest->middle;
      run.outwards = longest->outwards;
      run.held = longest->held;
      run.own_turn = longest->own_turn;
    }
  }
}

double HeldShare(const Fitting& fitting) {
  double held = 0, free = 0;
  for (const RingPlace& place : fitting.rings) {
    for (const Run& run : place.runs) {
      if (run.party) continue;
      free += run.length;
      if (run.held) held += run.length;
    }
  }
  return free > 0 ? held / free : 0;
}

// How an edge of a run moves onto its points.
EdgeMove MoveOf(const Run& run, const Segment2d& edge) {
  const Eigen::Vector2d onwards(-run.outwards.y(), run.outwards.x());
  const auto at = [&](const Eigen::Vector2d& end) {
    return run.held->offset - run.own_turn * onwards.dot(end - run.middle);
  };
  return {at(edge.a), at(edge.b)};
}

// The building with every run where its points are; as it was where that crosses itself.
MapBuilding Fitted(const MapBuilding& building, const Fitting& fitting, double outset) {
  std::vector<std::vector<EdgeMove>> moves(building.parts.size());
  for (const RingPlace& place : fitting.rings) {
    const Ring& ring = building.parts[place.part].rings[place.ring];
    for (size_t i = 0; i < ring.size(); ++i) {
      const Run& run = place.runs[place.run_of_edge[i]];
      const double unseen = run.party ? 0 : outset;
      moves[place.part].push_back(run.held ? MoveOf(run, EdgeOf(ring, i))
                                           : EdgeMove{unseen, unseen});
    }
  }
  MapBuilding fitted = building;
  for (size_t p = 0; p < fitted.parts.size(); ++p) {
    auto moved = WithEdgesMoved(building.parts[p], moves[p]);
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

// The facades of the plan by the id of their building, in the plan's order.
using FacadesOf = std::map<std::string, std::vector<const Facade*>, std::less<>>;

FacadesOf ByBuilding(std::span<const Facade> facades) {
  FacadesOf of_building;
  for (const Facade& facade : facades) {
    of_building[BuildingOf(facade)].push_back(&facade);
  }
  return of_building;
}

// The facades of its building that an edge (as the map has it) is a part of, by metres of it.
std::vector<std::string> FacadesOn(const Segment2d& edge,
                                   const std::vector<const Facade*>& facades) {
  constexpr double kOnLine_m = 0.15;  // straight walls of a map have corners up to 5 cm beside
  constexpr double kLeast_m = 0.05;
  std::vector<std::pair<double, const Facade*>> found;
  for (const Facade* facade : facades) {
    const double shared = SharedLength(edge, {facade->a, facade->b}, kOnLine_m, Heading::kAlike);
    if (shared > kLeast_m) found.emplace_back(shared, facade);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> ids;
  ids.reserve(found.size());
  for (const auto& [shared, facade] : found) ids.push_back(facade->id);
  return ids;
}

std::vector<FittedEdge> EdgesOf(const MapBuilding& mapped, const MapBuilding& fitted,
                                const Fitting& fitting, const std::vector<const Facade*>& facades) {
  std::vector<FittedEdge> edges;
  for (const RingPlace& place : fitting.rings) {
    const Ring& before = mapped.parts[place.part].rings[place.ring];
    const Ring& after = fitted.parts[place.part].rings[place.ring];
    for (size_t i = 0; i < after.size(); ++i) {
      const Run& run = place.runs[place.run_of_edge[i]];
      edges.push_back({.line = EdgeOf(after, i),
                       .facades = FacadesOn(EdgeOf(before, i), facades),
                       .party = run.party,
                       .fitted = run.held.has_value()});
    }
  }
  return edges;
}

struct Fittings {
  std::vector<Fitting> of_buildings;
  std::vector<std::vector<size_t>> groups;  // of buildings that touch
};

// The buildings of which some of the ring around one may show the roofs.
std::vector<const MapBuilding*> NeighboursOf(std::span<const MapBuilding> buildings, size_t b) {
  const Eigen::AlignedBox2d box = BoundsOf(buildings[b], 2 * kRing_m);
  std::vector<const MapBuilding*> neighbours;
  for (size_t o = 0; o < buildings.size(); ++o) {
    if (o != b && box.intersects(BoundsOf(buildings[o], 0))) neighbours.push_back(&buildings[o]);
  }
  return neighbours;
}

// What the ground of one building is above the plan's foot, by the nearest one of which it is
// known; else what it is everywhere.
double RiseNear(std::span<const MapBuilding> buildings,
                const std::vector<std::optional<double>>& known, size_t b, double everywhere) {
  constexpr double kNear_m = 30;
  double rise = everywhere, nearest = kNear_m;
  const Eigen::AlignedBox2d box = BoundsOf(buildings[b], 0);
  for (size_t o = 0; o < buildings.size(); ++o) {
    if (!known[o]) continue;
    const double distance = box.exteriorDistance(BoundsOf(buildings[o], 0));
    if (distance >= nearest) continue;
    nearest = distance;
    rise = *known[o] - buildings[o].z_m.from_m;
  }
  return rise;
}

// The ground of each building: that around it, where this is no neighbours' roof; else as much
// above the plan's foot as the nearest building's.
std::vector<double> GroundsOf(const UprightSurvey& survey, std::span<const MapBuilding> buildings,
                              double plan_to_survey_m) {
  std::vector<std::optional<double>> around, known;
  for (size_t b = 0; b < buildings.size(); ++b) {
    around.push_back(GroundAround(survey, buildings[b]));
    known.push_back(around.back());
    const auto neighbours = NeighboursOf(buildings, b);
    const bool doubtful = around[b] && !neighbours.empty() &&
                          LiesOnNeighbours(survey, buildings[b], *around[b], neighbours);
    if (doubtful) known.back().reset();
  }
  std::vector<double> grounds;
  for (size_t b = 0; b < buildings.size(); ++b) {
    if (known[b]) {
      grounds.push_back(*known[b]);
      continue;
    }
    const double near = buildings[b].z_m.from_m + RiseNear(buildings, known, b, plan_to_survey_m);
    const bool is_roof = !around[b] || *around[b] > near + kRaised_m;
    grounds.push_back(is_roof ? near : *around[b]);
  }
  return grounds;
}

Fittings FittingsOf(const UprightSurvey& survey, std::span<const MapBuilding> buildings,
                    double plan_to_survey_m) {
  Fittings result;
  const std::vector<double> grounds = GroundsOf(survey, buildings, plan_to_survey_m);
  DisjointSets sets(buildings.size());
  for (size_t b = 0; b < buildings.size(); ++b) {
    const Touching touching = TouchingOf(buildings, b);
    for (const int o : touching.neighbours) sets.Join(static_cast<int>(b), o);
    Fitting& fitting = result.of_buildings.emplace_back();
    fitting.near = survey.bins.In(BoundsOf(buildings[b], 2 * kMapReach_m));
    fitting.ground = grounds[b];
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

// Adds the walls of a building that points hold; the middle is summed up by length.
void AddHeld(const Fitting& fitting, HeldGroup& group, double& length) {
  for (const RingPlace& place : fitting.rings) {
    for (const Run& run : place.runs) {
      group.middle += run.length * run.middle;
      length += run.length;
      if (run.held) group.walls.push_back(*run.held);
    }
  }
}

std::vector<HeldGroup> HeldGroups(const Fittings& fittings) {
  std::vector<HeldGroup> held;
  for (const std::vector<size_t>& group : fittings.groups) {
    HeldGroup& walls = held.emplace_back();
    double length = 0;
    for (const size_t b : group) AddHeld(fittings.of_buildings[b], walls, length);
    walls.middle /= length;
  }
  return held;
}

void MoveRuns(const Eigen::Isometry2d& motion, Fitting& fitting) {
  for (RingPlace& place : fitting.rings) {
    for (Run& run : place.runs) {
      run.middle = motion * run.middle;
      run.outwards = motion.linear() * run.outwards;
    }
  }
}

// The buildings and their runs where the errors of the map leave them.
void Move(const std::vector<HeldGroup>& held, const MapErrors& errors, Fittings& fittings,
          std::vector<MapBuilding>& buildings) {
  for (size_t g = 0; g < held.size(); ++g) {
    const Eigen::Isometry2d motion = IsometryOf(errors.motions[g], held[g].middle);
    for (const size_t b : fittings.groups[g]) {
      buildings[b] = Moved(buildings[b], motion);
      MoveRuns(motion, fittings.of_buildings[b]);
    }
  }
}

}  // namespace

std::vector<FittedBuilding> FitOutlines(const UprightSurvey& survey,
                                        std::span<const MapBuilding> buildings,
                                        std::span<const Facade> facades, double plan_to_survey_m) {
  Fittings fittings = FittingsOf(survey, buildings, plan_to_survey_m);
  std::vector<MapBuilding> moved(buildings.begin(), buildings.end());
  ExpectedWall expected;
  MapPrior prior{.done = std::vector<GroupMotion>(fittings.groups.size())};
  // Once the buildings are moved, more of their walls are within reach.
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    for (size_t b = 0; b < buildings.size(); ++b) {
      FindWalls(survey, moved[b], expected, fittings.of_buildings[b]);
    }
    const auto held = HeldGroups(fittings);
    const MapErrors errors = ErrorsOf(held, prior);
    expected = {.distance = errors.outset, .sigma = SpreadOf(held, errors)};
    Move(held, errors, fittings, moved);
    prior = Learned(held, errors, std::move(prior));
  }
  FacadesOf facades_of = ByBuilding(facades);
  std::vector<FittedBuilding> fitted(buildings.size());
  for (size_t b = 0; b < buildings.size(); ++b) {
    Fitting& fitting = fittings.of_buildings[b];
    FindWalls(survey, moved[b], expected, fitting);
    CarryOn(fitting);
    fitted[b].building = Fitted(moved[b], fitting, expected.distance);
    fitted[b].edges =
        EdgesOf(buildings[b], fitted[b].building, fitting, facades_of[buildings[b].id]);
    fitted[b].ground = fitting.ground;
    fitted[b].held = HeldShare(fitting);
  }
  // Of a scan from above, without walls, a map is all that is known of them.
  const bool has_walls =
      std::ranges::any_of(fitted, [](const FittedBuilding& building) { return building.held > 0; });
  if (has_walls) MeetNeighbours(survey, prior.shift_sigma, fitted);
  return fitted;
}

}  // namespace stucco
