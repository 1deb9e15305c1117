// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/photo_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stucco {

double FocalSigmaRatio(const CapturedCamera& camera) {
  if (camera.fixed) return 0;
  if (camera.focal_source == "option" || camera.focal_source == "dewarp") return 0.02;
  return camera.focal_source == "default" ? 0.5 : 0.1;
}

std::string KeyOf(const Camera& camera) {
  return fmt::format("{} {} {}", Name(camera.model), camera.width_px,
                     fmt::join(camera.params, " "));
}

}  // namespace stucco
