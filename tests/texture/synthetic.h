// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "survey/image.h"
#include "survey/proxy.h"
#include "survey/survey_photo.h"
#include "tests/survey/temporary_folder.h"
#include "texture/grid/grid.h"

namespace stucco::test {

using Colour = Eigen::Vector3d;  // 0 to 255

// A wall in the plane y = 0 that faces south (-y), from (0, 0, 0) to (width, 0, height).
Facet MakeWall(double width, double height);
Proxy MakeProxy(const std::vector<Facet>& facets);

// Blocks and waves with detail down to about 4 cm; x to the right, z upwards on the wall, metres.
Colour WallColour(double x, double z);

// A pinhole camera of the given size and focal length that looks from `position` to `target`.
struct Pinhole {
  int width_px = 0;
  int height_px = 0;
  double focal_px = 0;
};
SurveyPhoto LookFrom(const std::string& name, const Eigen::Vector3d& position,
                     const Eigen::Vector3d& target, const Pinhole& camera);

// What a ray meets first: colour, or nothing for the background.
using Scene =
    std::function<std::optional<Colour>(const Eigen::Vector3d& from, const Eigen::Vector3d& way)>;

// The wall of MakeWall painted with WallColour.
Scene WallScene(double width, double height);
// The same behind a red disc that faces south.
Scene DiscScene(const Eigen::Vector3d& center, double radius, const Scene& behind);

// A box on the wall of MakeWall, from the plane to `depth` before it. Its front shows
// BalconyColour, its other sides are grey.
struct Balcony {
  Eigen::Vector2d low;  // x and z
  Eigen::Vector2d high;
  double depth = 0;
};
Colour BalconyColour(double x, double z);
Scene BalconyScene(const Balcony& balcony, const Scene& behind);

// Renders with 2 x 2 rays a pixel, times `exposure`; background 128.
Image Render(const SurveyPhoto& photo, const Scene& scene, double exposure = 1);

// WallColour as a perfect facade picture on a grid of MakeWall's plane; with a balcony before it.
Image WallPicture(const TexelGrid& grid, const std::optional<Balcony>& balcony = std::nullopt);

// Peak signal-to-noise ratio in decibels over texels whose `mask` is not zero (all without one).
double Psnr(const Image& a, const Image& b, const std::vector<uint8_t>& mask = {});

}  // namespace stucco::test
