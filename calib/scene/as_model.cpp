// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/as_model.h"

#include <algorithm>

namespace stucco {

Camera AsModel(const Camera& camera, CameraModel model) {
  Camera result = camera;
  result.model = model;
  result.params.assign(ParameterNames(model).size(), 0.0);
  result.params[0] = camera.FocalX();
  result.params[1] = camera.FocalY();
  result.params[2] = camera.PrincipalPoint().x();
  result.params[3] = camera.PrincipalPoint().y();
  if (model == CameraModel::kPinhole) return result;
  const bool with_pairs =
      camera.model == CameraModel::kOpenCv || camera.model == CameraModel::kFullOpenCv;
  for (size_t i = 4; with_pairs && i < std::min(result.params.size(), camera.params.size()); ++i) {
    result.params[i] = camera.params[i];
  }
  if (camera.model == CameraModel::kSimpleRadial || camera.model == CameraModel::kRadial) {
    for (size_t i = 3; i < camera.params.size(); ++i) result.params[i + 1] = camera.params[i];
  }
  return result;
}

}  // namespace stucco
