// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/hold_by_control.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "calib/control/fit_control.h"
#include "calib/records/georeference.h"
#include "survey/median.h"

namespace stucco {
namespace {

constexpr double kBlunder_sigmas = 5;
// What lenses bend beyond what the model of a lens knows is no fault of a point.
constexpr double kBlunder_pixels = 5;
constexpr int kMostRounds = 5;
constexpr size_t kLeastPoints = 3;

// In the frame that the outcome names, or that the scene has.
std::vector<Eigen::Vector3d> PositionsIn(const Georef& georef, const GroundControl& control) {
  std::vector<Eigen::Vector3d> positions;
  for (const MarkedPoint& point : control.points) {
    positions.push_back(PositionIn(georef, point.place));
  }
  return positions;
}

Eigen::Vector3d MedianOfShifts(const std::vector<PoseRecord>& records, const Scene& scene) {
  std::vector<double> axes[3];
  for (size_t i = 0; i < records.size(); ++i) {
    if (!records[i].position || !scene.photos[i].pose) continue;
    const Eigen::Vector3d shift = records[i].position->position - scene.photos[i].pose->Center();
    for (int axis = 0; axis < 3; ++axis) axes[axis].push_back(shift[axis]);
  }
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) median[axis] = Median(std::move(axes[axis])).value_or(0);
  return median;
}

// Moves the records, so that they lie in the frame of the control points.
void ShiftBack(const Eigen::Vector3d& shift, std::vector<PoseRecord>& records) {
  for (PoseRecord& record : records) {
    if (record.position) record.position->position -= shift;
  }
}

class ControlHolder {
 public:
  ControlHolder(const ControlInput& input, Scene& scene)
      : input_(input), control_(input.control), scene_(scene), records_(input.records) {
    has_records_ = input.georef.frame == "enu";
    outcome_.points.resize(control_.points.size());
  }

  ControlOutcome Hold() {
    frame_ = has_records_ ? input_.georef : FrameAtPoints(control_);
    frame_.source = kGroundControlSource;
    surveyed_ = PositionsIn(frame_, control_);
    Measure();
    if (Fit()) {
      Adjust();
      outcome_.georef = frame_;
      Measure();
    }
    Describe();
    return std::move(outcome_);
  }

 private:
  bool IsControl(size_t i) const { return control_.points[i].role == PointRole::kControl; }

  void Measure() {
    std::vector<MeasuredPoint> measured =
        MeasurePoints(scene_, control_.points, input_.mapper.min_angle_rad);
    for (size_t i = 0; i < measured.size(); ++i) {
      outcome_.points[i].measured = std::move(measured[i]);
    }
  }

  // Brings the scene to the points. False where too few of them agree.
  bool Fit() {
    std::vector<size_t> seen;
    std::vector<PointPair> pairs;
    const auto is_control = [](const MarkedPoint& p) { return p.role == PointRole::kControl; };
    if (std::ranges::none_of(control_.points, is_control)) return false;
    for (size_t i = 0; i < control_.points.size(); ++i) {
      const auto& position = outcome_.points[i].measured.position;
      if (!IsControl(i) || !position) continue;
      seen.push_back(i);
      pairs.push_back({*position, surveyed_[i]});
    }
    const ControlFit fit = FitControl(pairs, has_records_);
    if (!fit.surveyed_from_scene) {
      outcome_.why_not = fit.why_not;
      return false;
    }
    Transform(*fit.surveyed_from_scene, scene_);
    for (size_t k = 0; k < seen.size(); ++k) {
      const bool is_blunder = std::ranges::count(fit.blunders, static_cast<int>(k)) > 0;
      if (is_blunder) {
        NameBlunder(seen[k], *fit.surveyed_from_scene * pairs[k].in_scene - surveyed_[seen[k]]);
      } else {
        used_.push_back(seen[k]);
        largest_residual_m_ = std::max(largest_residual_m_, fit.residual_m[k]);
      }
    }
    return true;
  }

  void NameBlunder(size_t i, const Eigen::Vector3d& error_m) {
    PointOutcome& point = outcome_.points[i];
    point.state = PointState::kBlunder;
    point.why = fmt::format(
        "is {:.2f} m ({:.2f} east, {:.2f} north, {:.2f} up) from where the other control points "
        "put it and is not used; check its coordinates and marks",
        error_m.norm(), error_m.x(), error_m.y(), error_m.z());
    input_.context.progress->Warn(
        fmt::format("{}: {} {}", control_.file, control_.points[i].name, point.why));
  }

  void Adjust() {
    if (has_records_) FoldShift(MedianOfShifts(records_, scene_));
    // A model that nothing held before may be bent: no point may look wrong because of that.
    scene_.control = SceneControl{};
    scene_.control.mark_sigma_px = kMarkSigma_px;
    const double usual = scene_.control.loss_scale;
    const double wide = largest_residual_m_ / input_.sigma_m.minCoeff();
    scene_.control.loss_scale = std::max(usual, wide);
    for (int round = 0; round < kMostRounds; ++round) {
      SetPoints();
      ApplyRecordsAgain();
      if (scene_.control.loss_scale > usual) {
        Settle(input_.mapper, true, input_.context, scene_);
      }
      Converge(input_.mapper, true, input_.context, scene_);
      if (has_records_) FoldShift(std::exchange(scene_.control.positions_shift_m, {0, 0, 0}));
      const bool was_wide = scene_.control.loss_scale > usual;
      scene_.control.loss_scale = usual;
      Measure();
      if (!DropBlunders() && !was_wide) break;
    }
    ApplyRecordsAgain();
    if (has_records_) outcome_.placed_records = records_;
    // What the plan wished for was recorded by nobody.
    if (input_.georef.source == "plan") outcome_.positions_shift_m.reset();
  }

