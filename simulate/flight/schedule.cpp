// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>

#include "plan/path/energy.h"
#include "simulate/flight/daylight.h"
#include "simulate/random.h"
#include "survey/error.h"

namespace stucco::simulate {
namespace {

constexpr uint64_t kHoverSeed = 0x4077;
constexpr uint64_t kViewSeed = 0x71E3;
constexpr uint64_t kChoiceSeed = 0xC401;
constexpr uint64_t kHeldOutSeed = 0x8E1D;

constexpr double kTwice_s = 0.7;  // between a photo and its double
constexpr double kNewBattery_s = 240;

std::vector<int> ViewsInOrder(const Plan& plan) {
  std::vector<int> order(plan.views.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return plan.views[a].order < plan.views[b].order; });
  return order;
}

// Exactly the share, rounded, of those that are not left out; the same ones at the same seed.
std::vector<bool> Chosen(const std::vector<bool>& left_out, double share, uint64_t seed) {
  std::vector<size_t> order;
  for (size_t i = 0; i < left_out.size(); ++i) {
    if (!left_out[i]) order.push_back(i);
  }
  const auto wanted = static_cast<size_t>(std::lround(share * static_cast<double>(order.size())));
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return SeedOf(seed, a) < SeedOf(seed, b); });
  std::vector<bool> chosen(left_out.size(), false);
  for (size_t i = 0; i < std::min(wanted, order.size()); ++i) chosen[order[i]] = true;
  return chosen;
}

// Time from one view to the next along the way that was planned.
double SecondsBetween(const Plan& plan, const PlannedView* from, const PlannedView& to) {
  if (from == nullptr) return 0;
  const PlannedPace& pace = plan.pace;
  const double photo_s = plan::PhotoSeconds(pace);
  if (from->flight != to.flight) {
    const double feeders_m = (from->position_m - plan.HomeOf(from->flight)).norm() +
                             (to.position_m - plan.HomeOf(to.flight)).norm();
    return plan::LegSeconds(feeders_m, pace) + pace.ground_s + kNewBattery_s + pace.stop_s +
           photo_s;
  }
  const double turn_s = plan::TurnSeconds(from->yaw_deg, to.yaw_deg, pace);
  const double tilt_s = plan::TiltSeconds(from->pitch_deg, to.pitch_deg, pace);
  if (from->hover == to.hover) return turn_s + tilt_s + photo_s;
  const double leg_s = plan::LegSeconds((to.position_m - from->position_m).norm(), pace);
  return std::max(leg_s, turn_s) + pace.stop_s + tilt_s + photo_s;
}

// Walks through the days: photos are taken between the hour of the start and the lowest sun.
class Clock {
 public:
  Clock(const FlightOptions& options, double latitude_deg)
      : latitude_deg_(latitude_deg), start_hour_(options.start_hour), day_(options.day_of_year) {
    RequireLight();
  }

  void Advance(double seconds) {
    today_s_ += seconds;
    total_s_ += seconds;
    if (IsLight(Hour())) return;
    total_s_ += 24 * 3600 - today_s_;
    today_s_ = 0;
    ++day_;
    RequireLight();
  }
  double Hour() const { return start_hour_ + today_s_ / 3600; }

  void Stamp(Shot& shot) const {
    shot.day = day_;
    shot.hour = Hour();
    shot.time_s = total_s_;
  }

 private:
  bool IsLight(double hour) const {
    return SunElevation_deg(latitude_deg_, day_, hour) >= kLowestSun_deg;
  }
  // For a quarter of an hour at least: days of a photo each would never end.
  void RequireLight() const {
    constexpr double kShortest_h = 0.25;
    if (IsLight(start_hour_) && IsLight(start_hour_ + kShortest_h)) return;
    throw Error(
        ErrorKind::kUsage,
        fmt::format("start_hour {:g}: on day {} the sun is lower than {:g} degrees within a "
                    "quarter of an hour",
                    start_hour_, day_, kLowestSun_deg),
        "choose an hour nearer to noon, or another day_of_year");
  }

  double latitude_deg_;
  double start_hour_;
  int day_;
  double today_s_ = 0;
  double total_s_ = 0;
};

GimbalAngles WithNoise(const PlannedView& view, double sigma_deg, Random& random) {
  GimbalAngles angles;
  angles.yaw_deg = view.yaw_deg + sigma_deg * random.Normal();
  // Gimbals stop at straight down.
  angles.pitch_deg = std::max(-90.0, view.pitch_deg + sigma_deg * random.Normal());
  constexpr double kRollShare = 0.3;  // the horizon is what gimbals hold best
  angles.roll_deg = kRollShare * sigma_deg * random.Normal();
  return angles;
}

