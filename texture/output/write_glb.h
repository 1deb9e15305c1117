// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "survey/model_look.h"
#include "survey/proxy.h"

namespace stucco {

struct GlbOptions {
  int max_px = 4096;  // longest side of a picture; larger ones are cut into tiles
  int jpeg_quality = 90;
  int threads = 1;
  double most_texels = 128e6;  // of all pictures; where they have more all are made smaller
  int atlas_px = 0;            // side of the larger pictures that facets share; 0: each has its own
  bool relief = false;         // of the first look, as geometry
};

// How many threads may read and encode pictures of these looks, or sheets of that side, at once
// within so many bytes; at least one, and no more than `threads`.
int EncodingThreads(std::span<const ModelLook> looks, int atlas_px, uint64_t bytes, int threads);

// The whole proxy as binary glTF, self-contained: one mesh per facet with the facet's id as its
// name, of as many primitives as its picture has tiles, pictures inside as JPEG, all made smaller
// by the same factor where together they have too many texels, materials unlit
// (KHR_materials_unlit), facets without a picture plain grey. With `atlas_px` pictures that are
// small enough share one, and with it a material: a viewer draws what has one material at once.
// Those of facets that look otherwise in some of the looks stay their own. y is up as glTF demands:
// world (x, y, z) with z up becomes (x, z, -y), after `model_offset` of the first look was taken
// off (`asset.extras.offset` repeats it). Where up is not z the model is turned so that up becomes
// y.
//
// It looks as the first of `looks`, of which there must be one. Where there are more each is a
// variant of that name (KHR_materials_variants), and a facet without a picture in one of them looks
// there as in the first; pictures of one facet have the same grid. Throws Error (kBadInput) for
// pictures that are not there or damaged.
std::string GlbOfLooks(const Proxy& proxy, std::span<const ModelLook> looks,
                       const GlbOptions& options);

}  // namespace stucco
