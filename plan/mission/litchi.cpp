// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/mission/litchi.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace stucco::plan {
namespace {

enum ActionType { kNone = -1, kStay = 0, kPhoto = 1, kRotate = 4, kTilt = 5 };
struct Action {
  ActionType type = kNone;
  int param = 0;
};

// Litchi turns and tilts by whole degrees; smaller differences are not worth an action.
constexpr double kSmallTurn = 0.5;
// DJI refuses waypoints that are closer.
constexpr double kNextWaypoint = 0.5;

int WholeDegrees(double degrees) {
  return static_cast<int>(std::lround(CompassDegrees(degrees))) % 360;
}

// What it takes to get from one view of a hover to the next. The first needs no turn and no tilt:
// the drone arrives as its waypoint says.
std::vector<Action> ActionsFor(const PlannedView* before, const PlannedView& view,
                               const MissionOptions& options) {
  std::vector<Action> actions;
  if (before != nullptr && std::abs(SignedDegrees(view.yaw_deg - before->yaw_deg)) > kSmallTurn) {
    actions.push_back({kRotate, WholeDegrees(view.yaw_deg)});
  }
  if (before != nullptr && std::abs(view.pitch_deg - before->pitch_deg) > kSmallTurn) {
    actions.push_back({kTilt, static_cast<int>(std::lround(view.pitch_deg))});
  }
  actions.push_back({kStay, static_cast<int>(std::lround(1000 * options.pace.hold_s))});
  actions.push_back({kPhoto, 0});
  return actions;
}

// Splits stops whose photos need more actions than a waypoint holds: the next waypoint takes the
// rest, a little higher.
std::vector<MissionStop> SplitStops(const Plan& plan, const std::vector<MissionStop>& stops,
                                    const MissionOptions& options) {
  std::vector<MissionStop> split;
  for (const MissionStop& stop : stops) {
    split.push_back(stop);
    split.back().views.clear();
    size_t actions = 0;
    const PlannedView* before = nullptr;
    for (const PlannedView& view : stop.views) {
      const size_t more = ActionsFor(before, view, options).size();
      if (actions + more > kLitchiActions) {
        MissionStop next = split.back();
        next.views.clear();
        next.yaw_deg = SignedDegrees(view.yaw_deg);
        next.position_m.z() += kNextWaypoint;
        next.height_m += kNextWaypoint;
        next.geodetic = GeodeticFromPlan(plan.origin, next.position_m.head<2>());
        split.push_back(next);
        actions = ActionsFor(nullptr, view, options).size();
      } else {
        actions += more;
      }
      split.back().views.push_back(view);
      before = &view;
    }
  }
  return split;
}

std::string Header() {
  std::string header =
      "latitude,longitude,altitude(m),heading(deg),curvesize(m),rotationdir,gimbalmode,"
      "gimbalpitchangle";
  for (size_t i = 1; i <= kLitchiActions; ++i) {
    header += fmt::format(",actiontype{},actionparam{}", i, i);
  }
  return header +
         ",altitudemode,speed(m/s),poi_latitude,poi_longitude,poi_altitude(m),poi_altitudemode,"
         "photo_timeinterval,photo_distinterval\n";
}

struct Attitude {
  double yaw_deg = 0;
  double pitch_deg = 0;
};

// Updates `attitude` to the one in which the drone leaves the stop.
std::string Line(const MissionStop& stop, const MissionOptions& options, Attitude& attitude) {
  const bool turns_left = SignedDegrees(stop.yaw_deg - attitude.yaw_deg) < 0;
  if (!stop.views.empty()) attitude.pitch_deg = stop.views.front().pitch_deg;
  std::string line =
      fmt::format("{:.8f},{:.8f},{:.2f},{:.2f},0,{},2,{:.2f}", stop.geodetic.latitude_deg,
                  stop.geodetic.longitude_deg, stop.height_m, CompassDegrees(stop.yaw_deg),
                  turns_left ? 1 : 0, attitude.pitch_deg + 0.0);
  std::vector<Action> actions;
  attitude.yaw_deg = stop.yaw_deg;
  const PlannedView* before = nullptr;
  for (const PlannedView& view : stop.views) {
    std::ranges::copy(ActionsFor(before, view, options), std::back_inserter(actions));
    attitude = {view.yaw_deg, view.pitch_deg};
    before = &view;
  }
  actions.resize(kLitchiActions);
  for (const Action& action : actions) {
    line += fmt::format(",{},{}", static_cast<int>(action.type), action.param);
  }
  return line + fmt::format(",0,{:.1f},0,0,0,0,-1,-1\n", options.pace.speed_m_per_s);
}

}  // namespace

std::vector<std::string> LitchiCsv(const Plan& plan, const MissionRoute& route,
                                   const MissionOptions& options) {
  const std::vector<MissionStop> stops = SplitStops(plan, route.stops, options);
  std::vector<std::string> files;
  constexpr size_t kPerFile = kLitchiWaypoints - 2;  // the approach takes two
  for (size_t begin = 0; begin < stops.size(); begin += kPerFile) {
    const size_t end = std::min(begin + kPerFile, stops.size());
    const std::vector<MissionStop> part(stops.begin() + static_cast<std::ptrdiff_t>(begin),
                                        stops.begin() + static_cast<std::ptrdiff_t>(end));
    std::string text = Header();
    Attitude attitude;
    for (const MissionStop& stop : WithApproach(plan, route, part)) {
      text += Line(stop, options, attitude);
    }
    files.push_back(std::move(text));
  }
  return files;
}

std::vector<std::string> LitchiSettings(const MissionRoute& route, const MissionOptions& options) {
  return {
      "Heading Mode: Custom (WD); else all headings are ignored",
      "Path Mode: Straight Lines; curves leave the free space",
      "Finish Action: RTH",
      fmt::format("Cruising Speed and Max Flight Speed: {:.0f} m/s", options.pace.speed_m_per_s),
      "Default Gimbal Pitch Mode: Interpolate; altitudes relative to take-off, not above ground",
      fmt::format("Return-to-home altitude (in the DJI app): {:.0f} m",
                  std::ceil(route.return_height_m)),
  };
}

}  // namespace stucco::plan
