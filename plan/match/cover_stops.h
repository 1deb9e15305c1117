// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "plan/match/linked_photos.h"
#include "plan/space/obstacles.h"

namespace stucco::plan {

// A photo that a stop may take, and the photos of facades that it would be a close partner of.
struct CoverShot {
  Shot shot;
  std::vector<uint32_t> served;  // ascending
};

// A place from which link photos may be taken.
struct CoverStop {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  LinkPlace place = LinkPlace::kOwn;
  int hover = -1;  // of kHover and kColumn
  // Photos that lack partners, near in direction and scale, ascending.
  std::vector<uint32_t> within;
  std::vector<CoverShot> shots;  // what it may take; empty until looked from
};

// All places for photos of facades that lack close partners, by what they are near to; nobody has
// looked from them yet. Places of their own that lie within two metres of each other are one.
std::vector<CoverStop> CoverStops(const Obstacles& obstacles, const LinkedPhotos& photos);

// The photos towards what the stop is near to, those that look nearly the same way as one; of what
// each shows, which it serves.
std::vector<CoverShot> CoverShots(const LinkedPhotos& photos, const CoverStop& stop);

}  // namespace stucco::plan
