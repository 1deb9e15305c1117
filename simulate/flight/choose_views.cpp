// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/choose_views.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "survey/attitude.h"
#include "survey/error.h"

namespace stucco::simulate {
namespace {

std::vector<std::string> Split(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream text(list);
  for (std::string word; std::getline(text, word, ',');) words.push_back(word);
  return words;
}

constexpr double kMostOblique = 0.5;  // cosine: photos from farther aside paint nothing

// Whether the middle of the facade is in the picture; what stands between is not asked.
bool LooksAt(const Plan& plan, const PlannedView& view, const PlannedFacade& facade) {
  Eigen::Vector3d middle;
  middle << (facade.a_m + facade.b_m) / 2, (facade.z_m.from_m + facade.z_m.to_m) / 2;
  const Eigen::Vector3d way = middle - view.position_m;
  const double towards = -way.head<2>().dot(facade.outwards());
  if (!(towards > kMostOblique * way.norm()) || way.norm() > plan.d_max_m) return false;
  const Eigen::Vector3d in_camera = CamFromEnu({view.yaw_deg, view.pitch_deg, 0}) * way;
  const Eigen::Vector2d on_sensor = plan.camera.focal_m * in_camera.hnormalized();
  return in_camera.z() > 0 && std::abs(on_sensor.x()) < plan.camera.sensor_width_m / 2 &&
         std::abs(on_sensor.y()) < plan.camera.sensor_height_m / 2;
}

bool IsMeantFor(const PlannedView& view, const PlannedFacade& facade) {
  return std::ranges::any_of(view.targets, [&](const auto& t) { return t.facade == facade.id; });
}

// In the order of the flight.
std::vector<size_t> ViewsFor(const Plan& plan, const PlannedFacade& facade) {
  std::vector<size_t> views;
  for (size_t i = 0; i < plan.views.size(); ++i) {
    if (IsMeantFor(plan.views[i], facade) || LooksAt(plan, plan.views[i], facade)) {
      views.push_back(i);
    }
  }
  std::ranges::stable_sort(views, {}, [&](size_t i) { return plan.views[i].order; });
  return views;
}

std::vector<size_t> ViewsFor(const Plan& plan, const std::string& id) {
  const auto facade = std::ranges::find(plan.facades, id, &PlannedFacade::id);
  const bool known = facade != plan.facades.end();
  std::vector<size_t> views;
  if (known) views = ViewsFor(plan, *facade);
  if (!views.empty()) return views;
  throw Error(ErrorKind::kUsage,
              fmt::format("facades: the plan has no {} {}", known ? "view of" : "facade", id),
              "plan.json lists facades with their ids and views");
}

// Takes `count` views, or all: those of one list after another's, each list's spread evenly over
// what is left of it.
std::vector<bool> Spread(std::vector<std::vector<size_t>> lists, size_t count, size_t views) {
  std::ranges::stable_sort(lists, {}, &std::vector<size_t>::size);  // so that all can be had
  std::vector<bool> taken(views, false);
  for (size_t i = 0; i < lists.size(); ++i) {
    std::vector<size_t>& list = lists[i];
    std::erase_if(list, [&](size_t view) { return taken[view]; });
    const size_t share = std::min(list.size(), count / (lists.size() - i));
    for (size_t k = 0; k < share; ++k) taken[list[(2 * k + 1) * list.size() / (2 * share)]] = true;
    count -= share;
  }
  return taken;
}

}  // namespace

Plan ChooseViews(Plan plan, const FlightOptions& options) {
  if (options.facades.empty() && options.most_photos == 0) return plan;
  std::vector<std::vector<size_t>> lists;
  for (const std::string& id : Split(options.facades)) {
    lists.push_back(ViewsFor(plan, id));
  }
  if (lists.empty()) {
    lists.emplace_back();
    for (size_t i = 0; i < plan.views.size(); ++i) lists[0].push_back(i);
    std::ranges::stable_sort(lists[0], {}, [&](size_t i) { return plan.views[i].order; });
  }
  const size_t most = options.most_photos > 0 ? static_cast<size_t>(options.most_photos)
                                              : lists.size() * plan.views.size();
  const std::vector<bool> taken = Spread(std::move(lists), most, plan.views.size());
  size_t index = 0;
  std::erase_if(plan.views, [&](const PlannedView&) { return !taken[index++]; });
  return plan;
}

}  // namespace stucco::simulate
