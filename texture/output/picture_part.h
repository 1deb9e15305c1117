// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <utility>

#include "survey/glb.h"
#include "survey/image.h"
#include "survey/pixels.h"
#include "survey/texture_set.h"

namespace stucco {

// A rectangle of a picture, in texture coordinates: (0, 0) is its top left corner, (1, 1) its
// bottom right one.
using PicturePart = Eigen::AlignedBox2d;

inline const PicturePart kWholePicture{Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)};

inline bool IsWhole(const PicturePart& part) {
  return part.isApprox(kWholePicture, 0);
}

// Both halves of a part of a picture of that size, along its longer side; the cut is between
// texels.
std::pair<PicturePart, PicturePart> Halved(const PicturePart& part, const ImageSize& picture);

// In a picture of that size.
ImageSize SizeOf(const PicturePart& part, const ImageSize& picture);
// The part of a picture, of exactly that size, give or take a texel at its border.
Image Cut(const Image& picture, const PicturePart& part, const ImageSize& size);

// Where the part lies in the world, by its corners.
Eigen::AlignedBox3d BoxOf(const PicturePart& part, const TexturedFacet& texture,
                          const Eigen::Isometry3d& frame_from_world);

// What of triangles with coordinates of the whole picture lies in the part (Sutherland and Hodgman,
// "Reentrant polygon clipping", 1974), with coordinates of the part. Others are left out.
GlbPrimitive ClippedTo(const PicturePart& part, const GlbPrimitive& whole);

}  // namespace stucco
