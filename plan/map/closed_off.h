// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "site/site.h"

namespace stucco::plan {

// Finds what no-fly polygons part from Site::home (Site::closed_off): photos there would be
// planned, and tied to others, for nothing. Buildings there are named in Site::warnings; where that
// is all of them, throws Error (kBadInput).
void CloseOff(Site& site);

}  // namespace stucco::plan
