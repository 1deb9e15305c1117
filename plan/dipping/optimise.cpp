// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/optimise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "plan/dipping/lift.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;

constexpr int kMostRounds = 20;  // five are usual
constexpr int kDirections = 8;
constexpr std::array<double, 2> kStepsM = {1, 4};           // tau_p
constexpr double kTurnStep = 2.5 * std::numbers::pi / 180;  // tau_s
constexpr int kTurnSteps = 4;                               // to either side
constexpr double kLeastGain = 1e-3;                         // in the sum of qualities or in hovers
constexpr double kNoLoss = 1e-9;

// One view of a facade: which point it belongs to.
struct User {
  int point = 0;
  int view = 0;
};

struct Quality {
  double value = 0;    // eq. 1
  double covered = 0;  // metres
};

// A view and where it is from.
struct Look {
  const Vector2d& from;
  const WallView& view;
};

struct Place {
  DippingPoint point;
  std::vector<SeenFacade> visible;  // in all directions
};

const SeenFacade* Find(const std::vector<SeenFacade>& visible, int facade) {
  const auto seen =
      std::lower_bound(visible.begin(), visible.end(), facade,
                       [](const SeenFacade& a, int number) { return a.facade < number; });
  return seen != visible.end() && seen->facade == facade ? &*seen : nullptr;
}

class Optimiser {
 public:
  Optimiser(const Level& level, const DippingSetting& setting, std::vector<double>& turns,
            std::vector<DippingPoint>& points)
      : level_(level),
        setting_(setting),
        turns_(turns),
        points_(points),
        states_(points.size()),
        changed_at_(setting.site.facades.size(), 0),
        looked_at_(setting.site.facades.size(), 0) {
    CollectUsers();
    ParallelFor(points.size(), setting.threads, [&](size_t i) {
      states_[i].visible = SeenFrom(level, setting, points[i].position);
    });
  }

  OptimiseReport Run() {
    OptimiseReport report;
    for (; report.rounds < kMostRounds; ++report.rounds) {
      const int moved = AdjustPoints(), turned = AdjustTurns(), removed = RemoveRedundant();
      report.moved += moved;
      report.turned += turned;
      report.removed += removed;
      if (moved + turned + removed == 0) break;
    }
    return report;
  }

 private:
  const Facade& FacadeOf(const WallView& view) const { return setting_.site.facades[view.facade]; }

  void CollectUsers() {
    users_.assign(setting_.site.facades.size(), {});
    for (size_t i = 0; i < points_.size(); ++i) {
      for (size_t k = 0; k < points_[i].views.size(); ++k) {
        users_[points_[i].views[k].facade].push_back({static_cast<int>(i), static_cast<int>(k)});
      }
    }
  }

  // Of a facade whose k-th user looks as look(k) says.
  template <typename LookOf>
  Quality QualityOf(int facade, const LookOf& look) const {
    std::vector<SeenPart> parts;
    Intervals seen;
    const Facade& wall = setting_.site.facades[facade];
    for (size_t k = 0; k < users_[facade].size(); ++k) {
      const Look one = look(k);
      parts.push_back(PartOf(wall, one.from, one.view));
      seen.insert(seen.end(), one.view.seen.begin(), one.view.seen.end());
    }
    const double covered = Length(Union(std::move(seen)));
    const double share = covered / wall.length_m();
    return {QualityOfFacade(parts, share, setting_.d_min_m, setting_.d_max_m).sum(), covered};
  }

  Quality QualityOf(int facade) const {
    return QualityOf(facade, [&](size_t k) {
      const User& user = users_[facade][k];
      return Look{points_[user.point].position, points_[user.point].views[user.view]};
    });
  }

  // If point number `index` were `instead`.
  Quality QualityWith(int facade, int index, const DippingPoint& instead) const {
    return QualityOf(facade, [&](size_t k) {
      const User& user = users_[facade][k];
      const DippingPoint& point = user.point == index ? instead : points_[user.point];
      return Look{point.position, point.views[user.view]};
    });
  }

