// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/brown_lens.h"

#include <cassert>
#include <string_view>

namespace stucco {
namespace {

CameraModel SmallestModel(const BrownLens& lens) {
  if (lens.k3 != 0 || lens.k4 != 0 || lens.k5 != 0 || lens.k6 != 0) return CameraModel::kFullOpenCv;
  const bool is_radial = lens.k1 != 0 || lens.k2 != 0;
  if (lens.p1 != 0 || lens.p2 != 0 || (is_radial && lens.fx != lens.fy)) {
    return CameraModel::kOpenCv;
  }
  if (lens.k2 != 0) return CameraModel::kRadial;
  if (lens.k1 != 0) return CameraModel::kSimpleRadial;
  return lens.fx == lens.fy ? CameraModel::kSimplePinhole : CameraModel::kPinhole;
}

// The coefficient that a parameter of camera.h's models is.
double& Coefficient(std::string_view name, BrownLens& lens) {
  if (name == "f" || name == "fx") return lens.fx;
  if (name == "fy") return lens.fy;
  if (name == "cx") return lens.cx;
  if (name == "cy") return lens.cy;
  if (name == "k" || name == "k1") return lens.k1;
  if (name == "k2") return lens.k2;
  if (name == "p1") return lens.p1;
  if (name == "p2") return lens.p2;
  if (name == "k3") return lens.k3;
  if (name == "k4") return lens.k4;
  if (name == "k5") return lens.k5;
  assert(name == "k6");
  return lens.k6;
}

}  // namespace

BrownLens LensWithNames(const Camera& camera) {
  BrownLens lens;
  const auto names = ParameterNames(camera.model);
  assert(camera.params.size() == names.size());
  for (size_t i = 0; i < names.size(); ++i) Coefficient(names[i], lens) = camera.params[i];
  lens.fy = camera.FocalY();
  return lens;
}

Camera CameraWithLens(const BrownLens& lens, const ImageSize& size) {
  Camera camera;
  camera.model = SmallestModel(lens);
  camera.width_px = size.width_px;
  camera.height_px = size.height_px;
  BrownLens numbers = lens;
  for (const std::string_view name : ParameterNames(camera.model)) {
    camera.params.push_back(Coefficient(name, numbers));
  }
  return camera;
}

}  // namespace stucco
