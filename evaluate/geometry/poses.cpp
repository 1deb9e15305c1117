// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/poses.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "evaluate/geometry/align.h"
#include "evaluate/geometry/seen.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

struct Pair {
  std::string path;
  Pose truth, result;
};

std::string FileName(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

// Posed photos by their path, and by their file name where only one has it.
struct PhotosByName {
  std::map<std::string, const RegisteredImage*> by_path;
  std::map<std::string, std::vector<const RegisteredImage*>> by_file;

  explicit PhotosByName(const Reconstruction& reconstruction) {
    for (const auto& [id, photo] : reconstruction.photos) {
      by_path[photo.name] = &photo;
      by_file[FileName(photo.name)].push_back(&photo);
    }
  }
  const RegisteredImage* Find(const std::string& path) const {
    if (const auto found = by_path.find(path); found != by_path.end()) return found->second;
    const auto found = by_file.find(FileName(path));
    return found != by_file.end() && found->second.size() == 1 ? found->second[0] : nullptr;
  }
};

double AngleDeg(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return a.angularDistance(b) * 180 / std::numbers::pi;
}

struct Errors {
  int count = 0;
  double sum_m = 0, most_m = 0;
  double sum_deg = 0, most_deg = 0;

  void Add(double metres, double degrees) {
    ++count;
    sum_m += metres;
    sum_deg += degrees;
    most_m = std::max(most_m, metres);
    most_deg = std::max(most_deg, degrees);
  }
  double MeanMetres() const { return sum_m / count; }
  double MeanDegrees() const { return sum_deg / count; }
};

void Measure(const std::vector<Pair>& pairs, const Similarity& truth_from_world,
             PoseFigures& figures) {
  Errors errors;
  for (const Pair& pair : pairs) {
    const Pose aligned = Transformed(pair.result, truth_from_world);
    errors.Add((aligned.Center() - pair.truth.Center()).norm(),
               AngleDeg(aligned.rotation, pair.truth.rotation));
  }
  figures.position_mean_m = errors.MeanMetres();
  figures.position_max_m = errors.most_m;
  figures.rotation_mean_deg = errors.MeanDegrees();
  figures.rotation_max_deg = errors.most_deg;
}

// The rotation that takes directions of one tangent frame into the other, at a place.
Eigen::Quaterniond TurnBetweenFrames(const Georef& from, const Georef& to, const Vector3d& place) {
  constexpr double kStep_m = 10;
  Eigen::Matrix3d axes;
  for (int i = 0; i < 3; ++i) {
    const Vector3d step = kStep_m * Vector3d::Unit(i);
    axes.col(i) = BetweenFrames(from, to, place + step) - BetweenFrames(from, to, place - step);
  }
  return Eigen::Quaterniond(Eigen::Matrix3d(axes / (2 * kStep_m))).normalized();
}

void MeasureGeoreferenced(const std::vector<Pair>& pairs, const Georef& survey, const Georef& scene,
                          PoseComparison& comparison) {
  if (survey.frame != "enu" || scene.frame != "enu") {
    comparison.notes.push_back(
        fmt::format("georeferenced positions are not measured: the frame of the {} is \"{}\"",
                    survey.frame != "enu" ? "survey" : "scene",
                    survey.frame != "enu" ? survey.frame : scene.frame));
    return;
  }
  Errors errors;
  for (const Pair& pair : pairs) {
    const Vector3d center = pair.result.Center();
    const Eigen::Quaterniond rotation =
        pair.result.rotation * TurnBetweenFrames(survey, scene, center).conjugate();
    errors.Add((BetweenFrames(survey, scene, center) - pair.truth.Center()).norm(),
               AngleDeg(rotation, pair.truth.rotation));
  }
  comparison.figures.georeferenced_mean_m = errors.MeanMetres();
  comparison.figures.georeferenced_max_m = errors.most_m;
  comparison.figures.georeferenced_rotation_mean_deg = errors.MeanDegrees();
  comparison.figures.georeferenced_rotation_max_deg = errors.most_deg;
}

void NoteOutliers(const std::vector<Pair>& pairs, const Alignment& alignment,
                  PoseComparison& comparison) {
  size_t count = 0;
  double least_m = std::numeric_limits<double>::infinity();
  double most_m = 0;
  std::string worst;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (alignment.used[i]) continue;
    ++count;
    const Pose aligned = Transformed(pairs[i].result, alignment.target_from_source);
    const double off_m = (aligned.Center() - pairs[i].truth.Center()).norm();
    least_m = std::min(least_m, off_m);
    if (off_m < most_m) continue;
    most_m = off_m;
    worst = pairs[i].path;
  }
  if (count == 0) return;
  comparison.notes.push_back(fmt::format(
      "{} of {} positions are much worse than the others, off by {:.3f} to {:.3f} m, {} most; they "
      "count in every figure, but not in the alignment",
      count, pairs.size(), least_m, most_m, worst));
}

void Align(const std::vector<Pair>& pairs, PoseComparison& comparison) {
  Eigen::Matrix3Xd source(3, pairs.size()), target(3, pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    source.col(static_cast<Eigen::Index>(i)) = pairs[i].result.Center();
    target.col(static_cast<Eigen::Index>(i)) = pairs[i].truth.Center();
  }
  const std::optional<Alignment> alignment = AlignRobustly(source, target);
  if (!alignment) {
    comparison.notes.push_back(fmt::format(
        "poses are not measured: {} posed photos are not three places off one line", pairs.size()));
    return;
  }
  comparison.truth_from_world = alignment->target_from_source;
  Measure(pairs, alignment->target_from_source, comparison.figures);
  NoteOutliers(pairs, *alignment, comparison);
}

}  // namespace

Vector3d BetweenFrames(const Georef& from, const Georef& to, const Vector3d& point) {
  const Vector3d geodetic = GeodeticFromEnu(from, point);
  return EnuFromGeodetic(to, geodetic[0], geodetic[1], geodetic[2]);
}

PoseComparison ComparePoses(const Reconstruction& result, const Georef& survey,
                            const simulate::Flight& truth, const Georef& scene) {
  const PhotosByName posed(result);
  std::vector<Pair> pairs;
  PoseComparison comparison;
  for (const simulate::FlownPhoto* photo : DeliveredPhotos(truth)) {
    ++comparison.figures.total;
    const RegisteredImage* found = posed.Find(photo->path);
    if (found) pairs.push_back({photo->path, photo->cam_from_world, found->cam_from_world});
  }
  comparison.figures.posed = static_cast<int>(pairs.size());
  if (pairs.size() < result.photos.size()) {
    comparison.notes.push_back(fmt::format("{} posed photos are none of the flight's",
                                           result.photos.size() - pairs.size()));
  }
  if (pairs.empty()) {
    comparison.notes.push_back("poses are not measured: no photo of the flight has a pose");
    return comparison;
  }
  Align(pairs, comparison);
  MeasureGeoreferenced(pairs, survey, scene, comparison);
  return comparison;
}

}  // namespace stucco::evaluate
