// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/proxy.h"

namespace stucco {

// What ids of a class begin with; F is left to the facades of the map.
inline char LetterOf(FacetClass facet_class) {
  switch (facet_class) {
    case FacetClass::kWall:
      return 'W';
    case FacetClass::kRoof:
      return 'R';
    case FacetClass::kGround:
      return 'G';
    case FacetClass::kOuterFloor:
      return 'O';
  }
  return 'O';
}

}  // namespace stucco
