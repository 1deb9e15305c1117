// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "plan/map/raw_map.h"
#include "plan/options/plan_options.h"

namespace stucco::plan::internal {

// Buildings and building parts of CityJSON 1.0, 1.1 and 2.0 (https://www.cityjson.org/specs); other
// city objects are left out. A footprint is the union of the ground surfaces where the file says
// which these are, else of the faces at the bottom, else of all faces seen from above. Heights are
// `measuredHeight`, else from the lowest to the highest corner.
RawMap ReadCityJson(const std::filesystem::path& path, const PlanOptions& options);

}  // namespace stucco::plan::internal
