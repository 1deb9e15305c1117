// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/georef.h"
#include "survey/reconstruction.h"

namespace stucco {

// The three photos of RowOfPhotos around some points, with two lenses, each observation off by a
// little, in a frame with a place on the earth.
Reconstruction MadeModel();
Georef MadePlace();

}  // namespace stucco
