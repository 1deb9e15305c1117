// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "simulate/scene/scene.h"
#include "survey/proxy.h"

namespace stucco::evaluate {

// The group of trees, cars and what else stands about in a scene.
inline constexpr int kStandsAbout = -1;

// Triangles in the frame of the truth.
struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<int> groups;  // of triangles: a FacetClass, or kStandsAbout
};

void Append(const Facet& facet, Surface& surface);
void Append(const Surface& more, Surface& surface);

// What an element of a made scene is, by its name: walls and roofs are facets of buildings, what
// stands out from them is kOuterFloor.
int GroupOf(const std::string& element);
bool IsOfBuilding(int group);
// Everything that a camera sees; the relief is that without what stands about.
Surface SurfaceOf(const simulate::Scene& scene);
Surface ReliefOf(const simulate::Scene& scene);

double SurfaceArea(const Surface& surface);

struct SurfacePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit
  int group = 0;
};

std::vector<Eigen::Vector3d> Positions(std::span<const SurfacePoint> points);

// `count` points spread evenly by area: the surface is cut into as many parts of the same area, in
// the order of its triangles, and each has one point at random. None where there is no area.
std::vector<SurfacePoint> SamplePoints(const Surface& surface, size_t count, uint64_t seed);

}  // namespace stucco::evaluate
