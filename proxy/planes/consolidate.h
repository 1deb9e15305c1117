// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "proxy/cloud/grid_index.h"
#include "proxy/cloud/samples.h"
#include "proxy/cloud/scale.h"
#include "proxy/planes/plane.h"

namespace stucco {

// Merges planes that are one within the tolerances (the smaller one's points lie on the larger
// one's plane and look its way), largest first, until nothing changes.
void MergeCoplanar(const Samples& samples, const Tolerances& tolerances, double normal_angle_deg,
                   std::vector<Plane>& planes);

// Lets samples without a plane join the plane of a neighbour when they lie on it, three times over:
// region growing leaves gaps where the noise is high.
void AdoptNeighbours(const Samples& samples, const GridIndex& index, const Tolerances& tolerances,
                     double normal_angle_deg, std::vector<Plane>& planes);

// What came of each plane.
struct PlaneUse {
  std::vector<bool> idle;     // nothing could be made of it
  std::vector<int> building;  // that it belongs to
};

// Takes idle planes apart where one beside them has at least half of their points within the level
// of detail: a door that stands back in its wall, a kink of a roof. The one that has most of them
// gets those. It is of the same building and not idle. What is taken apart is left without points.
// Requires the use of every plane.
void TakeApartIdle(const Samples& samples, const Tolerances& tolerances, double normal_angle_deg,
                   const PlaneUse& use, std::vector<Plane>& planes);

// Drops planes that are no surfaces: points spread evenly through the tolerance or normals that
// disagree with the plane and with each other (leaves, clutter), or too small an area.
void DropClutter(const Samples& samples, const Tolerances& tolerances, double normal_angle_deg,
                 std::vector<Plane>& planes);

// Mean angle between the plane's normal and those of its points.
double NormalScatterDeg(const Samples& samples, const Plane& plane);

// More than normals scatter on walls and roofs: 6 degrees above what the smoothest quarter of these
// planes, by area, has at most. Leaves look every way, and a crown is fitted by planes all the
// same. Over walls and roofs of made surveys normals scatter by 3 to 13 degrees, over crowns by 10
// to 26 (below 10 m2 both are found in between); of a real one with 8 times the noise by 8 to 16.
double LeafScatterDeg(const Samples& samples, std::span<const std::vector<Plane>> buildings);

}  // namespace stucco
