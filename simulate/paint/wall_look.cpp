// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/paint/internal/wall_look.h"

#include <algorithm>
#include <cmath>

namespace stucco::simulate::internal {
namespace {

std::string_view KindOf(Cladding cladding) {
  switch (cladding) {
    case Cladding::kBrick:
      return "brick";
    case Cladding::kPlaster:
      return "plaster";
    case Cladding::kStone:
      return "stone";
    case Cladding::kConcrete:
      return "concrete";
    case Cladding::kPanels:
      return "panels";
    case Cladding::kGlass:
      return "glass";
  }
  return "plaster";
}

// Albedos of the field's tables: paint and limestone are light, brick and glass may be dark.
float DarkestOf(Cladding cladding) {
  switch (cladding) {
    case Cladding::kPlaster:
      return 0.26f;
    case Cladding::kStone:
    case Cladding::kConcrete:
      return 0.2f;
    case Cladding::kPanels:
      return 0.12f;
    case Cladding::kBrick:
    case Cladding::kGlass:
      return 0.08f;
  }
  return 0.08f;
}

Colour FrameColour(float choice) {
  if (choice < 0.55f) return FromSrgb(226, 224, 216);
  if (choice < 0.7f) return FromSrgb(92, 60, 40);
  if (choice < 0.85f) return FromSrgb(62, 66, 70);
  return FromSrgb(66, 88, 76);
}

Colour ShutterColour(float choice) {
  if (choice < 0.3f) return FromSrgb(54, 84, 66);
  if (choice < 0.55f) return FromSrgb(96, 62, 44);
  if (choice < 0.8f) return FromSrgb(88, 104, 122);
  return FromSrgb(190, 186, 172);
}

// How far two hues are from each other: their ratios of red and blue to green.
float HueDistance(Colour a, Colour b) {
  const float red = std::log(a.r / a.g) - std::log(b.r / b.g);
  const float blue = std::log(a.b / a.g) - std::log(b.b / b.g);
  return std::hypot(red, blue);
}

// Paints of facades, the one that shows best that the wall was another.
Colour CoatOver(Colour wall) {
  const Colour paints[] = {FromSrgb(214, 168, 78), FromSrgb(176, 92, 72), FromSrgb(120, 158, 186),
                           FromSrgb(140, 166, 120)};
  return *std::ranges::max_element(paints, {}, [&](Colour c) { return HueDistance(c, wall); });
}

}  // namespace

WallLook LookOf(const WallDesign& design) {
  WallLook look;
  look.design = &design;
  look.picture = &PictureOf(KindOf(design.cladding), design.palette);
  const bool varied = design.cladding == Cladding::kBrick;
  look.palette = Calmed(look.picture->palette, varied ? 0.30f : 0.16f, DarkestOf(design.cladding));
  look.building = Hash(design.seed, 17);
  look.wall = Hash(look.building, static_cast<uint32_t>(design.wall), 29);
  look.width_m = static_cast<float>(design.width_m);
  look.height_m = static_cast<float>(design.height_m);
  look.surround = Mix(FromSrgb(150, 140, 124), FromSrgb(222, 216, 202), Trait(look, 31)) *
                  Tone(0.1f * (Trait(look, 32) - 0.5f));
  if (design.cladding == Cladding::kGlass) {  // there, the metal of bars and ledges
    look.surround = Grey(Trait(look, 3) < 0.5f ? 0.35f : 0.06f);
  }
  look.coat = CoatOver(look.palette.mean);
  look.frame = FrameColour(Trait(look, 33));
  look.shutter = ShutterColour(Trait(look, 34));
  look.soot = Trait(look, 35) * Trait(look, 36);
  look.shutters = design.cladding == Cladding::kPlaster && Trait(look, 37) < 0.3f;
  look.surrounds = design.cladding != Cladding::kGlass && design.cladding != Cladding::kPanels &&
                   Trait(look, 38) < 0.65f;
  look.window_style = static_cast<int>(Trait(look, 39) * 5);
  return look;
}

}  // namespace stucco::simulate::internal
