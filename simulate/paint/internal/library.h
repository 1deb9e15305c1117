// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulate/paint/internal/colour.h"

namespace stucco::simulate::internal {

struct CarriedPicture {
  std::string_view name;
  std::span<const unsigned char> jpeg;
};

// The files of data/facades, carried by the program.
std::span<const CarriedPicture> CarriedPictures();
std::string_view CarriedCatalogue();

// How a material's colour varies, from bare wall of a picture: in logarithms of linear light, the
// mean and the principal axes (longest first), each as long as its standard deviation.
struct Palette {
  Colour mean;
  std::array<Colour, 3> axes;
};

// A wall's palette from a photo's: axes no longer than `most`, in logarithms of light, for a
// picture's bare wall has shadows and other things on it, and a mean at least as light as
// `darkest`, for photos of walls in the shade say little of their albedo.
Palette Calmed(const Palette& palette, float most, float darkest);

// The colour that lies `a`, `b` and `c` standard deviations along the axes.
Colour Pick(const Palette& palette, float a, float b, float c);

// Bare wall, relative to its mean: log luminance. Between its pixels it is interpolated; at its
// edges it is mirrored, so that it goes on for ever.
struct Patch {
  int width = 0;
  int height = 0;
  std::vector<float> values;
};
float At(const Patch& patch, float x_px, float y_px);

// What is behind a pane, blurred.
struct Pane {
  int width = 0;
  int height = 0;
  std::vector<Colour> colours;
};
Colour At(const Pane& pane, float u, float v);  // 0 to 1 across the pane

struct FacadePicture {
  std::string name;
  std::string kind;
  float metres_per_px = 1;
  Palette palette;
  std::vector<Patch> walls;
};

struct FacadeLibrary {
  std::vector<FacadePicture> pictures;
  std::vector<Pane> windows;  // of all pictures
  std::vector<Pane> shops;
};

// Decoded on the first call.
const FacadeLibrary& Facades();

// The `choice`-th picture (modulo, negative ones too) of a kind. Requires a kind that there is.
const FacadePicture& PictureOf(std::string_view kind, int choice);

}  // namespace stucco::simulate::internal
