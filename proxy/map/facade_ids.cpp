// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/facade_ids.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "survey/plan_frame.h"

namespace stucco {
namespace {

// GPS without corrections is off by some metres, and the photos of one survey by the same ones;
// maps are by one or two more.
constexpr double kShiftSigma_m = 5;
// A wall of this length beside a facade makes a shift e times likelier: walls there have one four
// times out of five, elsewhere about one time in four.
constexpr double kTelling_m = 10;
constexpr double kMostShift_m = 15;
constexpr double kShiftStep_m = 0.5;
// Between a wall and its facade after the shift: maps trace eaves, and proxies flatten bays.
constexpr double kReach_m = 2;
constexpr double kLeastCosine = 0.966;  // 15 degrees: a frame from GPS may be turned a little
constexpr double kLeastOverlap = 0.5;   // of the shorter of wall and facade
constexpr double kLeastFound = 0.5;     // of all walls, or of all facades, by length and nearness
constexpr double kShortest_m = 0.1;     // as the planner's shortest facade
constexpr size_t kEnoughWalls = 6000;   // to try all shifts with

double LengthOf_m(const Segment2d& line) {
  return (line.b - line.a).norm();
}

// A wall beside a facade, in the facade's own directions.
struct WallBesideFacade {
  int wall = 0;
  int facade = 0;
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  // of the facade, unit
  double from_m = 0;                                 // the wall's ends along it, from its start
  double to_m = 0;
  double length_m = 0;   // of the facade
  double outside_m = 0;  // of the wall's middle from the facade

  Eigen::Vector2d Outwards() const { return {along.y(), -along.x()}; }
  double Distance(const Eigen::Vector2d& shift) const { return outside_m - Outwards().dot(shift); }
  // Where the wall is beside the facade, from the wall's start.
  Interval Stretch(const Eigen::Vector2d& shift) const {
    const double moved = along.dot(shift);
    return {std::max(from_m, moved) - from_m, std::min(to_m, length_m + moved) - from_m};
  }
  // Metres of the wall beside the facade, fewer the farther they are apart; 0: not a part of it.
  double Fit(const Eigen::Vector2d& shift) const {
    const double share = Distance(shift) / kReach_m;
    const double overlap = Stretch(shift).length_m();
    if (!(std::abs(share) < 1) || overlap < kLeastOverlap * std::min(to_m - from_m, length_m)) {
      return 0;
    }
    return std::max(0.0, overlap) * (1 - share * share);
  }
};

// Facades by squares of the ground plan that a shift may bring them into.
class NearFacades {
 public:
  explicit NearFacades(const std::vector<Segment2d>& facades) {
    for (size_t f = 0; f < facades.size(); ++f) {
      const double around = kMostShift_m + kReach_m;
      ForSquares(facades[f], around, [&](const Square& at) { squares_[at].push_back(f); });
    }
  }

  // Ascending.
  std::vector<size_t> Of(const Segment2d& wall) const {
    std::vector<size_t> near;
    ForSquares(wall, 0, [&](const Square& at) {
      const auto found = squares_.find(at);
      if (found == squares_.end()) return;
      near.insert(near.end(), found->second.begin(), found->second.end());
    });
    std::ranges::sort(near);
    near.erase(std::unique(near.begin(), near.end()), near.end());
    return near;
  }

 private:
  using Square = std::pair<int, int>;

  template <typename Visit>
  static void ForSquares(const Segment2d& line, double around, const Visit& visit) {
    constexpr double kSide_m = 20;
    const Eigen::Array2i low =
        ((line.a.cwiseMin(line.b).array() - around) / kSide_m).floor().cast<int>();
    const Eigen::Array2i high =
        ((line.a.cwiseMax(line.b).array() + around) / kSide_m).floor().cast<int>();
    for (int x = low.x(); x <= high.x(); ++x) {
      for (int y = low.y(); y <= high.y(); ++y) visit(Square{x, y});
    }
  }

