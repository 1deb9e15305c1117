// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/facade_cover.h"

#include <algorithm>
#include <iterator>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "plan/match/cover_stops.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

// Stops that are looked from at the same time; more would be looked from in vain.
constexpr size_t kBatch = 16;

// What a stop is worth, with the photos that make it so.
struct Worth {
  double score = 0;           // partners given for what they cost
  std::vector<size_t> shots;  // of the stop
};

struct Queued {
  double score;  // at most so much
  uint32_t stop;
  bool operator<(const Queued& other) const {
    return score != other.score ? score < other.score : stop > other.stop;
  }
};

class Cover {
 public:
  Cover(const Obstacles& obstacles, LinkedPhotos& photos);

  // Takes the best stop; false where none serves any.
  bool TakeBest();

 private:
  bool Lacks(uint32_t photo, const CoverStop& stop) const {
    return photos_.LacksClose(photo) > 0 && photos_.StandsApartFrom(photo, stop.position);
  }
  std::vector<uint32_t> GainsOf(const CoverStop& stop, const CoverShot& one,
                                const std::vector<uint32_t>& served) const;
  bool IsNew(const CoverStop& stop, const Shot& shot, std::span<const size_t> shots) const;
  double BoundOf(const CoverStop& stop) const;
  Worth WorthOf(const CoverStop& stop) const;
  double ScoreOf(uint32_t stop) const {
    return looked_[stop] ? WorthOf(stops_[stop]).score : BoundOf(stops_[stop]);
  }
  void Push(uint32_t stop) {
    const double score = ScoreOf(stop);
    if (score > 0) queue_.push({score, stop});
  }
  // The stop on top, if it is worth what the queue says; else puts it back.
  bool IsBest(const Queued& top);
  void LookFromNext();
  void Take(uint32_t number);

  LinkedPhotos& photos_;
  std::vector<CoverStop> stops_;
  std::vector<uint8_t> looked_;  // from this stop
  std::priority_queue<Queued> queue_;
};

Cover::Cover(const Obstacles& obstacles, LinkedPhotos& photos)
    : photos_(photos), stops_(CoverStops(obstacles, photos)), looked_(stops_.size(), 0) {
  for (uint32_t stop = 0; stop < stops_.size(); ++stop) Push(stop);
}

// One photo for all that the stop is near to.
double Cover::BoundOf(const CoverStop& stop) const {
  const auto served =
      std::ranges::count_if(stop.within, [&](uint32_t photo) { return Lacks(photo, stop); });
  return static_cast<double>(served) / LinkCost(stop.place);
}

// Of the photos that a shot serves, those that lack it and have nothing from this stop yet.
std::vector<uint32_t> Cover::GainsOf(const CoverStop& stop, const CoverShot& one,
                                     const std::vector<uint32_t>& served) const {
  std::vector<uint32_t> gains;
  std::ranges::copy_if(one.served, std::back_inserter(gains), [&](uint32_t photo) {
    return std::ranges::find(served, photo) == served.end() && Lacks(photo, stop);
  });
  return gains;
}

// The stop would take no photo twice.
bool Cover::IsNew(const CoverStop& stop, const Shot& shot, std::span<const size_t> shots) const {
  if (stop.place == LinkPlace::kHover && HasLinkLike(photos_.hovers()[stop.hover], shot)) {
    return false;
  }
  return std::ranges::none_of(shots,
                              [&](size_t k) { return LooksAlike(stop.shots[k].shot, shot); });
}

// The photo that adds most, then the next, as long as that makes the stop worth more.
Worth Cover::WorthOf(const CoverStop& stop) const {
  Worth best;
  std::vector<uint32_t> served;
  std::vector<size_t> shots;
  for (double cost = LinkCost(stop.place);; ++cost) {
    size_t next = 0;
    std::vector<uint32_t> gained;
    for (size_t i = 0; i < stop.shots.size(); ++i) {
      if (!IsNew(stop, stop.shots[i].shot, shots)) continue;
      std::vector<uint32_t> gains = GainsOf(stop, stop.shots[i], served);
      if (gains.size() <= gained.size()) continue;
      gained = std::move(gains);
      next = i;
    }
    if (gained.empty()) return best;
    shots.push_back(next);
    served.insert(served.end(), gained.begin(), gained.end());
    const double score = static_cast<double>(served.size()) / cost;
    if (score <= best.score) return best;
    best = {score, shots};
  }
}

bool Cover::IsBest(const Queued& top) {
  const double score = ScoreOf(top.stop);
  if (!(score > 0)) return false;
  if (!queue_.empty() && Queued{score, top.stop} < queue_.top()) {
    queue_.push({score, top.stop});
    return false;
  }
  return true;
}

// From those that may be best and nobody has looked from.
void Cover::LookFromNext() {
  std::vector<uint32_t> next;
  while (!queue_.empty() && next.size() < kBatch && !looked_[queue_.top().stop]) {
    next.push_back(queue_.top().stop);
    queue_.pop();
  }
  ParallelFor(next.size(), photos_.threads(),
              [&](size_t i) { stops_[next[i]].shots = CoverShots(photos_, stops_[next[i]]); });
  for (const uint32_t stop : next) {
    looked_[stop] = 1;
    Push(stop);
  }
}

void Cover::Take(uint32_t number) {
  CoverStop& stop = stops_[number];
  for (const size_t shot : WorthOf(stop).shots) {
    stop.hover = photos_.Add({stop.position, stop.shots[shot].shot, stop.place, stop.hover});
    stop.place = LinkPlace::kHover;
  }
  Push(number);
}

bool Cover::TakeBest() {
  while (!queue_.empty()) {
    const Queued top = queue_.top();
    queue_.pop();
    if (!IsBest(top)) continue;
    if (looked_[top.stop]) {
      Take(top.stop);
      return true;
    }
    queue_.push(top);
    LookFromNext();
  }
  return false;
}

}  // namespace

void CoverFacades(const Obstacles& obstacles, LinkedPhotos& photos, Progress& progress) {
  Cover cover(obstacles, photos);
  do {
    if (progress.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
  } while (cover.TakeBest());
}

}  // namespace stucco::plan
