// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "survey/plan.h"

namespace stucco {

// plan/plan.json; docs/formats.md describes it for other planners. Reading checks that ids are
// unique and that everything named exists. Throws Error (kBadInput).
Plan ReadPlan(const std::filesystem::path& path);
void WritePlan(const Plan& plan, const std::filesystem::path& path);

}  // namespace stucco