  std::map<Square, std::vector<size_t>> squares_;
};

// The pairs that some shift may bring together, by wall, then facade.
std::vector<WallBesideFacade> FindCandidates(const std::vector<Segment2d>& walls,
                                             const std::vector<Segment2d>& facades) {
  const NearFacades near(facades);
  std::vector<WallBesideFacade> candidates;
  for (size_t w = 0; w < walls.size(); ++w) {
    if (!(LengthOf_m(walls[w]) >= kShortest_m)) continue;
    const Eigen::Vector2d middle = (walls[w].a + walls[w].b) / 2;
    const Eigen::Vector2d wall_along = (walls[w].b - walls[w].a).normalized();
    for (const size_t f : near.Of(walls[w])) {
      const double length = LengthOf_m(facades[f]);
      if (!(length >= kShortest_m)) continue;
      WallBesideFacade pair{.wall = static_cast<int>(w), .facade = static_cast<int>(f)};
      pair.along = (facades[f].b - facades[f].a) / length;
      pair.length_m = length;
      if (!(pair.along.dot(wall_along) >= kLeastCosine)) continue;
      pair.from_m = pair.along.dot(walls[w].a - facades[f].a);
      pair.to_m = pair.along.dot(walls[w].b - facades[f].a);
      pair.outside_m = pair.Outwards().dot(middle - facades[f].a);
      if (!(std::abs(pair.outside_m) <= kMostShift_m + kReach_m)) continue;
      if (pair.from_m > length + kMostShift_m || pair.to_m < -kMostShift_m) continue;
      candidates.push_back(pair);
    }
  }
  return candidates;
}

// Those of some walls that are spread over all.
std::vector<WallBesideFacade> CandidatesOfSome(std::vector<WallBesideFacade> candidates,
                                               size_t walls) {
  const size_t step = walls / kEnoughWalls + 1;
  std::erase_if(candidates, [&](const WallBesideFacade& pair) { return pair.wall % step != 0; });
  return candidates;
}

using Matches = std::vector<const WallBesideFacade*>;

// Whether most of the candidate's stretch is beside none of these facades.
bool IsApart(const WallBesideFacade& candidate, const Matches& taken,
             const Eigen::Vector2d& shift) {
  const Interval own = candidate.Stretch(shift);
  double shared = 0;
  for (const WallBesideFacade* other : taken) {
    const Interval theirs = other->Stretch(shift);
    shared += std::max(0.0, std::min(own.to_m, theirs.to_m) - std::max(own.from_m, theirs.from_m));
  }
  return shared < own.length_m() / 2;
}

// For each wall the candidates that it is a part of or spans, the best first: one after the other
// along it, as of facades that stand behind each other the wall is only one.
std::vector<Matches> MatchesOf(const std::vector<WallBesideFacade>& candidates, size_t walls,
                               const Eigen::Vector2d& shift) {
  std::vector<Matches> fitting(walls);
  for (const WallBesideFacade& candidate : candidates) {
    if (candidate.Fit(shift) > 0) fitting[candidate.wall].push_back(&candidate);
  }
  for (Matches& of_wall : fitting) {
    std::ranges::stable_sort(of_wall, std::greater(),
                             [&](const WallBesideFacade* match) { return match->Fit(shift); });
    Matches taken;
    for (const WallBesideFacade* match : of_wall) {
      if (IsApart(*match, taken, shift)) taken.push_back(match);
    }
    of_wall = std::move(taken);
  }
  return fitting;
}

// Log-likelihood of a shift: of what walls find there, and of GPS being that far off. A sum, so
// that in a long row of equal houses one that finds none still outweighs a smaller shift.
double ScoreOf(const std::vector<WallBesideFacade>& candidates, size_t walls,
               const Eigen::Vector2d& shift) {
  std::vector<double> fit(walls, 0);
  for (const WallBesideFacade& candidate : candidates) {
    fit[candidate.wall] = std::max(fit[candidate.wall], candidate.Fit(shift));
  }
  double sum = 0;
  for (const double metres : fit) sum += metres;
  return sum / kTelling_m - shift.squaredNorm() / (2 * kShiftSigma_m * kShiftSigma_m);
}

// Every shift on a grid: the score has many maxima where streets are regular.
Eigen::Vector2d BestOnGrid(const std::vector<WallBesideFacade>& candidates, size_t walls) {
  const int steps = static_cast<int>(kMostShift_m / kShiftStep_m);
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double best_score = ScoreOf(candidates, walls, best);
  for (int y = -steps; y <= steps; ++y) {
    for (int x = -steps; x <= steps; ++x) {
      const Eigen::Vector2d shift = kShiftStep_m * Eigen::Vector2d(x, y);
      const double score = ScoreOf(candidates, walls, shift);
      if (!(score > best_score)) continue;
      best_score = score;
      best = shift;
    }
  }
  return best;
}

// Least squares on what the shift matches, in which far walls weigh less (Tukey's biweight). Where
// all walls are parallel, the shift along them stays as it is.
Eigen::Vector2d Refined(const std::vector<WallBesideFacade>& candidates, size_t walls,
                        Eigen::Vector2d shift) {
  constexpr int kRounds = 10;
  constexpr double kDamping = 1e-3;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    double total = 0;
    for (const Matches& matches : MatchesOf(candidates, walls, shift)) {
      if (matches.empty()) continue;
      const WallBesideFacade& best = *matches.front();
      const double distance = best.Distance(shift);
      const double share = distance / kReach_m;
      const double weight = (best.to_m - best.from_m) * std::pow(1 - share * share, 2);
      const Eigen::Vector2d outwards = best.Outwards();
      normal += weight * outwards * outwards.transpose();
      right += weight * distance * outwards;
      total += weight;
    }
    if (!(total > 0)) break;
    normal += kDamping * total * Eigen::Matrix2d::Identity();
    shift += normal.inverse() * right;
  }
  return shift;
}

double TotalLength(const std::vector<Segment2d>& lines) {
  double sum = 0;
  for (const Segment2d& line : lines) sum += LengthOf_m(line);
  return sum;
}

// Whether enough walls find a facade, or enough facades a wall, to believe that the plan is of
// this place. The nearer they lie, the more they count: where the plan is of another part of a town
// with straight streets, some shift brings half of its facades within reach, at any distance.
bool IsOfThisPlace(const std::vector<Matches>& matches, const std::vector<Segment2d>& walls,
                   const std::vector<Segment2d>& facades, const Eigen::Vector2d& shift) {
  double walls_found = 0;
  std::vector<double> found(facades.size(), 0);
  for (size_t w = 0; w < walls.size(); ++w) {
    double of_wall = 0;
    for (const WallBesideFacade* match : matches[w]) {
      of_wall += match->Fit(shift);
      found[match->facade] += match->Fit(shift);
    }
    walls_found += std::min(of_wall, LengthOf_m(walls[w]));
  }
  double facades_found = 0;
  for (size_t f = 0; f < facades.size(); ++f) {
    facades_found += std::min(found[f], LengthOf_m(facades[f]));
  }
  return walls_found > 0 && (walls_found >= kLeastFound * TotalLength(walls) ||
                             facades_found >= kLeastFound * TotalLength(facades));
}

}  // namespace

