// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/image.h"

namespace stucco::simulate {

// An unsharp mask on brightness alone, as cameras apply it to the developed picture: each pixel
// goes away from the mean around it (a Gaussian of 1 pixel) by `strength` times its difference, but
// next to no farther than the pixels near it do, so that edges get no halos. 0 changes nothing. The
// same bytes at any number of threads.
Image Sharpened(Image picture, double strength, int threads);

}  // namespace stucco::simulate
