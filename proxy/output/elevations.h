// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "proxy/cloud/samples.h"
#include "survey/proxy.h"

namespace stucco {

// A picture of each building but the ground, `folder`/ElevationFile: its walls and roofs
// side by side, each seen squarely from outside, and on them how far the points of the cloud lie
// from the plane: red before it, blue behind it, grey where there are none. What stands out of a
// wall shows, and so do walls that stand wrong, and what was never seen. Points count that look the
// way their facet does. Colours are full at 0.15 m (of a model without metres at a thousandth of
// its size). Throws Error (kOutOfResource) when the disk is full.
void WriteElevations(const PointStream& cloud, const Proxy& proxy,
                     const std::filesystem::path& folder);

}  // namespace stucco