Segment2d LineOf(const Facet& wall) {
  const Eigen::Vector2d outwards = wall.normal.head<2>().normalized();
  const Eigen::Vector2d along(-outwards.y(), outwards.x());
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector3d& vertex : wall.outer) middle += vertex.head<2>();
  middle /= static_cast<double>(wall.outer.size());
  double from = 0;
  double to = 0;
  for (const Eigen::Vector3d& vertex : wall.outer) {
    const double at = along.dot(vertex.head<2>() - middle);
    from = std::min(from, at);
    to = std::max(to, at);
  }
  return {middle + from * along, middle + to * along};
}

std::optional<Eigen::Vector2d> FindShift(const std::vector<Segment2d>& walls,
                                         const std::vector<Segment2d>& facades) {
  const std::vector<WallBesideFacade> candidates = FindCandidates(walls, facades);
  if (candidates.empty()) return std::nullopt;
  const Eigen::Vector2d shift =
      Refined(candidates, walls.size(),
              BestOnGrid(CandidatesOfSome(candidates, walls.size()), walls.size()));
  if (!IsOfThisPlace(MatchesOf(candidates, walls.size(), shift), walls, facades, shift))
    return std::nullopt;
  return shift;
}

std::vector<std::vector<int>> MatchWalls(const std::vector<Segment2d>& walls,
                                         const std::vector<Segment2d>& facades,
                                         const Eigen::Vector2d& shift) {
  const std::vector<WallBesideFacade> candidates = FindCandidates(walls, facades);
  std::vector<std::vector<int>> facades_of_walls;
  for (const Matches& matches : MatchesOf(candidates, walls.size(), shift)) {
    auto& numbers = facades_of_walls.emplace_back();
    for (const WallBesideFacade* match : matches) numbers.push_back(match->facade);
  }
  return facades_of_walls;
}

FacadeNaming NameFacades(const Plan& plan, const Georef& georef, Proxy& proxy) {
  assert(georef.frame == "enu");
  std::vector<Facet*> facets;
  std::vector<Segment2d> walls;
  for (Building& building : proxy.buildings) {
    for (Facet& facet : building.facets) {
      if (facet.facet_class != FacetClass::kWall) continue;
      facets.push_back(&facet);
      walls.push_back(LineOf(facet));
    }
  }
  std::vector<Segment2d> facades;
  for (const PlannedFacade& facade : plan.facades) {
    facades.push_back({EnuFromPlan(plan.origin, georef, facade.a_m),
                       EnuFromPlan(plan.origin, georef, facade.b_m)});
  }
  FacadeNaming naming{
      .walls = walls.size(), .named = 0, .facades = 0, .shift_m = FindShift(walls, facades)};
  if (!naming.shift_m) return naming;
  const std::vector<std::vector<int>> matches = MatchWalls(walls, facades, *naming.shift_m);
  std::set<int> found;
  for (size_t w = 0; w < facets.size(); ++w) {
    if (matches[w].empty()) continue;
    for (const int match : matches[w]) {
      facets[w]->planned_facades.push_back(plan.facades[match].id);
    }
    found.insert(matches[w].begin(), matches[w].end());
    ++naming.named;
  }
  naming.facades = found.size();
  return naming;
}

}  // namespace stucco
