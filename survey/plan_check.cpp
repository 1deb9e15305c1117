// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/internal/plan_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "survey/error.h"

namespace stucco::internal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Twice the last digit that files carry.
constexpr double kRounding = 2e-3;
// What may lie between two photos of one hover: below what a drone notices.
constexpr double kSamePoint = 0.01;

using Index = std::map<std::string, const PlannedFacade*>;

struct Checker {
  const Plan& plan;
  const std::string& file;

  [[noreturn]] void Fail(const std::string& entry, const std::string& reason) const {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {} {}", file, entry, reason));
  }
  void Require(bool fine, const std::string& entry, const std::string& reason) const {
    if (!fine) Fail(entry, reason);
  }
};

bool IsPlainId(const std::string& id) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  return !id.empty() && std::ranges::all_of(id, plain);
}

bool IsForward(const Interval& interval) {
  return std::isfinite(interval.from_m) && std::isfinite(interval.to_m) &&
         interval.from_m <= interval.to_m;
}

bool IsWithin(const Interval& inner, double length_m) {
  return IsForward(inner) && inner.from_m >= -kRounding && inner.to_m <= length_m + kRounding;
}

void CheckFrame(const Checker& check) {
  const PlanOrigin& origin = check.plan.origin;
  check.Require(std::abs(origin.latitude_deg) <= 90, "\"origin.latitude_deg\"",
                "must lie between -90 and 90");
  check.Require(std::abs(origin.longitude_deg) <= 180, "\"origin.longitude_deg\"",
                "must lie between -180 and 180");
  check.Require(std::isfinite(origin.height_m), "\"origin.height_m\"", "must be finite");
  check.Require(check.plan.d_min_m >= 0, "\"d_min_m\"", "must not be negative");
  check.Require(check.plan.home_m.allFinite(), "\"home_m\"", "must be finite");
}

void CheckPace(const Checker& check) {
  const PlannedPace& pace = check.plan.pace;
  for (const auto& [name, rate] : std::initializer_list<std::pair<const char*, double>>{
           {"speed_m_per_s", pace.speed_m_per_s},
           {"transfer_speed_m_per_s", pace.transfer_speed_m_per_s},
           {"climb_m_per_s", pace.climb_m_per_s},
           {"sink_m_per_s", pace.sink_m_per_s},
           {"yaw_deg_per_s", pace.yaw_deg_per_s},
           {"tilt_deg_per_s", pace.tilt_deg_per_s}}) {
    check.Require(rate > 0 && std::isfinite(rate), fmt::format("\"pace.{}\"", name),
                  "must be more than 0");
  }
  for (const auto& [name, value] :
       std::initializer_list<std::pair<const char*, double>>{{"hold_s", pace.hold_s},
                                                             {"shutter_s", pace.shutter_s},
                                                             {"ground_s", pace.ground_s},
                                                             {"corner_s", pace.corner_s},
                                                             {"stop_s", pace.stop_s},
                                                             {"wind_m_per_s", pace.wind_m_per_s}}) {
    check.Require(value >= 0 && std::isfinite(value), fmt::format("\"pace.{}\"", name),
                  "must not be negative");
  }
}

void CheckRing(const Checker& check, const std::vector<Eigen::Vector2d>& ring,
               const std::string& entry) {
  check.Require(ring.size() >= 3, entry, "has a ring with fewer than 3 corners");
  for (const Eigen::Vector2d& corner : ring) {
    check.Require(corner.allFinite(), entry, "has a corner that is not finite");
  }
}

void CheckOutlines(const Checker& check) {
  for (size_t i = 0; i < check.plan.footprints.size(); ++i) {
    const PlannedFootprint& footprint = check.plan.footprints[i];
    const std::string entry = fmt::format("footprint {} (building {})", i, footprint.building);
    check.Require(!footprint.building.empty(), entry, "has an empty \"building\"");
    check.Require(!footprint.rings_m.empty(), entry, "has no rings");
    check.Require(IsForward(footprint.z_m), entry, "has a \"z_m\" that runs backwards");
    for (const auto& ring : footprint.rings_m) CheckRing(check, ring, entry);
  }
  for (size_t i = 0; i < check.plan.no_fly_m.size(); ++i) {
    CheckRing(check, check.plan.no_fly_m[i], fmt::format("no-fly polygon {}", i));
  }
}

