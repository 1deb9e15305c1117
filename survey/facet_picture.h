// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco {

// Where a point of a facet's plane, in the world, is on the facet's picture: (0, 0) is the upper
// left corner of the picture, (1, 1) the lower right one, whatever its size in pixels. Formats
// whose v grows upwards take 1 - y. Requires a picture, with a size and texels above zero.
Eigen::Vector2d OnPicture(const TexturedFacet& picture, const Eigen::Vector3d& point_in_world);

// Whether a picture lies on the facet's plane, faces the same way and fits around its outline: one
// that does not was painted on a facet of an earlier model that had the same id. False without a
// size.
bool FitsFacet(const TexturedFacet& picture, const Facet& facet);

}  // namespace stucco
