// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/falloff.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stucco {
namespace {

Camera Lens() {
  Camera camera;
  camera.width_px = 400;
  camera.height_px = 300;
  camera.params = {300, 300, 190, 160};
  return camera;
}

TEST(CornerShare, IsOneInTheFarthestCorner) {
  EXPECT_EQ(CornerShare(Lens(), {190, 160}), 0);
  EXPECT_NEAR(CornerShare(Lens(), {400, 0}), 1, 1e-12);
  EXPECT_LT(CornerShare(Lens(), {0, 300}), 1);
}

TEST(EvenOut, MakesADarkenedWallOneColourAtAnySize) {
  const Falloff falloff{{-0.15, -0.1}};
  for (const int size : {1, 2}) {
    Image photo;
    photo.width_px = 400 / size;
    photo.height_px = 300 / size;
    photo.data.resize(static_cast<size_t>(3) * photo.width_px * photo.height_px);
    for (int y = 0; y < photo.height_px; ++y) {
      for (int x = 0; x < photo.width_px; ++x) {
        const double share = CornerShare(Lens(), {(x + 0.5) * size, (y + 0.5) * size});
        const double code = 150 * std::exp(falloff.LogAt(share));
        for (int c = 0; c < 3; ++c) photo.Pixel(x, y)[c] = static_cast<uint8_t>(code + 0.5);
      }
    }
    EXPECT_LT(photo.Pixel(photo.width_px - 1, 0)[0], 122);
    EvenOut(falloff, Lens(), photo);
    for (const uint8_t code : photo.data) EXPECT_NEAR(code, 150, 1.01);
  }
}

TEST(EvenOut, WithoutFalloffNothingChanges) {
  Image photo;
  photo.width_px = 2;
  photo.height_px = 1;
  photo.data = {0, 1, 2, 253, 254, 255};
  const std::vector<uint8_t> before = photo.data;
  EvenOut({}, Lens(), photo);
  EXPECT_EQ(photo.data, before);
}

}  // namespace
}  // namespace stucco
