// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "calib/scene/scene.h"
#include "calib/scene/triangulate.h"

namespace stucco {

// Points of all tracks at once. Tracks are worked on side by side: each writes to itself only, so
// that any number of threads gives the same.

// Gives tracks without a point one, where their photos agree on it. Returns how many got one.
int TriangulateMissing(const TriangulateOptions& options, int threads, Scene& scene);

// Finds every point anew from the poses as they are now. Returns how many there are.
int TriangulateAll(const TriangulateOptions& options, int threads, Scene& scene);

// Observations of points take part where they fit by now, and not where they do not.
void CompleteTracks(double max_error_sigmas, int threads, Scene& scene);

// Takes observations beyond the error out, and points that are left with fewer than two, are seen
// under a smaller angle, or lie right before a lens: what photos from nearly one place share alone
// has no depth, and an adjustment may pull these photos and it into one place, where it fits
// whatever they show. Returns the number of observations taken out.
int FilterPoints(const TriangulateOptions& options, int threads, Scene& scene);

}  // namespace stucco
