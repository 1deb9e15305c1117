// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "simulate/city/city_model.h"
#include "simulate/city/town.h"
#include "survey/proxy.h"

namespace stucco::simulate {

inline constexpr int kFieldKinds = 4;

// The ground cut into cells along the borders of its patches, in the town's street axes.
struct GroundGrid {
  std::vector<double> x;  // lines, ascending
  std::vector<double> y;
  // By cell, rows from the south: index of a patch, or beyond the town, from their number on, one
  // of kFieldKinds fields, then of the streets that go on through them, then of a parcel.
  std::vector<int> patch_of;
  // The fields next to the town, which photos show well: each has a picture of its own, as nothing
  // repeats itself exactly in the country.
  std::vector<GroundPatch> parcels;
  int columns() const { return static_cast<int>(x.size()) - 1; }
  int rows() const { return static_cast<int>(y.size()) - 1; }
};

GroundGrid MakeGroundGrid(const Town& town);

// The town's ground with a picture per patch, kerbs, and parcels of fields to the horizon, as
// element G0.
// Texels are as small as asked for a hamlet and coarser for larger towns.
void AddGround(const Town& town, const GroundGrid& grid, double metres_per_texel, CityModel& model);

// How much of an upright face over the segment from a to b, from `foot_m` upwards, lies below the
// ground as it is drawn: cells of a slope are pairs of triangles.
double BuriedArea(const Town& town, const GroundGrid& grid, const Eigen::Vector2d& a,
                  const Eigen::Vector2d& b, double foot_m);

// The town's ground without the fields, houses cut out of it: one facet per level and closed area
// where it is flat, else a triangle per half cell; G0 is the largest.
std::vector<Facet> GroundFacets(const Town& town, const GroundGrid& grid);

}  // namespace stucco::simulate
