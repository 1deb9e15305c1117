// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "evaluate/figures/evaluation.h"

namespace stucco::evaluate {

// What plan/stats.json says a flight takes and its photos are worth. Throws Error (kBadInput).
PlanFigures ReadPlanFigures(const std::filesystem::path& stats);

}  // namespace stucco::evaluate
