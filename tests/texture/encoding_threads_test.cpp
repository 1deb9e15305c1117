// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "texture/output/write_glb.h"

namespace stucco {
namespace {

TEST(EncodingThreads, AsManyAsFitWithTheLargestPicture) {
  ModelLook look;
  look.textures.facets.resize(2);
  look.textures.facets[1].width_px = look.textures.facets[1].height_px = 1000;
  constexpr uint64_t kOne = 9'000'000;
  EXPECT_EQ(EncodingThreads({&look, 1}, 0, 3 * kOne, 8), 3);
  EXPECT_EQ(EncodingThreads({&look, 1}, 0, 100 * kOne, 8), 8);
  EXPECT_EQ(EncodingThreads({&look, 1}, 0, 1, 8), 1);
  EXPECT_EQ(EncodingThreads({&look, 1}, 2000, 8 * kOne, 8), 2);  // a sheet is larger
}

}  // namespace
}  // namespace stucco
