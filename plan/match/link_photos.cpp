// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/link_photos.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "plan/match/facade_cover.h"
#include "plan/match/link_candidates.h"
#include "plan/match/link_chains.h"
#include "plan/match/linked_photos.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

// Of two that serve alike, the one that others match best: strengths that add up to this are all
// that counts.
constexpr float kEnoughAnchor = 0.3F;
constexpr double kAnchorWeight = 0.5;
// A part that no photo ties to the rest after so many tries stays loose.
constexpr int kMostTries = 4;

// A candidate as the graph sees it.
struct Assessed {
  LinkCandidate candidate;
  std::vector<Sight> sights;
  std::vector<Partner> partners;  // of the best only
  double served = 0;              // photos
};

class Linker {
 public:
  Linker(const Obstacles& obstacles, LinkedPhotos& photos, Progress& progress)
      : obstacles_(obstacles), photos_(photos), progress_(progress) {}

  void ServeLonePhotos();
  void TieParts();

 private:
  template <typename Served>
  std::optional<LinkCandidate> Best(uint32_t photo, const Served& served) const;
  bool IsStrong(uint32_t photo, const Assessed& link) const {
    return photos_.graph().StrengthBetween(photo, link.sights) >= kEnoughStrength;
  }
  int ServedLone(const Assessed& link) const;
  bool ServeLone(uint32_t photo);
  int CountTies(const Assessed& link, const LooseGroup& group) const;
  std::vector<uint32_t> PhotosToTie(const LooseGroup& group) const;
  bool Tie(const LooseGroup& group);
  void ThrowIfCancelled() const {
    if (progress_.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
  }

  const Obstacles& obstacles_;
  LinkedPhotos& photos_;
  Progress& progress_;
};

// Photos served for what a link costs, where it has all the anchor that counts.
double MostOf(const Assessed& link) {
  return (link.served + kAnchorWeight) / LinkCost(link.candidate.place);
}

double ScoreOf(const Assessed& link) {
  float anchor = 0;
  for (const Partner& partner : link.partners) anchor += partner.strength;
  return (link.served + kAnchorWeight * std::min(1.0F, anchor / kEnoughAnchor)) /
         LinkCost(link.candidate.place);
}

// Of the candidates for a photo, the one that serves the most for what it costs, by what it sees
// and where it stands; none where none serves any. Finding a candidate's partners takes the longest
// by far, so that those come first that may be best.
template <typename Served>
std::optional<LinkCandidate> Linker::Best(uint32_t photo, const Served& served) const {
  auto candidates = LinkCandidates(photos_.GazeOf(photo, false), obstacles_, photos_.hovers(),
                                   static_cast<int>(photos_.HoverOf(photo)));
  std::erase_if(candidates, [&](const LinkCandidate& one) {
    return one.place == LinkPlace::kHover && HasLinkLike(photos_.hovers()[one.hover], one.shot);
  });
  std::vector<Assessed> assessed(candidates.size());
  ParallelFor(candidates.size(), photos_.threads(), [&](size_t i) {
    Assessed& link = assessed[i];
    link.candidate = candidates[i];
    link.sights = photos_.SightsFrom(link.candidate.position, link.candidate.shot);
    link.served = served(link);
  });
  std::erase_if(assessed, [](const Assessed& link) { return !(link.served > 0); });
  std::ranges::stable_sort(assessed, std::ranges::greater{}, MostOf);
  Assessed* best = nullptr;
  for (Assessed& link : assessed) {
    if (best != nullptr && MostOf(link) <= ScoreOf(*best)) break;
    link.partners = photos_.graph().PartnersOf(link.candidate.position, link.sights);
    if (best == nullptr || ScoreOf(link) > ScoreOf(*best)) best = &link;
  }
  return best == nullptr ? std::nullopt : std::optional(best->candidate);
}

// How many photos that lack partners get one.
int Linker::ServedLone(const Assessed& link) const {
  return static_cast<int>(
      std::ranges::count_if(photos_.graph().PhotosThatShow(
                                link.candidate.position, link.sights,
                                [&](uint32_t photo) { return photos_.LacksPartners(photo) > 0; }),
                            [&](uint32_t photo) { return IsStrong(photo, link); }));
}

// Adds a partner for a photo that lacks one, if there is one.
bool Linker::ServeLone(uint32_t photo) {
  const auto link = Best(photo, [&](const Assessed& candidate) {
    return IsStrong(photo, candidate) ? ServedLone(candidate) : 0.0;
  });
  if (link) photos_.Add(*link);
  return link.has_value();
}

void Linker::ServeLonePhotos() {
  for (uint32_t photo = 0; photo < photos_.size(); ++photo) {
    ThrowIfCancelled();
    for (int tries = 0; tries < kMostTries && photos_.LacksPartners(photo) > 0; ++tries) {
      if (!ServeLone(photo)) break;
    }
  }
}

// How many photos of the group and of the rest, two of each at most, a photo there would match.
int Linker::CountTies(const Assessed& link, const LooseGroup& group) const {
  int inside = 0, outside = 0;
  for (const Partner& partner : photos_.graph().PartnersOf(link.candidate.position, link.sights)) {
    if (partner.strength < kEnoughStrength) continue;
    const int hover = static_cast<int>(photos_.HoverOf(partner.photo));
    if (hover != group.on) ++(group.Holds(partner.photo) ? inside : outside);
  }
  return inside > 0 && outside > 0 ? std::min(2, inside) + std::min(2, outside) : 0;
}

// The photos of a group, then those that it hangs on: what ties it may stand between.
std::vector<uint32_t> Linker::PhotosToTie(const LooseGroup& group) const {
  std::vector<uint32_t> out = group.photos;
  for (uint32_t photo = 0; photo < photos_.size(); ++photo) {
    if (static_cast<int>(photos_.HoverOf(photo)) == group.on) out.push_back(photo);
  }
  return out;
}

// Adds a photo that ties a group to the rest, if there is one.
bool Linker::Tie(const LooseGroup& group) {
  for (const uint32_t photo : PhotosToTie(group)) {
    const auto link = Best(photo, [&](const Assessed& one) {
      const LinkCandidate& candidate = one.candidate;
      const bool is_there = candidate.place == LinkPlace::kHover && candidate.hover == group.on;
      return is_there ? 0.0 : CountTies(one, group);
    });
    if (!link) continue;
    photos_.Add(*link);
    return true;
  }
  return false;
}

void Linker::TieParts() {
  for (int tries = 0; tries < kMostTries; ++tries) {
    ThrowIfCancelled();
    bool tied = false;
    const std::vector<LooseGroup> groups = LooseGroups(photos_.places(), photos_.ties());
    for (const LooseGroup& group : groups) tied |= Tie(group);
    if (!tied) return;
  }
}

bool IsLink(const Shot& shot) {
  return shot.kind == ViewKind::kLink;
}

LinkReport ReportOf(std::span<const Hover> hovers) {
  LinkReport report;
  for (const Hover& hover : hovers) {
    const auto links = std::ranges::count_if(hover.shots, IsLink);
    report.photos += static_cast<int>(links);
    report.stops += links > 0 && links == std::ssize(hover.shots);
  }
  return report;
}

}  // namespace

void LinkFacades(const MatchSetting& setting, const Obstacles& obstacles,
                 std::vector<Hover>& hovers, Progress& progress) {
  progress.Begin("links of facade photos", 1);
  LinkedPhotos photos(setting, hovers);
  CoverFacades(obstacles, photos, progress);
  progress.Advance();
}

LinkReport AddLinkPhotos(const MatchSetting& setting, const Obstacles& obstacles,
                         std::vector<Hover>& hovers, Progress& progress) {
  progress.Begin("links of all photos", 1);
  LinkedPhotos photos(setting, hovers);
  CoverFacades(obstacles, photos, progress);
  Linker linker(obstacles, photos, progress);
  linker.ServeLonePhotos();
  linker.TieParts();
  if (AddChains(obstacles, photos) > 0) linker.TieParts();
  progress.Advance();
  return ReportOf(hovers);
}

}  // namespace stucco::plan
