// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace stucco::plan::internal {

// plan/camera/presets.toml, which the build puts into the library.
std::string_view PresetsToml();

}  // namespace stucco::plan::internal
