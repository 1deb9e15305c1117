// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/paint/paint.h"

#include <fmt/format.h>

#include <cmath>

#include "simulate/paint/internal/covering_look.h"
#include "simulate/paint/internal/openings.h"
#include "survey/error.h"

namespace stucco::simulate {
namespace {

using internal::CoveringLook;
using internal::Tile;
using internal::WallLook;

constexpr int kTile = 128;  // texels a side: 200 kB of linear light

void Store(Tile& tile, Image& image) {
  for (int row = 0; row < tile.height; ++row) {
    uint8_t* to = image.Pixel(tile.x0, tile.y0 + row);
    for (int column = 0; column < tile.width; ++column, to += 3) {
      const internal::Colour& colour = tile.At(column, row);
      to[0] = internal::FastSrgbCode(colour.r);
      to[1] = internal::FastSrgbCode(colour.g);
      to[2] = internal::FastSrgbCode(colour.b);
    }
  }
}

template <class PaintTile>
Image InTiles(int width, int height, double metres_per_texel, PaintTile paint) {
  Image image{width, height, 3, {}};
  image.data.resize(static_cast<size_t>(width) * height * 3);
  for (int y = 0; y < height; y += kTile) {
    for (int x = 0; x < width; x += kTile) {
      Tile tile{x,
                y,
                std::min(kTile, width - x),
                std::min(kTile, height - y),
                static_cast<float>(metres_per_texel),
                {}};
      tile.colours.resize(static_cast<size_t>(tile.width) * tile.height);
      paint(tile);
      Store(tile, image);
    }
  }
  return image;
}

void PaintGround(Tile& tile, const WallLook& look) {
  switch (look.design->cladding) {
    case Cladding::kBrick:
      return internal::PaintBrick(tile, look);
    case Cladding::kPlaster:
      return internal::PaintPlaster(tile, look);
    case Cladding::kStone:
      return internal::PaintStone(tile, look);
    case Cladding::kConcrete:
      return internal::PaintConcrete(tile, look);
    case Cladding::kPanels:
      return internal::PaintPanels(tile, look);
    case Cladding::kGlass:
      return internal::PaintCurtainWall(tile, look);
  }
}

// Paint covers the material's colour; its grain and joints stay.
void PaintOver(Tile& tile, const WallLook& look) {
  const float usual = Luminance(look.palette.mean);
  for (internal::Colour& colour : tile.colours) {
    colour = std::clamp(Luminance(colour) / usual, 0.6f, 1.4f) * look.coat;
  }
}

void PaintSurface(Tile& tile, const CoveringLook& look) {
  switch (look.design->covering) {
    case Covering::kTiles:
      return internal::PaintTiles(tile, look);
    case Covering::kMembrane:
      return internal::PaintMembrane(tile, look);
    case Covering::kGravel:
      return internal::PaintGravel(tile, look);
    case Covering::kMetal:
      return internal::PaintMetal(tile, look);
    case Covering::kAsphalt:
      return internal::PaintAsphalt(tile, look);
    case Covering::kPaving:
      return internal::PaintPaving(tile, look);
    case Covering::kGrass:
      return internal::PaintGrass(tile, look);
    case Covering::kSoil:
      return internal::PaintSoil(tile, look);
    case Covering::kCrop:
      return internal::PaintCrop(tile, look);
  }
}

// What lies over what: the plinth is flush with the wall, ornament and fittings hang on it; what
// stands out hides them.
constexpr int kFlush = 0;
constexpr int kOnTop = 3;
int Layer(PartKind kind) {
  switch (kind) {
    case PartKind::kPlinth:
      return kFlush;
    case PartKind::kCornice:
    case PartKind::kLedge:
      return 1;
    case PartKind::kBalcony:
      return kOnTop;
    default:
      return 2;
  }
}

// Copies the middle bay of the upmost storey to all others of all storeys.
void RepeatBay(const WallDesign& design, double metres_per_texel, Image& wall) {
  const double bay = design.repeated_bay_m / metres_per_texel;
  const double top = design.floors_m[0] / metres_per_texel;
  const double storey = (design.floors_m[1] - design.floors_m[0]) / metres_per_texel;
  const double bottom = design.floors_m.back() / metres_per_texel;
  const double middle = std::floor(design.width_m / design.repeated_bay_m / 2) * bay;
  const Image from = wall;
  // The texel of the bay that is copied to one so far from the first bay's edge.
  const auto texel = [](double begin, double offset, double period, int size) {
    const int at = static_cast<int>(begin + std::fmod(offset, period));
    return std::clamp(at, 0, size - 1);
  };
  for (int y = std::max(0, static_cast<int>(std::ceil(top)));
       y < std::min(wall.height_px, static_cast<int>(bottom)); ++y) {
    const int from_y = texel(top, y - top, storey, wall.height_px);
    for (int x = 0; x < wall.width_px; ++x) {
      const int from_x = texel(middle, x, bay, wall.width_px);
      std::copy_n(from.Pixel(from_x, from_y), wall.channels, wall.Pixel(x, y));
    }
  }
}

}  // namespace

int Texels(double side_m, double metres_per_texel) {
  constexpr double kMost = 65535;  // of a side of a JPEG, and well within an int
  const double texels = std::ceil(side_m / metres_per_texel - 1e-9);
  if (!(metres_per_texel > 0) || !(side_m > 0) || !(texels <= kMost)) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("a surface of {} m cannot be painted at {} m per texel: a picture has 1 "
                    "to {} texels a side",
                    side_m, metres_per_texel, kMost),
        "choose larger texels");
  }
  return std::max(1, static_cast<int>(texels));
}

