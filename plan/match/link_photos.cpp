// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/link_photos.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "plan/match/link_candidates.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

// What a link photo costs, in photos: a stop in passing, and one that the drone makes for it.
constexpr double kColumnCost = 1.5;
constexpr double kStopCost = 3;
// Of two that serve alike, the one that others match best: strengths that add up to this are all
// that counts.
constexpr float kEnoughAnchor = 0.3F;
constexpr double kAnchorWeight = 0.5;
// A part that no photo ties to the rest after so many tries stays loose.
constexpr int kMostTries = 4;

// Of the walls in the photo that asks, what another shows near in direction and scale.
float CloseWalls(const SurfaceView& view, std::span<const Sight> asking,
                 std::span<const Sight> other) {
  float walls = 0, close = 0;
  auto at = other.begin();
  for (const Sight& own : asking) {
    if (view.samples[own.sample].kind != SurfaceKind::kWall) continue;
    walls += own.share;
    while (at != other.end() && at->sample < own.sample) ++at;
    if (at == other.end()) continue;
    if (at->sample == own.sample && IsClose(own, *at)) close += own.share;
  }
  return walls > 0 ? close / walls : 0;
}

// A candidate as the graph sees it.
struct Assessed {
  LinkCandidate candidate;
  std::vector<Sight> sights;
  std::vector<Partner> partners;  // of the best only
  double served = 0;              // photos
};

class Linker {
 public:
  Linker(const MatchSetting& setting, const Obstacles& obstacles, std::vector<Hover>& hovers,
         Progress& progress);

  void ServeFacadePhotos();
  void ServeLonePhotos();
  void TieParts();
  const LinkReport& report() const { return report_; }

