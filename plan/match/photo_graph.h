// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/camera/preset.h"
#include "plan/match/match_graph.h"
#include "site/site.h"

namespace stucco::plan {

// Where matches are looked for.
struct MatchSetting {
  const Site& site;
  const CameraPreset& camera;
  int threads = 1;
};

// A photo by its hover and its place among that hover's shots.
struct PhotoPlace {
  uint32_t hover = 0;
  uint32_t shot = 0;
};

// The match graph of hovers, with what it is made of.
struct PhotoGraph {
  std::vector<Segment2d> corridors;  // between buildings far apart, whose ground counts too
  SurfaceView view;
  double patch_m2;
  std::vector<PhotoPlace> places;  // by photo: hovers in their order, of each its shots
  MatchGraph graph;

  PhotoGraph(const MatchSetting& setting, std::span<const Hover> hovers);
  PhotoGraph(const PhotoGraph&) = delete;
};

}  // namespace stucco::plan
