// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/move_hovers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "survey/error.h"
#include "survey/geometry2d.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

constexpr size_t kNeighbours = 8;
// Of a gain, against the rounding of sums.
constexpr double kLeastGain = 1e-9;

// What photos straight down see of roofs and ground, in samples.
struct PlaneCoverage {
  double all = 0;
  double seen = 0;
  double sightings = 0;

  double Quality() const { return sightings > 0 && all > 0 ? seen / sightings + seen / all : 0; }
};

PlaneCoverage CoverageOf(const ViewGraph& graph, std::span<const SurfaceSample> samples) {
  PlaneCoverage out;
  for (uint32_t s = 0; s < samples.size(); ++s) {
    if (samples[s].kind == SurfaceKind::kWall) continue;
    out.all += 1;
    out.seen += graph.state(s).nadirs > 0;
    out.sightings += graph.state(s).nadirs;
  }
  return out;
}

// A place for a hover that has been taken out of the graph.
struct Place {
  bool possible = false;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::vector<Sighting> sightings;
  std::vector<double> shares;
  double reconstructability = 0;  // gain in Q_r
  PlaneCoverage coverage;

  bool Dominates(const Place& other) const {
    const double q = coverage.Quality() - other.coverage.Quality();
    const double r = reconstructability - other.reconstructability;
    return q >= -kLeastGain && r >= -kLeastGain && (q > kLeastGain || r > kLeastGain);
  }
};

class Mover {
 public:
  Mover(ViewGraph& graph, const MoveSetting& setting)
      : graph_(graph),
        view_(graph.view()),
        setting_(setting),
        coverage_(CoverageOf(graph, graph.view().samples)) {}

  bool Move(uint32_t number, Hover& hover);

 private:
  void TakeOut(uint32_t number, const Place& here);
  Place Assess(const Place& place) const;
  bool Serves(const Place& place) const;

  ViewGraph& graph_;
  const SurfaceView& view_;
  const MoveSetting& setting_;
  PlaneCoverage coverage_;
  std::vector<uint32_t> in_need_;  // samples that lack something without the hover
};

void Mover::TakeOut(uint32_t number, const Place& here) {
  graph_.Remove(number, here.shares);
  in_need_.clear();
  for (const Sighting& sighting : here.sightings) {
    const SampleState& state = graph_.state(sighting.sample);
    if (!setting_.requirements[sighting.sample].MetBy(state)) in_need_.push_back(sighting.sample);
    if (!sighting.nadir || view_.samples[sighting.sample].kind == SurfaceKind::kWall) continue;
    coverage_.sightings -= 1;
    coverage_.seen -= state.nadirs == 0;
  }
}

Place Mover::Assess(const Place& place) const {
  Place out = place;
  out.coverage = coverage_;
  out.reconstructability = 0;
  const double scale = std::max(setting_.tau_r, 1e-6);
  for (size_t i = 0; i < out.sightings.size(); ++i) {
    const SampleState& state = graph_.state(out.sightings[i].sample);
    const double before = std::max(0.0, state.reconstructability);
    const double after = before + out.shares[i];
    out.reconstructability += after / (after + scale) - before / (before + scale);
    if (!out.sightings[i].nadir ||
        view_.samples[out.sightings[i].sample].kind == SurfaceKind::kWall) {
      continue;
    }
    out.coverage.sightings += 1;
    out.coverage.seen += state.nadirs == 0;
  }
  return out;
}

bool Mover::Serves(const Place& place) const {
  auto at = place.sightings.begin();
  for (const uint32_t sample : in_need_) {
    at = std::lower_bound(at, place.sightings.end(), sample,
                          [](const Sighting& s, uint32_t wanted) { return s.sample < wanted; });
    if (at == place.sightings.end() || at->sample != sample) return false;
    SampleState state = graph_.state(sample);
    state.reconstructability += place.shares[at - place.sightings.begin()];
    ++state.hovers;
    state.nadirs += at->nadir;
    if (!setting_.requirements[sample].MetBy(state)) return false;
  }
  return true;
}

bool Mover::Move(uint32_t number, Hover& hover) {
  Place here;
  here.position = hover.position;
  here.sightings.assign(graph_.sightings(number).begin(), graph_.sightings(number).end());
  here.shares = graph_.Shares(number);
  TakeOut(number, here);
  here = Assess(here);

  const Eigen::Vector2d u = setting_.step_m * setting_.axis;
  const Eigen::Vector2d v(-u.y(), u.x());
  const std::array<Eigen::Vector2d, kNeighbours> steps{u, u + v, v, v - u, -u, -u - v, -v, u - v};
  std::array<Place, kNeighbours> places;
  ParallelFor(kNeighbours, setting_.threads, [&](size_t k) {
    const Eigen::Vector2d at = hover.position.head<2>() + steps[k];
    Place place;
    place.position = {at.x(), at.y(), setting_.obstacles.site().CeilingAt(at)};
    if (!Contains(setting_.obstacles.site().area, at) || !setting_.obstacles.IsFree(place.position))
      return;
    place.sightings = SightingsOf(view_, {place.position, hover.shots});
    place.shares = graph_.SharesFrom(place.position, place.sightings);
    places[k] = Assess(place);
    places[k].possible = Serves(places[k]);
  });
  Place* best = &here;
  for (Place& place : places) {
    if (!place.possible || !place.Dominates(here)) continue;
    if (best == &here || place.reconstructability > best->reconstructability) best = &place;
  }
  coverage_ = best->coverage;
  hover.position = best->position;
  graph_.Insert(number, best->position, std::move(best->sightings), best->shares);
  return best != &here;
}

}  // namespace

size_t MoveHovers(ViewGraph& graph, const MoveSetting& setting, std::vector<Hover>& hovers,
                  Progress& progress) {
  Mover mover(graph, setting);
  progress.Begin("planar views: moving", hovers.size());
  size_t moved = 0;
  for (uint32_t i = 0; i < hovers.size(); ++i) {
    if (progress.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
    if (!graph.removed(i)) moved += mover.Move(i, hovers[i]);
    progress.Advance();
  }
  return moved;
}

}  // namespace stucco::plan