 private:
  const Shot& ShotOf(uint32_t photo) const {
    return hovers_[photos_.places[photo].hover].shots[photos_.places[photo].shot];
  }
  int LacksClose(uint32_t photo) const { return LackingClose(ties_[photo], ShotOf(photo)); }
  int LacksPartners(uint32_t photo) const { return LackingPartners(ties_[photo]); }
  template <typename Served>
  std::optional<Assessed> Best(const Gaze& gaze, uint32_t photo, const Served& served) const;
  Gaze GazeOf(uint32_t photo, bool walls_only) const {
    return plan::GazeOf(photos_.view, photos_.graph.sights(photo), walls_only);
  }
  bool IsStrong(uint32_t photo, const Assessed& link) const {
    return photos_.graph.StrengthBetween(photo, link.sights) >= kEnoughStrength;
  }
  bool IsCloseTo(uint32_t photo, std::span<const Sight> link) const {
    return CloseWalls(photos_.view, photos_.graph.sights(photo), link) >= kCloseShare;
  }
  std::vector<uint32_t> ServedClose(const Assessed& link) const;
  int ServedLone(const Assessed& link) const;
  bool ServeLone(uint32_t photo);
  bool Tie(const Connectivity& whole, int block);
  void Add(Assessed link);
  void ThrowIfCancelled() const {
    if (progress_.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
  }

  const Obstacles& obstacles_;
  std::vector<Hover>& hovers_;
  Progress& progress_;
  int threads_;
  PhotoGraph photos_;
  std::vector<Ties> ties_;  // by photo
  LinkReport report_;
};

Linker::Linker(const MatchSetting& setting, const Obstacles& obstacles, std::vector<Hover>& hovers,
               Progress& progress)
    : obstacles_(obstacles),
      hovers_(hovers),
      progress_(progress),
      threads_(setting.threads),
      photos_(setting, hovers),
      ties_(TiesOf(photos_, hovers, setting.threads)) {}

double CostOf(LinkPlace place) {
  if (place == LinkPlace::kHover) return 1;
  return place == LinkPlace::kColumn ? kColumnCost : kStopCost;
}

// Photos served for what a link costs, where it has all the anchor that counts.
double MostOf(const Assessed& link) {
  return (link.served + kAnchorWeight) / CostOf(link.candidate.place);
}

double ScoreOf(const Assessed& link) {
  float anchor = 0;
  for (const Partner& partner : link.partners) anchor += partner.strength;
  return (link.served + kAnchorWeight * std::min(1.0F, anchor / kEnoughAnchor)) /
         CostOf(link.candidate.place);
}

// Of the candidates for a photo, the one that serves the most for what it costs, by what it sees
// and where it stands; none where none serves any. Finding a candidate's partners takes the longest
// by far, so that those come first that may be best.
template <typename Served>
std::optional<Assessed> Linker::Best(const Gaze& gaze, uint32_t photo, const Served& served) const {
  const auto candidates =
      LinkCandidates(gaze, obstacles_, hovers_, static_cast<int>(photos_.places[photo].hover));
  std::vector<Assessed> assessed(candidates.size());
  ParallelFor(candidates.size(), threads_, [&](size_t i) {
    Assessed& link = assessed[i];
    link.candidate = candidates[i];
    link.sights =
        SightsOf(photos_.view, photos_.patch_m2, link.candidate.position, link.candidate.shot);
    link.served = served(link);
  });
  std::erase_if(assessed, [](const Assessed& link) { return !(link.served > 0); });
  std::ranges::stable_sort(assessed, std::ranges::greater{}, MostOf);
  Assessed* best = nullptr;
  for (Assessed& link : assessed) {
    if (best != nullptr && MostOf(link) <= ScoreOf(*best)) break;
    link.partners = photos_.graph.PartnersOf(link.candidate.position, link.sights);
    if (best == nullptr || ScoreOf(link) > ScoreOf(*best)) best = &link;
  }
  return best == nullptr ? std::nullopt : std::optional(std::move(*best));
}

// The photos of facades that lack what this one would be.
std::vector<uint32_t> Linker::ServedClose(const Assessed& link) const {
  std::vector<uint32_t> out = photos_.graph.PhotosThatShow(
      link.candidate.position, link.sights, [&](uint32_t photo) { return LacksClose(photo) > 0; });
  std::erase_if(out, [&](uint32_t photo) {
    return !StandsApart(photos_.graph, ties_[photo], link.candidate.position) ||
           !IsCloseTo(photo, link.sights);
  });
  return out;
}

// How many photos that lack partners get one.
int Linker::ServedLone(const Assessed& link) const {
  return static_cast<int>(std::ranges::count_if(
      photos_.graph.PhotosThatShow(link.candidate.position, link.sights,
                                   [&](uint32_t photo) { return LacksPartners(photo) > 0; }),
      [&](uint32_t photo) { return IsStrong(photo, link); }));
}

void Linker::Add(Assessed link) {
  for (const uint32_t photo : ServedClose(link)) {
    ties_[photo].close.push_back(static_cast<uint32_t>(photos_.graph.size()));
  }
  int hover = link.candidate.hover;
  if (link.candidate.place != LinkPlace::kHover) {
    hover = static_cast<int>(hovers_.size());
    hovers_.push_back({link.candidate.position, {}});
    ++report_.stops;
  }
  hovers_[hover].shots.push_back(link.candidate.shot);
  photos_.places.push_back(
      {static_cast<uint32_t>(hover), static_cast<uint32_t>(hovers_[hover].shots.size() - 1)});
  const uint32_t self = photos_.graph.Add(link.candidate.position, std::move(link.sights));
  ties_.emplace_back();
  for (const Partner& partner : link.partners) {
    if (partner.strength < kEnoughStrength) continue;
    ties_[self].strong.push_back(partner);
    ties_[partner.photo].strong.push_back({self, partner.strength, 0});
  }
  ++report_.photos;
}

void Linker::ServeFacadePhotos() {
  const auto count = static_cast<uint32_t>(photos_.graph.size());
  progress_.Begin("links of facade photos", count);
  for (uint32_t photo = 0; photo < count; ++photo) {
    ThrowIfCancelled();
    while (LacksClose(photo) > 0) {
      auto link = Best(GazeOf(photo, true), photo, [&](const Assessed& candidate) {
        if (!IsCloseTo(photo, candidate.sights)) return 0.0;
        const std::vector<uint32_t> served = ServedClose(candidate);
        const bool serves_it = std::ranges::find(served, photo) != served.end();
        return serves_it ? static_cast<double>(served.size()) : 0.0;
      });
      if (!link) break;
      Add(std::move(*link));
    }
    progress_.Advance();
  }
}

// Adds a partner for a photo that lacks one, if there is one.
bool Linker::ServeLone(uint32_t photo) {
  auto link = Best(GazeOf(photo, false), photo, [&](const Assessed& candidate) {
    return IsStrong(photo, candidate) ? ServedLone(candidate) : 0.0;
  });
  if (!link) return false;
  Add(std::move(*link));
  return true;
}

void Linker::ServeLonePhotos() {
  for (uint32_t photo = 0; photo < photos_.graph.size(); ++photo) {
    ThrowIfCancelled();
    for (int tries = 0; tries < kMostTries && LacksPartners(photo) > 0; ++tries) {
      if (!ServeLone(photo)) break;
    }
  }
}

// Adds a photo that ties a block to the rest, if there is one.
bool Linker::Tie(const Connectivity& whole, int block) {
  for (uint32_t photo = 0; photo < whole.block.size(); ++photo) {
    if (whole.block[photo] != block) continue;
    auto link = Best(GazeOf(photo, false), photo, [&](const Assessed& candidate) {
      int inside = 0, outside = 0;
      for (const Partner& partner :
           photos_.graph.PartnersOf(candidate.candidate.position, candidate.sights)) {
        if (partner.strength < kEnoughStrength) continue;
        const bool is_inside =
            partner.photo < whole.block.size() && whole.block[partner.photo] == block;
        ++(is_inside ? inside : outside);
      }
      return inside > 0 && outside > 0 ? std::min(2, outside) : 0.0;
    });
    if (!link) continue;
    Add(std::move(*link));
    return true;
  }
  return false;
}

void Linker::TieParts() {
  for (int tries = 0;; ++tries) {
    ThrowIfCancelled();
    const Connectivity whole = ConnectivityOf(ties_);
    if (whole.blocks <= 1) return;
    std::vector<int> sizes(whole.blocks);
    for (const int block : whole.block) ++sizes[block];
    const int main = static_cast<int>(std::ranges::max_element(sizes) - sizes.begin());
    bool tied = false;
    for (int block = 0; block < whole.blocks; ++block) {
      if (block != main) tied |= Tie(whole, block);
    }
    if (!tied || tries == kMostTries) return;
  }
}

}  // namespace

LinkReport AddLinkPhotos(const MatchSetting& setting, const Obstacles& obstacles,
                         std::vector<Hover>& hovers, Progress& progress) {
  Linker linker(setting, obstacles, hovers, progress);
  linker.ServeFacadePhotos();
  linker.ServeLonePhotos();
  linker.TieParts();
  return linker.report();
}

}  // namespace stucco::plan
