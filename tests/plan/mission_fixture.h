// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "plan/mission/wpml.h"
#include "survey/plan.h"
#include "tests/survey/temporary_folder.h"

namespace stucco::test {

// Two buildings, one with a courtyard, a no-fly area, and two flights of hovers with one to five
// photos and with corners between them.
Plan MakePlan();
// The same with a home above z = 0.
Plan MakePlan(double home_z_m);

// Back from the geodetic coordinates of a file to the plan's frame, by PROJ itself.
Eigen::Vector2d PlanFromLonLat(const Plan& plan, double longitude_deg, double latitude_deg);

plan::MissionOptions Mavic3E();

// Fields of lines separated by `separator`, without quoting.
std::vector<std::vector<std::string>> Table(const std::string& text, char separator);

// `text` with the first `from` replaced; a test failure when it does not occur.
std::string Replaced(std::string text, const std::string& from, const std::string& to);

}  // namespace stucco::test