  void SetPoints() {
    scene_.control.points.clear();
    for (const size_t i : used_) {
      const MeasuredPoint& measured = outcome_.points[i].measured;
      // Where it was surveyed: the model is as good as there.
      scene_.control.points.push_back({surveyed_[i], input_.sigma_m, measured.used, surveyed_[i]});
    }
  }

  void FoldShift(const Eigen::Vector3d& shift) {
    ShiftBack(shift, records_);
    outcome_.positions_shift_m =
        outcome_.positions_shift_m.value_or(Eigen::Vector3d::Zero()) + shift;
  }

  void ApplyRecordsAgain() {
    if (!has_records_) return;
    outcome_.records = MeasureRecordErrors(records_, scene_);
    ApplyRecords(records_, *outcome_.records, scene_);
  }

  // Of the difference between where a point was measured and surveyed, in standard deviations.
  double Deviation(size_t i) const {
    const MeasuredPoint& measured = outcome_.points[i].measured;
    const Eigen::Vector3d error = *measured.position - surveyed_[i];
    const Eigen::Matrix3d variance =
        Eigen::Matrix3d(input_.sigma_m.cwiseAbs2().asDiagonal()) + measured.covariance;
    return std::sqrt(error.dot(variance.inverse() * error));
  }

  // Points that contradict the others as adjusted. Returns whether some were taken out.
  bool DropBlunders() {
    std::erase_if(used_, [&](size_t i) { return !outcome_.points[i].measured.position; });
    std::vector<std::pair<size_t, double>> wrong;
    double worst = 0;
    for (const size_t i : used_) {
      const MeasuredPoint& measured = outcome_.points[i].measured;
      const double deviation = Deviation(i);
      const double error_m = (*measured.position - surveyed_[i]).norm();
      if (deviation < kBlunder_sigmas || error_m < kBlunder_pixels * measured.ground_pixel)
        continue;
      wrong.emplace_back(i, deviation);
      worst = std::max(worst, deviation);
    }
    // What a blunder pulls along is off by less.
    std::erase_if(wrong, [&](const auto& point) { return point.second < 0.6 * worst; });
    if (wrong.empty()) return false;
    const size_t least = has_records_ ? kLeastPoints : kLeastPoints + 1;
    if (used_.size() < wrong.size() + least || 2 * wrong.size() >= used_.size()) {
      outcome_.why_not = fmt::format(
          "control points contradict each other by up to {:.1f} of their standard deviations, and "
          "which of them is wrong cannot be told; check coordinates and marks, or give more points",
          worst);
      return false;
    }
    for (const auto& [i, deviation] : wrong) {
      NameBlunder(i, *outcome_.points[i].measured.position - surveyed_[i]);
      std::erase(used_, i);
    }
    return true;
  }

  // States and errors of all points.
  void Describe() {
    const bool is_placed = outcome_.georef || input_.georef.frame == "enu";
    for (size_t i = 0; i < control_.points.size(); ++i) {
      PointOutcome& point = outcome_.points[i];
      if (!point.measured.position) {
        if (point.state != PointState::kBlunder) point.why = point.measured.why_not;
        continue;
      }
      if (is_placed) point.error_m = *point.measured.position - surveyed_[i];
      if (point.state == PointState::kBlunder) continue;
      if (!IsControl(i)) {
        point.state = PointState::kMeasured;
      } else {
        point.state = outcome_.georef ? PointState::kUsed : PointState::kUnused;
      }
      point.why = DescribeRefused(point.measured);
    }
  }

  std::string DescribeRefused(const MeasuredPoint& measured) const {
    std::string text;
    for (const PhotoMark& mark : measured.refused) {
      const auto pixel =
          scene_.CameraOf(mark.photo).Project(*scene_.photos[mark.photo].pose * *measured.position);
      text += text.empty() ? "marks not used: " : ", ";
      text += scene_.photos[mark.photo].name;
      text +=
          pixel ? fmt::format(" ({:.0f} px off)", (*pixel - mark.pixel).norm()) : " (behind it)";
    }
    return text;
  }

  const ControlInput& input_;
  const GroundControl& control_;
  Scene& scene_;
  std::vector<PoseRecord> records_;  // in the frame of the points, as far as it is known
  bool has_records_ = false;         // positions hold the scene's frame
  Georef frame_;
  std::vector<Eigen::Vector3d> surveyed_;  // by point, in that frame
  std::vector<size_t> used_;
  double largest_residual_m_ = 0;
  ControlOutcome outcome_;
};

}  // namespace

ControlOutcome HoldByControl(const ControlInput& input, Scene& scene) {
  assert(IsConsistent(scene));
  assert(input.records.size() == scene.photos.size());
  return ControlHolder(input, scene).Hold();
}

}  // namespace stucco
