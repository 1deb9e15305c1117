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

// z of the ground as a cell draws it, at a place of the cell in the axes of the ground.
double DrawnHeight(const Town& town, const GroundGrid& grid, int column, int row,
                   const Eigen::Vector2d& at);

// The town's ground without the fields, houses cut out of it: one facet per level and closed area
// where it is flat, else a triangle per half cell; G0 is the largest.
std::vector<Facet> GroundFacets(const Town& town, const GroundGrid& grid);

}  // namespace stucco::simulate
