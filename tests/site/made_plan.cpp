// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/site/made_plan.h"

#include <string>
#include <utility>

namespace stucco::test {
namespace {

void AddHouse(const std::string& building, double y, Plan& plan) {
  const std::vector<Eigen::Vector2d> ring = {{0, y}, {20, y}, {20, y + 10}, {0, y + 10}};
  plan.footprints.push_back({building, {ring}, {0, 12}, 12});
  for (size_t i = 0; i < ring.size(); ++i) {
    PlannedFacade facade;
    facade.id = building + "/F0" + std::to_string(i);
    facade.a_m = ring[i];
    facade.b_m = ring[(i + 1) % ring.size()];
    facade.z_m = {0, 12};
    plan.facades.push_back(std::move(facade));
  }
}

}  // namespace

Plan TwoHouses() {
  Plan plan;
  plan.origin = {.latitude_deg = 50, .longitude_deg = 14, .height_m = 0};
  plan.d_max_m = 30;
  plan.safe_altitude_m = 30;
  AddHouse("B0001", 0, plan);
  AddHouse("B0002", -50, plan);
  return plan;
}

}  // namespace stucco::test