  // If these were its views, in the order of users_.
  Quality QualityWith(int facade, const std::vector<WallView>& views) const {
    return QualityOf(facade, [&](size_t k) {
      return Look{points_[users_[facade][k].point].position, views[k]};
    });
  }

  double CostOf(const DippingPoint& point) const {
    std::vector<Dip> dips;
    for (const WallView& view : point.views) {
      dips.push_back(MakeDip(level_, setting_, point.position, view));
    }
    return HoveringCost(dips, setting_.vertical_step);
  }

  static std::vector<int> FacadesOf(const DippingPoint& point) {
    std::set<int> facades;
    for (const WallView& view : point.views) facades.insert(view.facade);
    return {facades.begin(), facades.end()};
  }

  // The same views from another place; nothing when one of them would see nothing there.
  std::optional<Place> Moved(const DippingPoint& point, const Vector2d& position) const {
    if (!MayDip(level_, setting_, position)) return std::nullopt;
    Place moved{{position, point.views}, SeenFrom(level_, setting_, position)};
    for (WallView& view : moved.point.views) {
      const SeenFacade* seen = Find(moved.visible, view.facade);
      if (seen == nullptr) return std::nullopt;
      view.seen = InPhoto(setting_, FacadeOf(view), position, view.turn_rad, seen->seen);
      if (view.seen.empty()) return std::nullopt;
    }
    return moved;
  }

  // The best neighbouring position that dominates the present one.
  std::optional<Place> BetterPlace(int index) const {
    const DippingPoint& point = points_[index];
    const std::vector<int> facades = FacadesOf(point);
    std::vector<Quality> before;
    before.reserve(facades.size());
    for (const int facade : facades) before.push_back(QualityOf(facade));
    const double cost = CostOf(point);
    double best_gain = kLeastGain;
    std::optional<Place> best;
    for (const double step : kStepsM) {
      for (int k = 0; k < kDirections; ++k) {
        const double angle = 2 * std::numbers::pi * k / kDirections;
        const Vector2d to = point.position + step * Vector2d(std::cos(angle), std::sin(angle));
        std::optional<Place> moved = Moved(point, to);
        if (!moved) continue;
        double gain = cost - CostOf(moved->point);
        bool dominates = gain >= -kNoLoss;
        for (size_t i = 0; dominates && i < facades.size(); ++i) {
          const Quality after = QualityWith(facades[i], index, moved->point);
          dominates = after.value >= before[i].value - kNoLoss &&
                      after.covered >= before[i].covered - kNoLoss;
          gain += after.value - before[i].value;
        }
        if (dominates && gain > best_gain) {
          best_gain = gain;
          best = std::move(moved);
        }
      }
    }
    return best;
  }

  // Points by colour, such that no two of a colour have a facade in common.
  std::vector<std::vector<int>> Colours() const {
    std::vector<std::vector<int>> points;
    std::vector<std::set<int>> colours_of_facade(users_.size());
    for (size_t i = 0; i < points_.size(); ++i) {
      const std::vector<int> facades = FacadesOf(points_[i]);
      int colour = 0;
      while (std::any_of(facades.begin(), facades.end(),
                         [&](int facade) { return colours_of_facade[facade].contains(colour); })) {
        ++colour;
      }
      for (const int facade : facades) colours_of_facade[facade].insert(colour);
      if (static_cast<size_t>(colour) >= points.size()) points.emplace_back();
      points[colour].push_back(static_cast<int>(i));
    }
    return points;
  }

  // Whether anything that the point's place depends on changed since it was last looked at.
  bool IsStale(int index) const {
    const std::vector<WallView>& views = points_[index].views;
    return std::any_of(views.begin(), views.end(), [&](const WallView& view) {
      return changed_at_[view.facade] >= states_[index].looked_at;
    });
  }
  void MarkChanged(const DippingPoint& point, int step) {
    for (const WallView& view : point.views) changed_at_[view.facade] = step;
  }

