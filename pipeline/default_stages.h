// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/engine/stages.h"

namespace stucco {

// ingest, calib, dense, proxy, texture, report: what the program `stucco` runs.
StageTable DefaultStages();

}  // namespace stucco
