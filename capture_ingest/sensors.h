// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace stucco {

// Width in millimetres of the longer side of a camera's sensor by its EXIF model; nothing for
// cameras that the table does not know.
std::optional<double> SensorWidth_mm(std::string_view model);

}  // namespace stucco
