// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/camera.h"

namespace stucco {

// The wished model with what the metadata know; parameters the metadata's model lacks start at
// zero.
Camera AsModel(const Camera& camera, CameraModel model);

}  // namespace stucco
