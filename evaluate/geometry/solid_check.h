// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "survey/proxy.h"

namespace stucco::evaluate {

// What is wrong with facets as the boundary of a solid, found without the help of the stage that
// made them. Corners are shared where their coordinates are equal.
struct SolidCheck {
  bool closed = false;    // no edge with one triangle only
  bool manifold = false;  // at most two triangles at an edge, one fan at a vertex
  bool oriented = false;  // neighbours face the same side, and that side is out where closed
  bool crosses_itself = false;

  bool watertight() const { return closed && manifold && oriented; }
};

SolidCheck CheckSolid(std::span<const Facet> facets);

}  // namespace stucco::evaluate
