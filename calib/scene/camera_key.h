// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/camera.h"

namespace stucco {

// Everything that the camera's projection depends on, as text for keys of checkpoints.
std::string KeyOf(const Camera& camera);

}  // namespace stucco