Index CheckFacades(const Checker& check) {
  Index index;
  for (const PlannedFacade& facade : check.plan.facades) {
    const std::string entry = "facade " + facade.id;
    check.Require(!facade.id.empty(), entry, "has an empty id");
    check.Require(index.emplace(facade.id, &facade).second, entry, "occurs twice");
    const double length = facade.length_m();
    check.Require(std::isfinite(length) && length > 0, entry, "has no length");
    check.Require(IsForward(facade.z_m), entry, "has a \"z_m\" that runs backwards");
    for (const Interval& part : facade.unobservable_m) {
      check.Require(IsWithin(part, length), entry,
                    fmt::format("is {:.3f} m long, \"unobservable_m\" goes beyond it", length));
    }
  }
  return index;
}

void CheckTarget(const Checker& check, const std::string& entry, const PlannedTarget& target,
                 const Index& facades) {
  const auto found = facades.find(target.facade);
  if (found == facades.end()) {
    check.Fail(entry,
               fmt::format("is meant for facade \"{}\", which does not exist", target.facade));
  }
  const double length = found->second->length_m();
  check.Require(
      IsWithin(target.along_m, length), entry,
      fmt::format("has a target beyond the {:.3f} m of facade {}", length, target.facade));
  check.Require(IsForward(target.z_m), entry, "has a target whose \"z_m\" runs backwards");
}

void CheckViews(const Checker& check, const Index& facades) {
  std::set<std::string> ids;
  std::map<int, const PlannedView*> orders;
  std::map<int, const PlannedView*> hovers;
  for (const PlannedView& view : check.plan.views) {
    const std::string entry = "view " + view.id;
    check.Require(IsPlainId(view.id), entry,
                  "may have letters a-z and digits only in its id: it becomes part of file names");
    check.Require(ids.insert(view.id).second, entry, "occurs twice");
    check.Require(view.position_m.allFinite(), entry, "has a \"position_m\" that is not finite");
    check.Require(std::abs(view.yaw_deg) <= 360, entry, "has a \"yaw_deg\" beyond 360");
    check.Require(std::abs(view.pitch_deg) <= 90, entry, "has a \"pitch_deg\" beyond 90");
    check.Require(view.order >= 0, entry, "has a negative \"order\"");
    check.Require(view.hover >= 0, entry, "has a negative \"hover\"");
    check.Require(view.flight >= 0, entry, "has a negative \"flight\"");
    const auto [order, first_of_order] = orders.emplace(view.order, &view);
    check.Require(first_of_order, entry,
                  fmt::format("has the same \"order\" as view {}", order->second->id));
    const auto [hover, first_of_hover] = hovers.emplace(view.hover, &view);
    const double apart = (hover->second->position_m - view.position_m).norm();
    check.Require(apart <= kSamePoint, entry,
                  fmt::format("shares \"hover\" {} with view {}, {:.2f} m away", view.hover,
                              hover->second->id, apart));
    check.Require(hover->second->flight == view.flight, entry,
                  fmt::format("shares \"hover\" {} with view {} of another flight", view.hover,
                              hover->second->id));
    for (const PlannedTarget& target : view.targets) CheckTarget(check, entry, target, facades);
  }
  for (const PlannedView& view : check.plan.views) {
    for (const PlannedPartner& partner : view.partners) {
      check.Require(ids.contains(partner.view), "view " + view.id,
                    fmt::format("names partner \"{}\", which does not exist", partner.view));
    }
  }
}

