// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "report/options.h"
#include "survey/stage.h"

namespace stucco {

// Writes report.json, facades.csv and report.html into `context.out` from whatever the survey
// folder holds. Missing or damaged results of other stages never make it fail: the report then
// begins with what is missing, why, and the next command. Throws Error only when its own files
// cannot be written.
void RunReport(const ReportOptions& options, StageContext& context);

}  // namespace stucco
