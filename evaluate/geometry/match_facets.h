// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "survey/pose.h"
#include "survey/proxy.h"

namespace stucco::evaluate {

// When a facet of the result counts as the same surface as one of the truth: far more than a sound
// reconstruction is off, less than what lies between a wall and the next one behind it.
struct MatchLimits {
  double distance_m = 0.5;  // mean along the truth's normal, where both overlap
  double angle_deg = 10;    // between the normals
};

// A facet of the result that lies on a facet of the truth.
struct FacetMatch {
  const Facet* result = nullptr;  // in the proxy that was given, in its own frame
  double overlap_m2 = 0;          // of both outlines on the truth's plane
  double distance_m = 0;
  double angle_deg = 0;
};

struct TruthFacet {
  const Facet* truth = nullptr;
  double area_m2 = 0;               // of its polygon
  std::vector<FacetMatch> matches;  // largest overlap first
};

// Whether a facet of the truth is a wall that people call a facade: walls to a neighbour, which no
// camera sees whole (`seen` is 0), have no id in a plan and no picture worth comparing.
bool IsFacade(const Facet& truth);

// Every facet of the truth, in its order, with what the result has there. Classes are not looked
// at. The proxies have to outlive the answer.
std::vector<TruthFacet> MatchFacets(const Proxy& result, const Proxy& truth,
                                    const Similarity& truth_from_result,
                                    const MatchLimits& limits = {});

// The area in which two facets overlap, seen along the normal of `a`, and the mean distance of
// both planes there along that normal; nothing where they are at right angles or do not overlap.
struct FacetOverlap {
  double area_m2 = 0;
  double distance_m = 0;
};
FacetOverlap Overlap(const Facet& a, const Facet& b);

}  // namespace stucco::evaluate
