// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace stucco::plan {

// A photo of a plan and what ties it to the others.
struct TiedView {
  std::string view;
  int partners = 0;                  // that it should match
  int close = 0;                     // of a photo of facades: near in direction and scale
  double strength = 0;               // of all its partners together
  std::vector<std::string> facades;  // that it is meant for
  bool is_loose = false;             // it lacks partners
};

// How the photos of a plan should hang together.
struct MatchStats {
  int parts = 0;                  // that the photos fall into
  int bridges = 0;                // pairs that alone hold two parts together
  int hanging = 0;                // photos that those of one hover alone hold to their part
  int loose = 0;                  // photos that lack partners
  std::vector<TiedView> weakest;  // the loose ones, then those with the least strength
  int apart = 0;                  // photos outside of the largest part
  std::vector<std::string> apart_of = {};  // buildings that they are meant for, ascending
};

// What will hang loose, a sentence each; none where nothing does. `links_tried`: link photos were
// looked for, so that there is none where photos still lack partners.
std::vector<std::string> MatchWarnings(const MatchStats& stats, bool links_tried);

}  // namespace stucco::plan
