// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/camera_key.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stucco {

std::string KeyOf(const Camera& camera) {
  return fmt::format("{} {} {}", Name(camera.model), camera.width_px,
                     fmt::join(camera.params, " "));
}

}  // namespace stucco
