// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/plan_figures.h"

#include "survey/internal/json.h"

namespace stucco::evaluate {

template <typename Archive, internal::Is<PlanFigures> T>
static void Fields(Archive& archive, T& figures) {
  archive.Required("method", figures.method);
  archive.Required("photos", figures.photos);
  archive.Required("hovers", figures.hovers);
  archive.Required("length_m", figures.length_m);
  archive.Required("time_min", figures.time_min);
  archive.Required("battery_percent", figures.battery_percent);
  archive.Group("mean_by_length", [&](auto& mean) {
    mean.Required("q_s", figures.q_s);
    mean.Required("q_d", figures.q_d);
    mean.Required("q_u", figures.q_u);
    mean.Required("q_c", figures.q_c);
  });
}

PlanFigures ReadPlanFigures(const std::filesystem::path& stats) {
  return internal::ReadJsonFile<PlanFigures>(stats);
}

}  // namespace stucco::evaluate
