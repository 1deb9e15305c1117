// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/proxy.h"

namespace stucco {

// CityJSON 2.0 (https://www.cityjson.org/specs/2.0.1/): each building with one BuildingPart, whose
// geometry is a Solid when it is watertight and a MultiSurface otherwise, with semantic surfaces
// that carry facet id, facade id and figures; the ground as LandUse. The frame is turned so that up
// is z. No reference system is stated: coordinates are local.
std::string CityJsonText(const Proxy& proxy);

}  // namespace stucco
