// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "proxy/cloud/samples.h"
#include "proxy/options/proxy_options.h"

namespace stucco {

// Sizes of a cloud, in world units.
struct CloudScale {
  double spacing = 0;           // median distance to the nearest other sample
  double noise = 0;             // median distance of samples from the plane of their neighbours
  double viewing_distance = 0;  // median distance to a camera that sees the sample; 0: not known
  double extent = 0;            // diagonal of the box of the middle 90 %
};

// Requires at least 4 samples. All zero when most of them are at one place.
CloudScale MeasureScale(const Samples& samples);

// Samples across the level of detail: as many as find it, and no more.
inline constexpr double kSamplesPerDetail = 4;

// What every step after this works with, in world units.
struct Tolerances {
  double level_of_detail = 0;
  double epsilon = 0;
  double min_area = 0;
  double fill_gap = 0;
  double spacing = 0;
  double radius = 0;      // neighbours for growing and smoothing
  double coarseness = 1;  // level_of_detail over what it would be with denser points
};

// What the options leave open follows from the scale of the cloud, and from its spacing where that
// is coarse: nothing smaller than two spacings can be told, no gap under six of them is a gap, and
// no facet is less than seven by seven. What the options say is taken as it is.
Tolerances DeriveTolerances(const CloudScale& scale, bool metric, const ProxyOptions& options);

// Points that a plane of the smallest area must have at least, between 12 and 60.
int LeastPoints(const Tolerances& tolerances);

}  // namespace stucco
