// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/evaluate/evaluate_facades.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "survey/parallel.h"

namespace stucco::plan {
namespace {

// A cell belongs to a target when its centre is inside, with this much slack for rounding.
constexpr double kSlack_m = 1e-6;

bool Holds(const Interval& interval, const Interval& cell) {
  const double center = 0.5 * (cell.from_m + cell.to_m);
  return center >= interval.from_m - kSlack_m && center <= interval.to_m + kSlack_m;
}

bool Holds(const Target& target, const FacadeGrid& grid, uint32_t cell) {
  if (!(target.along_m.length_m() > 0) && !(target.z_m.length_m() > 0)) return true;
  return Holds(target.along_m, grid.Along(cell)) && Holds(target.z_m, grid.Heights(cell));
}

// Cells of the facade that some photo shows.
class Coverage {
 public:
  explicit Coverage(size_t cells) : covered_(cells) {}

  void Add(std::span<const uint32_t> cells) {
    for (const uint32_t cell : cells) {
      count_ += !covered_[cell];
      covered_[cell] = 1;
    }
  }
  std::vector<uint32_t> NewOf(std::span<const uint32_t> cells) const {
    std::vector<uint32_t> out;
    for (const uint32_t cell : cells) {
      if (!covered_[cell]) out.push_back(cell);
    }
    return out;
  }
  double share() const {
    return static_cast<double>(count_) / static_cast<double>(covered_.size());
  }

 private:
  std::vector<uint8_t> covered_;
  size_t count_ = 0;
};

struct Assignment {
  int hover;
  int shot;
  Target target;
};

// A target never takes the place of one the photo has: a photo with a target on the facade is out.
bool HasTargetOn(const Shot& shot, int facade) {
  return std::ranges::any_of(shot.targets, [&](const Target& t) { return t.facade == facade; });
}

std::vector<Assignment> AssignFacade(const FacadeSight& sight, int facade) {
  const std::vector<SeenView> views = sight.ViewsOf(facade);
  const FacadeGrid& grid = sight.grid(facade);
  Coverage coverage(grid.size());
  struct Candidate {
    double gain;
    size_t view;
    bool operator<(const Candidate& other) const {
      return gain != other.gain ? gain < other.gain : view > other.view;
    }
  };
  std::priority_queue<Candidate> queue;
  std::vector<double> scores(views.size());
  for (size_t i = 0; i < views.size(); ++i) {
    const SeenView& view = views[i];
    if (HasTargetOn(sight.hovers()[view.place].shots[view.picture], facade)) {
      coverage.Add(MeantCells(sight, facade, view));
      continue;
    }
    scores[i] = sight.ScoreOf(facade, sight.PartOf(facade, view, view.cells));
    queue.push({scores[i] * static_cast<double>(view.cells.size()), i});
  }
  // What a view newly covers only shrinks, so a gain that was computed earlier is a bound.
  std::vector<Assignment> out;
  while (!queue.empty()) {
    const size_t i = queue.top().view;
    queue.pop();
    const std::vector<uint32_t> added = coverage.NewOf(views[i].cells);
    if (added.empty()) continue;
    const Candidate now{scores[i] * static_cast<double>(added.size()), i};
    if (!queue.empty() && now < queue.top()) {
      queue.push(now);
      continue;
    }
    coverage.Add(added);
    out.push_back({views[i].place, views[i].picture, BoxAround(grid, facade, added)});
  }
  return out;
}

FacadeReport ReportOn(const FacadeSight& sight, int facade) {
  const FacadeGrid& grid = sight.grid(facade);
  FacadeReport out;
  std::vector<SeenPart> meant, all;
  Coverage by_meant(grid.size()), by_all(grid.size());
  for (const SeenView& view : sight.ViewsOf(facade)) {
    all.push_back(sight.PartOf(facade, view, view.cells));
    by_all.Add(view.cells);
    const std::vector<uint32_t> cells = MeantCells(sight, facade, view);
    if (cells.empty()) continue;
    meant.push_back(sight.PartOf(facade, view, cells));
    by_meant.Add(cells);
  }
  const double d_min = sight.site().d_min_m;
  out.views = static_cast<int>(meant.size());
  out.covered = by_meant.share();
  out.meant = QualityOfFacade(meant, out.covered, d_min, sight.d_max_m());
  out.covered_all = by_all.share();
  out.all = QualityOfFacade(all, out.covered_all, d_min, sight.d_max_m());
  return out;
}

}  // namespace

std::vector<uint32_t> MeantCells(const FacadeSight& sight, int facade, const SeenView& view) {
  std::vector<const Target*> targets;
  for (const Target& target : sight.hovers()[view.place].shots[view.picture].targets) {
    if (target.facade == facade) targets.push_back(&target);
  }
  std::vector<uint32_t> out;
  if (targets.empty()) return out;
  for (const uint32_t cell : view.cells) {
    if (std::ranges::any_of(targets, [&](const Target* target) {
          return Holds(*target, sight.grid(facade), cell);
        })) {
      out.push_back(cell);
    }
  }
  return out;
}

void AssignViews(const Site& site, const CameraPreset& camera, double d_max_m,
                 std::vector<Hover>& hovers, int threads) {
  std::vector<std::vector<Assignment>> assignments(site.facades.size());
  const FacadeSight sight(site, camera, d_max_m, hovers);
  ParallelFor(assignments.size(), threads, [&](size_t facade) {
    assignments[facade] = AssignFacade(sight, static_cast<int>(facade));
  });
  for (const auto& of_facade : assignments) {
    for (const Assignment& a : of_facade) {
      hovers[a.hover].shots[a.shot].targets.push_back(a.target);
    }
  }
}

std::vector<FacadeReport> EvaluateFacades(const Site& site, const CameraPreset& camera,
                                          double d_max_m, std::span<const Hover> hovers,
                                          int threads) {
  std::vector<FacadeReport> out(site.facades.size());
  const FacadeSight sight(site, camera, d_max_m, hovers);
  ParallelFor(out.size(), threads,
              [&](size_t facade) { out[facade] = ReportOn(sight, static_cast<int>(facade)); });
  return out;
}

}  // namespace stucco::plan
