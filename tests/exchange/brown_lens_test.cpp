// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/brown_lens.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

TEST(BrownLens, TheSmallestModelThatIsTheLens) {
  BrownLens lens = {.fx = 100, .fy = 100, .cx = 50, .cy = 40};
  const auto model = [&] { return CameraWithLens(lens, {100, 80}).model; };
  EXPECT_EQ(model(), CameraModel::kSimplePinhole);
  lens.fy = 101;
  EXPECT_EQ(model(), CameraModel::kPinhole);
  lens.k1 = 0.1;
  EXPECT_EQ(model(), CameraModel::kOpenCv);
  lens.fy = 100;
  EXPECT_EQ(model(), CameraModel::kSimpleRadial);
  lens.k2 = 0.01;
  EXPECT_EQ(model(), CameraModel::kRadial);
  lens.p2 = 0.001;
  EXPECT_EQ(model(), CameraModel::kOpenCv);
  lens.k3 = 0.001;
  EXPECT_EQ(model(), CameraModel::kFullOpenCv);
}

TEST(BrownLens, EveryParameterKeepsItsPlace) {
  for (const CameraModel model :
       {CameraModel::kSimplePinhole, CameraModel::kPinhole, CameraModel::kSimpleRadial,
        CameraModel::kRadial, CameraModel::kOpenCv, CameraModel::kFullOpenCv}) {
    Camera camera;
    camera.model = model;
    camera.width_px = 100;
    camera.height_px = 80;
    for (size_t i = 0; i < ParameterNames(model).size(); ++i) {
      camera.params.push_back(100 + static_cast<double>(i));
    }
    const Camera again = CameraWithLens(LensWithNames(camera), {100, 80});
    EXPECT_EQ(again.model, model);
    EXPECT_EQ(again.params, camera.params);
  }
}

}  // namespace
}  // namespace stucco