  bool AdjustPoint(int index, int step) {
    if (!IsStale(index)) return false;
    states_[index].looked_at = step + 1;
    std::optional<Place> better = BetterPlace(index);
    if (!better) return false;
    points_[index] = std::move(better->point);
    // There may be a still better place beyond.
    states_[index] = {std::move(better->visible), step};
    MarkChanged(points_[index], step);
    return true;
  }

  // A point waits only for those of lower colours that it has a facade with, as they alone
  // influence it: colours run far into each other, and yet the result is that of one by one.
  int AdjustPoints() {
    const std::vector<std::vector<int>> colours = Colours();
    struct Visit {
      int point = 0;
      int step = 0;
    };
    std::vector<Visit> visits;
    std::vector<std::vector<size_t>> before;
    std::vector<std::optional<size_t>> last(users_.size());  // by facade
    for (const std::vector<int>& points : colours) {
      ++step_;
      for (const int point : points) {
        before.emplace_back();
        for (const int facade : FacadesOf(points_[point])) {
          if (last[facade]) before.back().push_back(*last[facade]);
          last[facade] = visits.size();
        }
        visits.push_back({point, step_});
      }
    }
    std::vector<char> moved(visits.size(), 0);
    ParallelInOrder(before, setting_.threads, [&](size_t i) {
      moved[i] = AdjustPoint(visits[i].point, visits[i].step) ? 1 : 0;
    });
    return static_cast<int>(std::count(moved.begin(), moved.end(), 1));
  }

  // The facade's views in another direction, in the order of users_.
  std::optional<std::vector<WallView>> Turned(int facade, double turn) const {
    std::vector<WallView> views;
    for (const User& user : users_[facade]) {
      WallView view = points_[user.point].views[user.view];
      if (!view.own_turn) {
        const Vector2d& position = points_[user.point].position;
        const SeenFacade* seen = Find(states_[user.point].visible, facade);
        if (seen == nullptr) return std::nullopt;
        view.turn_rad = turn;
        view.seen = InPhoto(setting_, FacadeOf(view), position, turn, seen->seen);
        if (view.seen.empty()) return std::nullopt;
      }
      views.push_back(std::move(view));
    }
    return views;
  }

  struct BetterTurn {
    double turn = 0;
    std::vector<WallView> views;  // by user
  };

  // By how much less the points of a facade cost to hover at with these views of it.
  double SavedBy(int facade, const std::vector<WallView>& views) const {
    std::map<int, DippingPoint> turned;
    for (size_t k = 0; k < views.size(); ++k) {
      const User& user = users_[facade][k];
      const auto point = turned.try_emplace(user.point, points_[user.point]).first;
      point->second.views[user.view] = views[k];
    }
    double saved = 0;
    for (const auto& [index, point] : turned) saved += CostOf(points_[index]) - CostOf(point);
    return saved;
  }

  std::optional<BetterTurn> FindBetterTurn(int facade) const {
    if (users_[facade].empty()) return std::nullopt;
    const Quality before = QualityOf(facade);
    double best_gain = kLeastGain;
    std::optional<BetterTurn> best;
    for (int step = -kTurnSteps; step <= kTurnSteps; ++step) {
      if (step == 0) continue;
      const double turn = turns_[facade] + step * kTurnStep;
      std::optional<std::vector<WallView>> views = Turned(facade, turn);
      if (!views) continue;
      const Quality after = QualityWith(facade, *views);
      if (after.value < before.value - kNoLoss) continue;
      if (after.covered < before.covered - kNoLoss) continue;
      const double saved = SavedBy(facade, *views);
      const double gain = after.value - before.value + saved;
      if (saved < -kNoLoss || gain <= best_gain) continue;
      best_gain = gain;
      best = BetterTurn{turn, std::move(*views)};
    }
    return best;
  }

  // Turns a facade; its points are `turned` then.
  void Turn(int facade, BetterTurn better, std::set<int>& turned) {
    looked_at_[facade] = step_;
    changed_at_[facade] = step_;
    turns_[facade] = better.turn;
    for (size_t k = 0; k < users_[facade].size(); ++k) {
      const User& user = users_[facade][k];
      points_[user.point].views[user.view] = std::move(better.views[k]);
      turned.insert(user.point);
    }
  }

