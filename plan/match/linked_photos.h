// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/match/link_candidates.h"
#include "plan/match/photo_graph.h"
#include "plan/match/ties.h"

namespace stucco::plan {

// Photos of a stop that differ by less in direction are one and the same.
inline constexpr double kSameLook_rad = 0.2618;  // 15 degrees
bool LooksAlike(const Shot& one, const Shot& other);
// The stop has a link photo already that looks that way, or nearly.
bool HasLinkLike(const Hover& hover, const Shot& shot);

// Hovers with what ties their photos to each other, kept up to date while links come.
class LinkedPhotos {
 public:
  // `hovers` gains shots and, at its end, hovers. Keeps references to all.
  LinkedPhotos(const MatchSetting& setting, std::vector<Hover>& hovers);

  size_t size() const { return photos_.graph.size(); }
  int threads() const { return threads_; }
  std::span<const Hover> hovers() const { return hovers_; }
  const MatchGraph& graph() const { return photos_.graph; }
  std::span<const Segment2d> corridors() const { return photos_.corridors; }
  double half_width() const { return photos_.view.field.half_width; }  // of photos at a depth of 1
  const std::vector<Ties>& ties() const { return ties_; }              // by photo
  std::span<const PhotoPlace> places() const { return photos_.places; }  // by photo
  const PhotoPlace& PlaceOf(uint32_t photo) const { return photos_.places[photo]; }
  uint32_t HoverOf(uint32_t photo) const { return PlaceOf(photo).hover; }
  const Shot& ShotOf(uint32_t photo) const {
    return hovers_[HoverOf(photo)].shots[PlaceOf(photo).shot];
  }
  Gaze GazeOf(uint32_t photo, bool walls_only) const {
    return plan::GazeOf(photos_.view, photos_.graph.sights(photo), walls_only);
  }
  std::vector<Sight> SightsFrom(const Eigen::Vector3d& position, const Shot& shot) const {
    return SightsOf(photos_.view, photos_.patch_m2, position, shot);
  }

  int LacksClose(uint32_t photo) const { return LackingClose(ties_[photo], ShotOf(photo)); }
  int LacksPartners(uint32_t photo) const { return LackingPartners(ties_[photo]); }
  // A photo with these sights shows the walls of this one from near in direction and scale.
  bool IsCloseTo(uint32_t photo, std::span<const Sight> sights) const;
  // A photo from there would be a close partner besides those that this one has.
  bool StandsApartFrom(uint32_t photo, const Eigen::Vector3d& position) const {
    return StandsApart(photos_.graph, ties_[photo], position);
  }

  // Returns the hover that takes the photo: that of the candidate, where it is one, else a new one.
  int Add(const LinkCandidate& link);

 private:
  std::vector<uint32_t> ServedClose(const Eigen::Vector3d& position,
                                    std::span<const Sight> sights) const;

  std::vector<Hover>& hovers_;
  int threads_;
  PhotoGraph photos_;
  std::vector<Ties> ties_;  // by photo
};

}  // namespace stucco::plan
