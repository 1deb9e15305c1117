// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "survey/parallel.h"

namespace stucco::plan {
namespace {

constexpr double kDirectionStep = 5 * std::numbers::pi / 180;
constexpr int kDirectionSteps = 9;      // to either side
constexpr int kMostAimedRounds = 4;     // a part wider than the field of view takes several
constexpr size_t kMostObservers = 300;  // of a facade, for choosing its direction

struct Observer {
  int candidate = 0;
  int seen = 0;  // index into Candidate::seen
};

std::vector<std::vector<Observer>> ObserversByFacade(size_t facades,
                                                     std::span<const Candidate> candidates) {
  std::vector<std::vector<Observer>> observers(facades);
  for (size_t i = 0; i < candidates.size(); ++i) {
    for (size_t k = 0; k < candidates[i].seen.size(); ++k) {
      observers[candidates[i].seen[k].facade].push_back({static_cast<int>(i), static_cast<int>(k)});
    }
  }
  return observers;
}

WallView ViewWith(const DippingSetting& setting, const Candidate& candidate, const SeenFacade& seen,
                  double turn) {
  const Facade& facade = setting.site.facades[seen.facade];
  return {seen.facade, turn, false, InPhoto(setting, facade, candidate.position, turn, seen.seen)};
}

double BestTurn(const DippingSetting& setting, std::span<const Candidate> candidates,
                const std::vector<Observer>& observers) {
  const size_t stride = observers.size() / kMostObservers + 1;
  double best = -1, best_turn = 0;
  // From the normal outwards, so that it wins ties.
  for (int step = 0; step <= 2 * kDirectionSteps; ++step) {
    const int steps = (step + 1) / 2;
    const double turn = steps * kDirectionStep * (step % 2 ? 1 : -1) + 0.0;
    std::vector<SeenPart> parts;
    Intervals seen;
    double length = 1;
    for (size_t i = 0; i < observers.size(); i += stride) {
      const Candidate& candidate = candidates[observers[i].candidate];
      const WallView view = ViewWith(setting, candidate, candidate.seen[observers[i].seen], turn);
      if (view.seen.empty()) continue;
      const Facade& facade = setting.site.facades[view.facade];
      length = facade.length_m();
      parts.push_back(PartOf(facade, candidate.position, view));
      seen.insert(seen.end(), view.seen.begin(), view.seen.end());
    }
    const double share = Length(Union(std::move(seen))) / length;
    const FacadeQuality terms = QualityOfFacade(parts, share, setting.d_min_m, setting.d_max_m);
    const double quality = terms.q_s + terms.q_c;
    if (quality > best) {
      best = quality;
      best_turn = turn;
    }
  }
  return best_turn;
}

// Parts of each facade that some candidate sees but none with the facade's own direction.
std::vector<Intervals> MissedParts(std::span<const Candidate> candidates,
                                   std::span<const DippingPoint> points, size_t facades) {
  std::vector<Intervals> visible(facades), captured(facades);
  for (const Candidate& candidate : candidates) {
    for (const SeenFacade& part : candidate.seen) {
      visible[part.facade].insert(visible[part.facade].end(), part.seen.begin(), part.seen.end());
    }
  }
  for (const DippingPoint& point : points) {
    for (const WallView& view : point.views) {
      captured[view.facade].insert(captured[view.facade].end(), view.seen.begin(), view.seen.end());
    }
  }
  std::vector<Intervals> missed(facades);
  for (size_t i = 0; i < facades; ++i) {
    missed[i] = Difference(Union(std::move(visible[i])), Union(std::move(captured[i])));
  }
  return missed;
}

// A view from every candidate at the middle of every missed part that it sees.
void AddAimedViews(const DippingSetting& setting, std::span<const Candidate> candidates,
                   std::span<const Intervals> missed, std::span<DippingPoint> points) {
  ParallelFor(candidates.size(), setting.threads, [&](size_t i) {
    for (const SeenFacade& seen : candidates[i].seen) {
      const Facade& facade = setting.site.facades[seen.facade];
      for (const Interval& part : Intersection(seen.seen, missed[seen.facade])) {
        const double middle = (part.from_m + part.to_m) / 2;
        WallView view = ViewWith(setting, candidates[i], seen,
                                 TurnTowards(facade, candidates[i].position, middle));
        view.own_turn = true;
        if (!view.seen.empty()) points[i].views.push_back(std::move(view));
      }
    }
  });
}

}  // namespace

std::vector<double> InitialTurns(const Level& level, const DippingSetting& setting,
                                 std::span<const Candidate> candidates) {
  const size_t facades = setting.site.facades.size();
  const std::vector<std::vector<Observer>> observers = ObserversByFacade(facades, candidates);
  std::vector<double> turns(facades, 0);
  ParallelFor(level.facades.size(), setting.threads, [&](size_t i) {
    const int facade = level.facades[i];
    turns[facade] = BestTurn(setting, candidates, observers[facade]);
  });
  return turns;
}

std::vector<DippingPoint> ViewsOf(const DippingSetting& setting,
                                  std::span<const Candidate> candidates,
                                  std::span<const double> turns) {
  std::vector<DippingPoint> points(candidates.size());
  ParallelFor(candidates.size(), setting.threads, [&](size_t i) {
    points[i].position = candidates[i].position;
    for (const SeenFacade& seen : candidates[i].seen) {
      WallView view = ViewWith(setting, candidates[i], seen, turns[seen.facade]);
      if (!view.seen.empty()) points[i].views.push_back(std::move(view));
    }
  });
  for (int round = 0; round < kMostAimedRounds; ++round) {
    const std::vector<Intervals> missed = MissedParts(candidates, points, turns.size());
    if (std::all_of(missed.begin(), missed.end(), [](const auto& m) { return m.empty(); })) break;
    AddAimedViews(setting, candidates, missed, points);
  }
  return points;
}

}  // namespace stucco::plan