  // The direction of a facade influences its own quality and what its points cost: all are looked
  // at at once, and again where another one has turned at a point of theirs.
  int AdjustTurns() {
    ++step_;
    std::vector<std::optional<BetterTurn>> better(level_.facades.size());
    ParallelFor(level_.facades.size(), setting_.threads, [&](size_t i) {
      const int facade = level_.facades[i];
      if (changed_at_[facade] >= looked_at_[facade]) better[i] = FindBetterTurn(facade);
    });
    int count = 0;
    std::set<int> turned;
    for (size_t i = 0; i < better.size(); ++i) {
      const int facade = level_.facades[i];
      looked_at_[facade] = step_ + 1;
      const bool again = better[i] && std::ranges::any_of(users_[facade], [&](const User& user) {
                           return turned.contains(user.point);
                         });
      if (again) better[i] = FindBetterTurn(facade);
      if (!better[i]) continue;
      Turn(facade, std::move(*better[i]), turned);
      ++count;
    }
    return count;
  }

  // Views whose whole part other views of the facade see too; the lowest score first.
  int RemoveRedundant() {
    std::vector<std::vector<int>> removed(level_.facades.size());  // positions in users_
    ParallelFor(level_.facades.size(), setting_.threads,
                [&](size_t i) { removed[i] = RedundantViews(level_.facades[i]); });
    ++step_;
    int count = 0;
    for (size_t i = 0; i < removed.size(); ++i) {
      for (const int k : removed[i]) {
        const User& user = users_[level_.facades[i]][k];
        MarkChanged(points_[user.point], step_);  // its cost changes too
        points_[user.point].views[user.view].seen.clear();
        ++count;
      }
    }
    if (count == 0) return 0;
    for (DippingPoint& point : points_) {
      std::erase_if(point.views, [](const WallView& view) { return view.seen.empty(); });
    }
    DropEmptyPoints();
    CollectUsers();
    return count;
  }

  void DropEmptyPoints() {
    size_t kept = 0;
    for (size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].views.empty()) continue;
      if (kept != i) {
        points_[kept] = std::move(points_[i]);
        states_[kept] = std::move(states_[i]);
      }
      ++kept;
    }
    points_.resize(kept);
    states_.resize(kept);
  }

  std::vector<int> RedundantViews(int facade) const {
    const std::vector<User>& users = users_[facade];
    std::vector<double> scores;
    for (const User& user : users) {
      const DippingPoint& point = points_[user.point];
      scores.push_back(ScoreOf(setting_, point.position, point.views[user.view]));
    }
    std::vector<int> order(users.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return scores[a] < scores[b]; });
    std::vector<char> gone(users.size(), 0);
    std::vector<int> removed;
    for (const int k : order) {
      Intervals others;
      for (size_t i = 0; i < users.size(); ++i) {
        if (gone[i] || static_cast<int>(i) == k) continue;
        const Intervals& seen = points_[users[i].point].views[users[i].view].seen;
        others.insert(others.end(), seen.begin(), seen.end());
      }
      const WallView& view = points_[users[k].point].views[users[k].view];
      if (Difference(view.seen, Union(std::move(others))).empty()) {
        gone[k] = 1;
        removed.push_back(k);
      }
    }
    return removed;
  }

  const Level& level_;
  const DippingSetting& setting_;
  std::vector<double>& turns_;
  std::vector<DippingPoint>& points_;
  std::vector<std::vector<User>> users_;  // by facade
  // Steps are numbered, so that only what has changed is looked at again.
  struct PointState {
    std::vector<SeenFacade> visible;  // as in Place
    int looked_at = 0;                // its place
  };
  int step_ = 0;
  std::vector<PointState> states_;  // by point
  std::vector<int> changed_at_;     // by facade
  std::vector<int> looked_at_;      // by facade: its direction
};

}  // namespace

OptimiseReport OptimiseViews(const Level& level, const DippingSetting& setting,
                             std::vector<double>& turns, std::vector<DippingPoint>& points) {
  return Optimiser(level, setting, turns, points).Run();
}

}  // namespace stucco::plan