Image PaintWall(const WallDesign& design, double metres_per_texel) {
  const int width = Texels(design.width_m, metres_per_texel);
  const int height = Texels(design.height_m, metres_per_texel);
  const WallLook look = internal::LookOf(design);
  Image wall = InTiles(width, height, metres_per_texel, [&](Tile& tile) {
    PaintGround(tile, look);
    if (design.repainted) PaintOver(tile, look);
    if (design.cladding != Cladding::kGlass) internal::Weather(tile, look);
    for (int layer = kFlush; layer <= kOnTop; ++layer) {
      for (const WallPart& part : design.parts) {
        if (Layer(part.kind) == layer) internal::PaintPart(tile, look, part);
      }
      if (layer == kFlush) {
        internal::PaintOrnament(tile, look);
        internal::PaintFittings(tile, look);
      }
    }
  });
  if (design.repeated_bay_m > 0 && design.floors_m.size() > 1) {
    RepeatBay(design, metres_per_texel, wall);
  }
  return wall;
}

Image PaintCovering(const CoveringDesign& design, double metres_per_texel) {
  const int width = Texels(design.width_m, metres_per_texel);
  const int height = Texels(design.height_m, metres_per_texel);
  const uint32_t whole = internal::Hash(design.seed, 19);
  const CoveringLook look{&design, whole,
                          internal::Hash(whole, static_cast<uint32_t>(design.face), 29)};
  return InTiles(width, height, metres_per_texel, [&](Tile& tile) { PaintSurface(tile, look); });
}

Image PaintTrim(const WallDesign& design, double metres_per_texel) {
  const int width = Texels(design.width_m, metres_per_texel);
  const int height = Texels(design.height_m, metres_per_texel);
  const WallLook look = internal::LookOf(design);
  const bool bare = !look.surrounds && design.cladding != Cladding::kGlass;
  return InTiles(width, height, metres_per_texel, [&](Tile& tile) {
    if (bare) {
      PaintGround(tile, look);
    } else {
      internal::Fill(tile, tile.Extent(), look.surround);
    }
    internal::Shade(tile, tile.Extent(), [&](float x, float y) {
      return internal::Tone(0.06f *
                            internal::Noise(x, y, {0.6f, 7, 0.7f, look.wall + 73}, tile.texel_m));
    });
  });
}

}  // namespace stucco::simulate
