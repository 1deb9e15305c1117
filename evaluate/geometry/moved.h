// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/pose.h"
#include "survey/proxy.h"

namespace stucco::evaluate {

// The same facet and the same proxy in another frame; areas and distances grow with the scale.
Facet Moved(const Facet& facet, const Similarity& new_from_old);
Proxy Moved(const Proxy& proxy, const Similarity& new_from_old);

}  // namespace stucco::evaluate