// Facades name their views and views their facades: the two must say the same.
void CheckAssignments(const Checker& check) {
  std::map<std::string, std::vector<std::string>> facades_of_view;
  for (const PlannedView& view : check.plan.views) facades_of_view[view.id] = FacadesOf(view);
  std::set<std::pair<std::string, std::string>> told;
  for (const PlannedFacade& facade : check.plan.facades) {
    for (const std::string& view : facade.views) {
      const std::string entry = fmt::format("facade {} names view \"{}\",", facade.id, view);
      const auto found = facades_of_view.find(view);
      check.Require(found != facades_of_view.end(), entry, "which does not exist");
      check.Require(std::ranges::find(found->second, facade.id) != found->second.end(), entry,
                    "whose \"facades\" do not name the facade");
      check.Require(told.emplace(view, facade.id).second, entry, "twice");
    }
  }
  for (const auto& [view, facades] : facades_of_view) {
    for (const std::string& facade : facades) {
      check.Require(told.contains({view, facade}), "view " + view,
                    fmt::format("is meant for facade {}, whose \"views\" do not name it", facade));
    }
  }
}

void CheckFlights(const Checker& check) {
  if (check.plan.flights.empty()) return;  // views without a path
  std::map<int, int> flight_of_hover;
  const int flights = static_cast<int>(check.plan.flights.size());
  for (const PlannedView& view : check.plan.views) {
    flight_of_hover[view.hover] = view.flight;
    check.Require(view.flight < flights, "view " + view.id,
                  fmt::format("is in flight {}, but there are {}", view.flight, flights));
  }
  std::set<int> reached;
  for (int i = 0; i < flights; ++i) {
    const std::string entry = fmt::format("flight {}", i);
    const PlannedFlight& flight = check.plan.flights[i];
    check.Require(!flight.home_m || flight.home_m->allFinite(), entry,
                  "has a \"home_m\" that is not finite");
    for (const PlannedWaypoint& waypoint : flight.waypoints) {
      check.Require(waypoint.position_m.allFinite(), entry, "has a waypoint that is not finite");
      if (waypoint.hover < 0) continue;
      const auto found = flight_of_hover.find(waypoint.hover);
      check.Require(found != flight_of_hover.end() && found->second == i, entry,
                    fmt::format("stops at hover {}, of which it has no view", waypoint.hover));
      check.Require(reached.insert(waypoint.hover).second, entry,
                    fmt::format("stops at hover {} again", waypoint.hover));
    }
  }
  for (const PlannedView& view : check.plan.views) {
    check.Require(reached.contains(view.hover), "view " + view.id,
                  fmt::format("is taken at hover {}, where no flight stops", view.hover));
  }
}

}  // namespace

std::vector<std::string> FacadesOf(const PlannedView& view) {
  std::vector<std::string> facades;
  for (const PlannedTarget& target : view.targets) {
    if (std::ranges::find(facades, target.facade) == facades.end()) {
      facades.push_back(target.facade);
    }
  }
  return facades;
}

PlannedTarget WholeFacade(const std::string& facade) {
  return {facade, {0, kInfinity}, {-kInfinity, kInfinity}};
}

void ResolveWholeFacades(Plan& plan) {
  Index index;
  for (const PlannedFacade& facade : plan.facades) index.emplace(facade.id, &facade);
  for (PlannedView& view : plan.views) {
    for (PlannedTarget& target : view.targets) {
      const auto found = index.find(target.facade);
      if (found == index.end()) continue;  // the check says so
      const PlannedFacade& facade = *found->second;
      if (std::isinf(target.along_m.to_m)) target.along_m.to_m = facade.length_m();
      if (std::isinf(target.z_m.to_m)) target.z_m = facade.z_m;
    }
  }
}

void CheckPlan(const Plan& plan, const std::string& file) {
  const Checker check{plan, file};
  CheckFrame(check);
  CheckPace(check);
  CheckOutlines(check);
  CheckViews(check, CheckFacades(check));
  CheckFlights(check);
  CheckAssignments(check);
}

}  // namespace stucco::internal
