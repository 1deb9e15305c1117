// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/summarize_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stucco {
namespace {

constexpr char kGreen[] = "green";
constexpr char kAmber[] = "amber";
constexpr char kRed[] = "red";

constexpr double kMuchShift_m = 1;
// Geoid heights are below 10 m hardly anywhere in Europe, and receivers err less.
constexpr double kTwoHeightSystems_m = 10;

std::string NameOf(PointState state) {
  switch (state) {
    case PointState::kUsed:
      return "used";
    case PointState::kMeasured:
      return "measured";
    case PointState::kBlunder:
      return "blunder";
    case PointState::kUnused:
      return "unused";
    case PointState::kNotSeen:
      break;
  }
  return "not seen";
}

// An error horizontally and vertically against pixels on the ground.
std::string Light(double horizontal_m, double vertical_m, double ground_pixel_m,
                  const Eigen::Vector3d& sigma_m) {
  const double horizontal = horizontal_m / std::max(kGreenHorizontal_pixels * ground_pixel_m,
                                                    std::hypot(sigma_m.x(), sigma_m.y()));
  const double vertical =
      vertical_m / std::max(kGreenVertical_pixels * ground_pixel_m, sigma_m.z());
  const double worst = std::max(horizontal, vertical);
  if (worst <= 1) return kGreen;
  return worst <= kRedOverGreen ? kAmber : kRed;
}

CalibratedPoint SummarizePoint(const MarkedPoint& marked, const PointOutcome& outcome,
                               const Eigen::Vector3d& sigma_m) {
  CalibratedPoint point;
  point.name = marked.name;
  point.role = marked.role == PointRole::kCheck ? "check" : "control";
  point.state = NameOf(outcome.state);
  point.why = outcome.why;
  point.photos = static_cast<int>(outcome.measured.used.size());
  if (!outcome.measured.position) return point;
  point.reprojection_error_px = outcome.measured.reprojection_error_px;
  if (!outcome.error_m) return point;
  const Eigen::Vector3d& error = *outcome.error_m;
  point.error_m = {error.x(), error.y(), error.z()};
  point.ground_pixel_m = outcome.measured.ground_pixel;
  point.verdict =
      Light(std::hypot(error.x(), error.y()), std::abs(error.z()), point.ground_pixel_m, sigma_m);
  return point;
}

// Root mean squares of the points in one state; nothing where there are none.
std::optional<CalibratedPointSet> SummarizeSet(const std::vector<CalibratedPoint>& points,
                                               const std::string& state,
                                               const Eigen::Vector3d& sigma_m) {
  CalibratedPointSet set;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  double pixels = 0;
  double ground = 0;
  for (const CalibratedPoint& point : points) {
    if (point.state != state || point.error_m.empty()) continue;
    ++set.points;
    squares += Eigen::Map<const Eigen::Vector3d>(point.error_m.data()).cwiseAbs2();
    pixels += point.reprojection_error_px * point.reprojection_error_px;
    ground += point.ground_pixel_m;
  }
  if (set.points == 0) return std::nullopt;
  set.east_rms_m = std::sqrt(squares.x() / set.points);
  set.north_rms_m = std::sqrt(squares.y() / set.points);
  set.horizontal_rms_m = std::sqrt((squares.x() + squares.y()) / set.points);
  set.vertical_rms_m = std::sqrt(squares.z() / set.points);
  set.reprojection_error_px = std::sqrt(pixels / set.points);
  set.ground_pixel_m = ground / set.points;
  set.verdict = Light(set.horizontal_rms_m, set.vertical_rms_m, set.ground_pixel_m, sigma_m);
  return set;
}

std::string Sentence(const char* kind, const CalibratedPointSet& set) {
  return fmt::format(
      "{} {} point{}: {:.3f} m horizontal, {:.3f} m vertical (root mean square; {:.1f} and {:.1f} "
      "pixels on the ground): {}",
      set.points, kind, set.points == 1 ? "" : "s", set.horizontal_rms_m, set.vertical_rms_m,
      set.horizontal_rms_m / set.ground_pixel_m, set.vertical_rms_m / set.ground_pixel_m,
      set.verdict);
}

// The check point that is worst, where the set is not good.
std::string WorstCheck(const std::vector<CalibratedPoint>& points) {
  const CalibratedPoint* worst = nullptr;
  double most = 0;
  for (const CalibratedPoint& point : points) {
    if (point.state != "measured" || point.error_m.empty()) continue;
    const double error = Eigen::Map<const Eigen::Vector3d>(point.error_m.data()).norm();
    if (error <= most) continue;
    most = error;
    worst = &point;
  }
  if (worst == nullptr) return {};
  return fmt::format("; the worst is {} with {:.3f} m", worst->name, most);
}

void AddShift(const ControlOutcome& outcome, Calibration& calibration) {
  if (!outcome.positions_shift_m) return;
  const Eigen::Vector3d& shift = *outcome.positions_shift_m;
  calibration.records.shift_m = {shift.x(), shift.y(), shift.z()};
  if (shift.norm() < kMuchShift_m) return;
  std::string finding = fmt::format(
      "the photos' recorded positions are off by {:.2f} m east, {:.2f} m north and {:.2f} m up "
      "against the control points, which was taken into account",
      shift.x(), shift.y(), shift.z());
  if (std::abs(shift.z()) > kTwoHeightSystems_m) {
    finding +=
        "; heights above the ellipsoid and above the sea differ by tens of metres: those of the "
        "result are in the system of the control points";
  }
  calibration.findings.push_back(std::move(finding));
}

void AddControlFindings(const GroundControl& control, const ControlOutcome& outcome,
                        Calibration& calibration) {
  std::vector<std::string>& findings = calibration.findings;
  if (!outcome.why_not.empty()) {
    findings.push_back(outcome.georef ? outcome.why_not
                                      : "control points do not hold the model: " + outcome.why_not);
  }
  for (const CalibratedPoint& point : calibration.ground_control) {
    if (point.why.empty()) continue;
    findings.push_back(
        fmt::format("{} point {} {}", point.role, point.name,
                    point.state == "blunder" ? point.why : fmt::format("({})", point.why)));
  }
  if (calibration.control_rms) findings.push_back(Sentence("control", *calibration.control_rms));
  if (calibration.check_rms) {
    const bool is_good = calibration.check_rms->verdict == kGreen;
    findings.push_back(Sentence("check", *calibration.check_rms) +
                       (is_good ? "" : WorstCheck(calibration.ground_control)));
  } else if (outcome.georef) {
    findings.push_back(
        "there are no check points, so nothing tells how accurate the model is away from the "
        "control points; write check behind one point in four or so");
  }
  findings.insert(findings.end(), control.problems.begin(), control.problems.end());
}

}  // namespace

void SummarizeControl(const GroundControl& control, const ControlOutcome& outcome,
                      const Eigen::Vector3d& sigma_m, Calibration& calibration) {
  for (size_t i = 0; i < outcome.points.size(); ++i) {
    calibration.ground_control.push_back(
        SummarizePoint(control.points[i], outcome.points[i], sigma_m));
  }
  calibration.control_rms = SummarizeSet(calibration.ground_control, "used", sigma_m);
  calibration.check_rms = SummarizeSet(calibration.ground_control, "measured", sigma_m);
  AddShift(outcome, calibration);
  AddControlFindings(control, outcome, calibration);
}

}  // namespace stucco
