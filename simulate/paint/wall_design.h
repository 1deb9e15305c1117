// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace stucco::simulate {

enum class Cladding { kBrick, kPlaster, kStone, kConcrete, kPanels, kGlass };

enum class PartKind {
  kWindow,
  kDoor,
  kShopWindow,
  kBalconyDoor,
  kBalcony,  // the slab's face and the railing as seen from the front
  kCornice,
  kLedge,  // metal along a floor of a curtain wall
  kPlinth,
};

constexpr double kBalconySlab_m = 0.18;  // at the lower edge of a balcony; the rest is railing

// A thing on a wall, in metres on the wall's picture: x right from its left edge, y down from its
// top edge, seen from outside.
struct WallPart {
  PartKind kind = PartKind::kWindow;
  Eigen::Vector2d top_left = Eigen::Vector2d::Zero();
  Eigen::Vector2d bottom_right = Eigen::Vector2d::Zero();
  double relief_m = 0;   // how far it stands out of the wall's plane; negative: set back
  uint32_t variant = 0;  // chooses curtains, panes, leaf of the door ...
};

// How a wall is to be painted. Its picture is the wall seen at right angles: parts that are set
// back or stand out are painted where they are seen.
struct WallDesign {
  double width_m = 0;
  double height_m = 0;
  Cladding cladding = Cladding::kPlaster;
  int palette = 0;               // which picture of the library gives colours and grain; modulo
  std::vector<double> floors_m;  // y of the floor lines, downwards
  std::vector<WallPart> parts;
  // Width of a bay that looks like all others, in every storey, from the left edge on; 0: none
  // does.
  double repeated_bay_m = 0;
  uint64_t seed = 0;       // the same for the walls of one building: its material; stains differ
  int wall = 0;            // number of the wall in its building
  bool repainted = false;  // with a coat of paint of another hue than its material's
};

enum class Covering { kTiles, kMembrane, kGravel, kMetal, kAsphalt, kPaving, kGrass, kSoil, kCrop };

// A horizontal or sloping surface painted in one kind; y of the picture runs down the slope.
struct CoveringDesign {
  double width_m = 0;
  double height_m = 0;
  Covering covering = Covering::kTiles;
  int palette = 0;
  uint64_t seed = 0;  // the same for the faces of one roof: its tiles or sheets; stains differ
  int face = 0;       // number of the face
};

}  // namespace stucco::simulate
