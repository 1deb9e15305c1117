// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/linked_photos.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stucco::plan {
namespace {

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

}  // namespace

bool LooksAlike(const Shot& one, const Shot& other) {
  static const double same = std::cos(kSameLook_rad);
  return one.Direction().dot(other.Direction()) > same;
}

bool HasLinkLike(const Hover& hover, const Shot& shot) {
  return std::ranges::any_of(hover.shots, [&](const Shot& other) {
    return other.kind == ViewKind::kLink && LooksAlike(other, shot);
  });
}

LinkedPhotos::LinkedPhotos(const MatchSetting& setting, std::vector<Hover>& hovers)
    : hovers_(hovers),
      threads_(setting.threads),
      photos_(setting, hovers),
      ties_(TiesOf(photos_, hovers, setting.threads)) {}

bool LinkedPhotos::IsCloseTo(uint32_t photo, std::span<const Sight> sights) const {
  return CloseWalls(photos_.view, photos_.graph.sights(photo), sights) >= kCloseShare;
}

// The photos of facades that lack what this one would be.
std::vector<uint32_t> LinkedPhotos::ServedClose(const Eigen::Vector3d& position,
                                                std::span<const Sight> sights) const {
  std::vector<uint32_t> out = photos_.graph.PhotosThatShow(
      position, sights, [&](uint32_t photo) { return LacksClose(photo) > 0; });
  std::erase_if(out, [&](uint32_t photo) {
    return !StandsApartFrom(photo, position) || !IsCloseTo(photo, sights);
  });
  return out;
}

int LinkedPhotos::Add(const LinkCandidate& link) {
  std::vector<Sight> sights = SightsFrom(link.position, link.shot);
  for (const uint32_t photo : ServedClose(link.position, sights)) {
    ties_[photo].close.push_back(static_cast<uint32_t>(size()));
  }
  int hover = link.hover;
  if (link.place != LinkPlace::kHover) {
    hover = static_cast<int>(hovers_.size());
    hovers_.push_back({link.position, {}});
  }
  hovers_[hover].shots.push_back(link.shot);
  photos_.places.push_back(
      {static_cast<uint32_t>(hover), static_cast<uint32_t>(hovers_[hover].shots.size() - 1)});
  const std::vector<Partner> partners = photos_.graph.PartnersOf(link.position, sights);
  const uint32_t self = photos_.graph.Add(link.position, std::move(sights));
  ties_.emplace_back();
  for (const Partner& partner : partners) {
    if (partner.strength < kEnoughStrength) continue;
    ties_[self].strong.push_back(partner);
    ties_[partner.photo].strong.push_back({self, partner.strength, 0});
  }
  return hover;
}

}  // namespace stucco::plan
