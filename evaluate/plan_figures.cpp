// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/plan_figures.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "survey/error.h"
#include "survey/files.h"

namespace stucco::evaluate {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kStatsVersion = 1;

PlanFigures FiguresFrom(const Json& json) {
  if (json.at("version").get<int>() != kStatsVersion) {
    throw Error(ErrorKind::kBadInput, fmt::format("is not of version {}", kStatsVersion));
  }
  const Json& mean = json.at("mean_by_length");
  PlanFigures figures;
  json.at("method").get_to(figures.method);
  json.at("photos").get_to(figures.photos);
  json.at("hovers").get_to(figures.hovers);
  json.at("length_m").get_to(figures.length_m);
  json.at("time_min").get_to(figures.time_min);
  json.at("battery_percent").get_to(figures.battery_percent);
  mean.at("q_s").get_to(figures.q_s);
  mean.at("q_d").get_to(figures.q_d);
  mean.at("q_u").get_to(figures.q_u);
  mean.at("q_c").get_to(figures.q_c);
  return figures;
}

}  // namespace

PlanFigures ReadPlanFigures(const std::filesystem::path& stats) {
  const std::string text = ReadFile(stats);
  std::string reason;
  try {
    return FiguresFrom(Json::parse(text));
  } catch (const std::exception& error) {  // ours, or the JSON library's
    reason = error.what();
  }
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", stats.string(), reason),
              "plan again with this program");
}

}  // namespace stucco::evaluate
