// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "pipeline/engine/run.h"

namespace stucco {

// Brings a survey up to date once Check() has found nothing fatal: the verb `run`, and the verbs of
// single stages. `options.precheck` is set here. Throws Error for all that is wrong before work
// starts.
RunResult RunSurvey(const std::filesystem::path& survey, const StageTable& table,
                    RunOptions options, Console& console, const Platform& platform);

}  // namespace stucco
