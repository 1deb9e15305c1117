// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/needless_links.h"

#include <algorithm>
#include <utility>

#include "survey/parallel.h"

namespace stucco::plan {
namespace {

class Weeding {
 public:
  explicit Weeding(const LinkedPhotos& photos);

  // Whether no photo would lack more without this one.
  bool MayGo(uint32_t link) const;
  void Drop(uint32_t link) { gone_[link] = 1; }
  // Puts photos back until what is left hangs together as before.
  void Mend();
  std::vector<uint32_t> Gone() const;

 private:
  size_t StrongOf(uint32_t photo) const;
  int CloseOf(uint32_t photo, uint32_t without) const;
  Connectivity WholeOfRest() const;

  const LinkedPhotos& photos_;
  // By photo of a facade: all that are near in direction and scale, wherever they stand.
  std::vector<std::vector<uint32_t>> close_;
  std::vector<std::vector<uint32_t>> asking_;  // by photo: those it is close to
  std::vector<uint8_t> gone_;
};

Weeding::Weeding(const LinkedPhotos& photos)
    : photos_(photos), close_(photos.size()), asking_(photos.size()), gone_(photos.size(), 0) {
  ParallelFor(photos.size(), photos.threads(), [&](size_t i) {
    const auto photo = static_cast<uint32_t>(i);
    if (!IsOfFacade(photos.ShotOf(photo))) return;
    for (const Partner& partner : photos.graph().PartnersOf(photo)) {
      if (partner.close_walls >= kCloseShare) close_[i].push_back(partner.photo);
    }
  });
  for (uint32_t photo = 0; photo < close_.size(); ++photo) {
    for (const uint32_t other : close_[photo]) asking_[other].push_back(photo);
  }
}

size_t Weeding::StrongOf(uint32_t photo) const {
  return std::ranges::count_if(photos_.ties()[photo].strong,
                               [&](const Partner& partner) { return !gone_[partner.photo]; });
}

// Close partners that stand apart, up to as many as are asked.
int Weeding::CloseOf(uint32_t photo, uint32_t without) const {
  Ties ties;
  for (const uint32_t other : close_[photo]) {
    if (gone_[other] || other == without) continue;
    if (!StandsApart(photos_.graph(), ties, photos_.graph().position(other))) continue;
    ties.close.push_back(other);
    if (ties.close.size() == kFewestClose) break;
  }
  return static_cast<int>(ties.close.size());
}

bool Weeding::MayGo(uint32_t link) const {
  for (const Partner& partner : photos_.ties()[link].strong) {
    if (!gone_[partner.photo] && StrongOf(partner.photo) <= kFewestPartners) return false;
  }
  return std::ranges::all_of(asking_[link], [&](uint32_t photo) {
    return CloseOf(photo, link) >= CloseOf(photo, static_cast<uint32_t>(photos_.size()));
  });
}

Connectivity Weeding::WholeOfRest() const {
  std::vector<Ties> ties(photos_.size());
  for (uint32_t photo = 0; photo < ties.size(); ++photo) {
    if (gone_[photo]) continue;
    std::ranges::copy_if(photos_.ties()[photo].strong, std::back_inserter(ties[photo].strong),
                         [&](const Partner& partner) { return !gone_[partner.photo]; });
  }
  return ConnectivityOf(ties);
}

void Weeding::Mend() {
  const int before = ConnectivityOf(photos_.ties()).blocks;
  for (;;) {
    const Connectivity whole = WholeOfRest();
    if (whole.blocks - std::ranges::count(gone_, 1) <= before) return;
    std::vector<int> sizes(whole.blocks);
    for (const int block : whole.block) ++sizes[block];
    const auto main = std::ranges::max_element(sizes) - sizes.begin();
    std::vector<uint32_t> back;
    for (uint32_t photo = 0; photo < gone_.size(); ++photo) {
      if (gone_[photo] || whole.block[photo] == main) continue;
      for (const Partner& partner : photos_.ties()[photo].strong) {
        if (gone_[partner.photo]) back.push_back(partner.photo);
      }
    }
    if (back.empty()) {
      std::ranges::fill(gone_, 0);
      return;
    }
    for (const uint32_t photo : back) gone_[photo] = 0;
  }
}

std::vector<uint32_t> Weeding::Gone() const {
  std::vector<uint32_t> out;
  for (uint32_t photo = 0; photo < gone_.size(); ++photo) {
    if (gone_[photo]) out.push_back(photo);
  }
  return out;
}

// Those of the stops with the fewest photos first, later ones before earlier ones.
std::vector<uint32_t> LinksInTurn(const LinkedPhotos& photos) {
  std::vector<uint32_t> out;
  for (auto photo = static_cast<uint32_t>(photos.size()); photo-- > 0;) {
    if (photos.ShotOf(photo).kind == ViewKind::kLink) out.push_back(photo);
  }
  std::ranges::stable_sort(
      out, {}, [&](uint32_t photo) { return photos.hovers()[photos.HoverOf(photo)].shots.size(); });
  return out;
}

}  // namespace

std::vector<uint32_t> NeedlessLinks(const LinkedPhotos& photos) {
  Weeding weeding(photos);
  for (const uint32_t link : LinksInTurn(photos)) {
    if (weeding.MayGo(link)) weeding.Drop(link);
  }
  weeding.Mend();
  return weeding.Gone();
}

void DropLinks(std::span<const uint32_t> links, const LinkedPhotos& photos,
               std::vector<Hover>& hovers) {
  std::vector<std::vector<uint32_t>> shots(hovers.size());
  for (const uint32_t link : links)
    shots[photos.HoverOf(link)].push_back(photos.PlaceOf(link).shot);
  for (size_t h = 0; h < hovers.size(); ++h) {
    std::ranges::sort(shots[h], std::ranges::greater{});
    for (const uint32_t shot : shots[h]) hovers[h].shots.erase(hovers[h].shots.begin() + shot);
  }
  std::erase_if(hovers, [](const Hover& hover) { return hover.shots.empty(); });
}

}  // namespace stucco::plan