Shot RealShot(const Plan& plan, int index, const FlightOptions& options) {
  const PlannedView& view = plan.views[index];
  const auto seed = static_cast<uint64_t>(options.seed);
  Random at_hover(SeedOf(SeedOf(seed, kHoverSeed), static_cast<uint64_t>(view.hover)));
  Random of_view(SeedOf(SeedOf(seed, kViewSeed), static_cast<uint64_t>(index)));
  constexpr double kDriftShare = 0.1;
  Shot shot;
  shot.view = index;
  shot.flight = view.flight;
  shot.position_m =
      view.position_m + options.position_sigma_m *
                            (at_hover.NormalVector() * std::sqrt(1 - kDriftShare * kDriftShare) +
                             of_view.NormalVector() * kDriftShare);
  shot.angles = WithNoise(view, options.gimbal_sigma_deg, of_view);
  return shot;
}

// Local solar time.
std::chrono::sys_time<std::chrono::milliseconds> TimeOf(const Shot& shot) {
  constexpr std::chrono::sys_days kNewYear{std::chrono::year{2026} / 1 / 1};
  return kNewYear + std::chrono::days(shot.day - 1) +
         std::chrono::milliseconds(std::llround(shot.hour * 3600e3));
}

// Its year, month, day, hour, minute and second in a pattern of fmt.
std::string Written(const char* pattern, const Shot& shot) {
  const auto time = TimeOf(shot);
  const auto midnight = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(midnight);
  const std::chrono::hh_mm_ss clock(time - midnight);
  return fmt::format(fmt::runtime(pattern), static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

}  // namespace

std::vector<Shot> ScheduleShots(const Plan& plan, const FlightOptions& options) {
  if (plan.views.empty()) {
    throw Error(ErrorKind::kBadInput, "the plan has no views to fly to", "plan the survey again");
  }
  const uint64_t choices = SeedOf(static_cast<uint64_t>(options.seed), kChoiceSeed);
  const std::vector<bool> none(plan.views.size(), false);
  const auto lost = Chosen(none, options.lost_share, SeedOf(choices, 1));
  const auto twice = Chosen(lost, options.duplicate_share, SeedOf(choices, 2));
  Clock clock(options, plan.origin.latitude_deg);
  std::vector<Shot> shots;
  const PlannedView* before = nullptr;
  for (const int index : ViewsInOrder(plan)) {
    clock.Advance(SecondsBetween(plan, before, plan.views[index]));
    before = &plan.views[index];
    Shot shot = RealShot(plan, index, options);
    clock.Stamp(shot);
    shot.number = static_cast<int>(shots.size()) + 1;
    shot.lost = lost[index];
    shots.push_back(shot);
    if (!twice[index]) continue;
    clock.Advance(kTwice_s);
    clock.Stamp(shot);
    shot.number += 1;
    shot.duplicate_of = static_cast<int>(shots.size()) - 1;
    shots.push_back(shot);
  }
  return shots;
}

Shot HeldOutShot(const Plan& plan, const std::vector<Shot>& shots, const FlightOptions& options,
                 int number, int attempt) {
  const uint64_t seed = SeedOf(SeedOf(static_cast<uint64_t>(options.seed), kHeldOutSeed),
                               static_cast<uint64_t>(number));
  Random random(SeedOf(seed, static_cast<uint64_t>(attempt)));
  // Spread over the flight.
  const size_t near =
      std::min(shots.size() - 1, static_cast<size_t>((number - 1 + random.Unit()) *
                                                     static_cast<double>(shots.size()) /
                                                     std::max(1, options.held_out)));
  const PlannedView& view = plan.views[shots[near].view];
  Shot shot = shots[near];
  shot.view = -1;
  shot.lost = false;
  shot.duplicate_of = -1;
  shot.number = number;
  const double turn_rad = random.Uniform(0, 2 * std::numbers::pi);
  const double move_m = random.Uniform(1, 3);
  shot.position_m =
      view.position_m + Eigen::Vector3d(move_m * std::cos(turn_rad), move_m * std::sin(turn_rad),
                                        random.Uniform(-1, 1));
  shot.angles.yaw_deg = view.yaw_deg + random.Uniform(-10, 10);
  shot.angles.pitch_deg = std::clamp(view.pitch_deg + random.Uniform(-10, 10), -90.0, 20.0);
  shot.angles.roll_deg = 0;
  return shot;
}

std::string FileTime(const Shot& shot) {
  return Written("{}{:02d}{:02d}{:02d}{:02d}{:02d}", shot);
}

std::string ExifTime(const Shot& shot) {
  return Written("{}:{:02d}:{:02d} {:02d}:{:02d}:{:02d}", shot);
}

int Milliseconds(const Shot& shot) {
  return static_cast<int>(TimeOf(shot).time_since_epoch().count() % 1000);
}

std::string PhotoName(const Shot& shot, const std::string& view) {
  return fmt::format("DJI_{}_{:04d}_D_{}.JPG", FileTime(shot), shot.number, view);
}

}  // namespace stucco::simulate
