// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/plan_of_survey.h"

#include <fmt/format.h>

#include <filesystem>

#include "survey/error.h"
#include "survey/plan_io.h"
#include "survey/survey_folder.h"

namespace stucco {

std::optional<Plan> PlanOfSurvey(const StageContext& context) {
  const std::filesystem::path path = context.survey / kPlanFile;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  try {
    return ReadPlan(path);
  } catch (const Error& problem) {
    context.progress->Warn(fmt::format("the plan is not used: {}", problem.what()));
    return std::nullopt;
  }
}

}  // namespace stucco
