// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/fitted_building.h"

#include <cassert>
#include <utility>

namespace stucco {

FittedBuilding WithParts(FittedBuilding building, std::vector<Polygon> parts) {
  building.building.parts = std::move(parts);
  size_t edge = 0;
  for (const Polygon& part : building.building.parts) {
    for (const Ring& ring : part.rings) {
      for (size_t i = 0; i < ring.size(); ++i, ++edge) {
        assert(edge < building.edges.size());
        building.edges[edge].line = EdgeOf(ring, i);
      }
    }
  }
  assert(edge == building.edges.size());
  return building;
}

}  // namespace stucco
