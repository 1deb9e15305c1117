// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/proxy.h"

namespace stucco {

// Wavefront OBJ in world coordinates: the facets triangulated, one group per facet, named by its id
// with '_' for '/'.
std::string ObjText(const Proxy& proxy);

}  // namespace stucco
