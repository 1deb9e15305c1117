// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "survey/georef.h"
#include "survey/model_look.h"
#include "survey/proxy.h"

namespace stucco {

struct Tiles3dOptions {
  int atlas_px = 2048;  // width of a tile's picture; about as high
  int jpeg_quality = 90;
  int threads = 1;
};

// The model with a look as 3D Tiles 1.1 (OGC 22-025r4): `tileset.json` and a GLB per tile in
// `tiles/`, levels of detail in which tiles replace each other, one picture a tile. What is shown
// is refined where a texel is larger than a pixel of the screen, at the usual limit of 16 pixels of
// error. Facets stay meshes of their own, named by their ids. Georeferenced models stand on the
// earth (EPSG:4978); others at the origin, up being z. Throws Error: kBadInput where the model has
// no facet or a picture cannot be read, kOutOfResource where `out` cannot be written.
void WriteTiles3d(const Proxy& proxy, const ModelLook& look, const Georef& georef,
                  const std::filesystem::path& out, const Tiles3dOptions& options);

}  // namespace stucco
