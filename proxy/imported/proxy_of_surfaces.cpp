// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/imported/proxy_of_surfaces.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "proxy/cloud/samples.h"
#include "proxy/imported/fit_to_points.h"
#include "proxy/imported/flat_pieces.h"
#include "proxy/imported/measure_support.h"
#include "proxy/imported/sort_pieces.h"
#include "proxy/imported/welded_model.h"
#include "proxy/map/facade_ids.h"
#include "proxy/output/proxy_files.h"
#include "proxy/solids/soundness.h"
#include "survey/error.h"

namespace stucco {
namespace {

using Eigen::Vector3d;

constexpr double kFlat_m = 0.01;
constexpr double kFlatShare = 1e-4;  // of the extent, where a unit is no metre
constexpr double kReach_m = 0.15;    // of a facet's points
constexpr double kReachShare = 2e-3;
constexpr double kCell_m = 0.2;
constexpr size_t kMostFacets = 20'000;
constexpr size_t kFitPoints = 4000;
constexpr double kAround_m = 8;  // points of the survey that may be of the model
constexpr double kAroundShare = 0.2;
constexpr double kLeastInPictures = 0.02;
constexpr double kFewNear = 0.05;

class Maker {
 public:
  Maker(SurfaceModel model, const SurfaceSurvey& survey, const std::string& file)
      : model_(std::move(model)), survey_(survey), file_(file) {
    out_.notes = model_.notes;
    up_ = survey.georef.up.value_or(Vector3d::UnitZ());
    upright_from_world_ = Eigen::Quaterniond::FromTwoVectors(up_, Vector3d::UnitZ());
    ForCorners(model_, [&](Vector3d& corner) {
      corner = upright_from_world_ * corner;
      box_.extend(corner);
    });
  }

  SurfaceProxy Make(bool moves) {
    const std::vector<Vector3d> points = PointsAround();
    if (moves && metric() && !points.empty()) Fit(points);
    RequireAmong(points);
    MakeFacets();
    RequireInPictures();
    Measure();
    Name();
    if (const auto problem = FindProblem(out_.proxy)) {
      throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", file_, *problem),
                  "check the model with a validator, such as val3dity");
    }
    return std::move(out_);
  }

 private:
  bool metric() const { return survey_.georef.metric; }
  double Extent() const { return box_.sizes().maxCoeff(); }
  double Around() const { return metric() ? kAround_m : kAroundShare * Extent(); }

  // A sample of the points about the model, upright.
  std::vector<Vector3d> PointsAround() const {
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(Around());
    const Eigen::AlignedBox2d around(box_.min().head<2>() - margin, box_.max().head<2>() + margin);
    std::vector<Vector3d> all;
    const auto add = [&](const Vector3d& world) {
      const Vector3d p = upright_from_world_ * world;
      if (around.contains(Eigen::Vector2d(p.head<2>()))) all.push_back(p);
    };
    if (survey_.cloud.empty()) {
      for (const Vector3d& p : survey_.points) add(p);
    } else {
      const PointStream stream = StreamOf(survey_.cloud);
      const size_t step = stream.count / (25 * kFitPoints) + 1;
      size_t number = 0;
      stream.for_each([&](const CloudPoint& point) {
        if (number++ % step == 0) add(point.position);
      });
    }
    std::vector<Vector3d> some;
    const double step = std::max(1.0, static_cast<double>(all.size()) / kFitPoints);
    for (double i = 0; i < static_cast<double>(all.size()); i += step) {
      some.push_back(all[static_cast<size_t>(i)]);
    }
    return some;
  }

  void Fit(const std::vector<Vector3d>& points) {
    const UprightMove move = FitToPoints(model_, points);
    if (move.near_after < kFewNear) {
      out_.notes.push_back(fmt::format(
          "it stays where it was: nowhere near do more than {:.0f} % of the points around "
          "it lie within 0.2 m of it",
          100 * move.near_after));
      return;
    }
    if (move.shift.norm() == 0) return;
    box_.setEmpty();
    ForCorners(model_, [&](Vector3d& corner) {
      corner = move * corner;
      box_.extend(corner);
    });
    out_.notes.push_back(fmt::format(
        "it was moved onto the survey's points, {:.2f} m east, {:.2f} m north, {:.2f} m up and "
        "turned by {:.2f} degrees: {:.0f} % of those around it lie within 0.2 m of it, before "
        "{:.0f}",
        move.shift.x(), move.shift.y(), move.shift.z(), move.yaw_rad * 180 / std::numbers::pi,
        100 * move.near_after, 100 * move.near_before));
  }

  void MakeFacets() {
    const double flat = metric() ? kFlat_m : kFlatShare * Extent();
    WeldedModel welded = Weld(model_, flat);
    std::vector<FlatPiece> pieces = FindFlatPieces(welded, flat);
    if (pieces.size() > kMostFacets) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: its {} polygons lie in {} planes; pictures are painted plane by "
                              "plane, of at most {}",
                              file_, welded.polygons.size(), pieces.size(), kMostFacets),
                  "import a model of planes, not a mesh of points, or let stucco make its own "
                  "(stucco proxy --force)");
    }
    Settle(flat, welded, pieces);
    Note(welded.doubled, "polygons were there twice, and are once");
    Note(welded.empty, "polygons without area are left out");
    out_.proxy.buildings = SortPieces(model_, welded, std::move(pieces),
                                      [&](const Facet& facet) { return IsSeenFromBehind(facet); });
    out_.proxy.up = up_;
    out_.proxy.metric = metric();
    LeaveOutUnsound();
    TurnBack();
  }

  void Note(int count, const char* what) {
    if (count > 0) out_.notes.push_back(fmt::format("{} {}", count, what));
  }

  void LeaveOutUnsound() {
    int left_out = 0;
    for (Building& building : out_.proxy.buildings) {
      const auto unsound = std::erase_if(
          building.facets, [](const Facet& facet) { return FindFacetFault(facet).has_value(); });
      left_out += static_cast<int>(unsound);
      if (unsound > 0) building.watertight = false;
    }
    std::erase_if(out_.proxy.buildings,
                  [](const Building& building) { return building.facets.empty(); });
    Note(left_out, "facets cross themselves and are left out");
  }

  // From upright to the world.
  void TurnBack() {
    const Eigen::Quaterniond world_from_upright = upright_from_world_.conjugate();
    for (Building& building : out_.proxy.buildings) {
      for (Facet& facet : building.facets) {
        facet.normal = world_from_upright * facet.normal;
        for (Vector3d& p : facet.outer) p = world_from_upright * p;
        for (auto& hole : facet.holes) {
          for (Vector3d& p : hole) p = world_from_upright * p;
        }
      }
    }
  }

  static Vector3d MiddleOf(const Facet& facet) {
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& p : facet.outer) sum += p;
    return sum / static_cast<double>(facet.outer.size());
  }

  static bool Shows(const SurveyPhoto& photo, const Vector3d& world) {
    const auto pixel = photo.camera.Project(photo.cam_from_world * world);
    return pixel && photo.camera.Contains(*pixel);
  }

  // Of the photos whose picture has its middle, by which side they stand on; nothing is known of
  // what lies between. `facet` is upright.
  bool IsSeenFromBehind(const Facet& facet) const {
    const Vector3d middle = upright_from_world_.conjugate() * MiddleOf(facet);
    const Vector3d normal = upright_from_world_.conjugate() * facet.normal;
    int front = 0;
    int back = 0;
    for (const SurveyPhoto& photo : survey_.photos) {
      if (!Shows(photo, middle)) continue;
      ++(normal.dot(photo.cam_from_world.Center() - middle) > 0 ? front : back);
    }
    return front == 0 && back > 0;
  }

  void RequireInPictures() const {
    double all = 0;
    double shown = 0;
    for (const Building& building : out_.proxy.buildings) {
      for (const Facet& facet : building.facets) {
        const Vector3d middle = MiddleOf(facet);
        all += facet.area;
        shown += std::ranges::any_of(survey_.photos,
                                     [&](const SurveyPhoto& photo) { return Shows(photo, middle); })
                     ? facet.area
                     : 0;
      }
    }
    if (!(shown > 0 && shown >= kLeastInPictures * all)) RefuseItsPlace();
  }

  // Poses of other programs may come without points: then pictures alone must tell.
  void RequireAmong(const std::vector<Vector3d>& points) const {
    if (survey_.cloud.empty() && survey_.points.empty()) return;
    const Vector3d margin = Vector3d::Constant(Around());
    const Eigen::AlignedBox3d around(box_.min() - margin, box_.max() + margin);
    const bool any =
        std::ranges::any_of(points, [&](const Vector3d& p) { return around.contains(p); });
    if (!any) RefuseItsPlace();
  }

  [[noreturn]] void RefuseItsPlace() const {
    Vector3d camera = Vector3d::Zero();
    for (const SurveyPhoto& photo : survey_.photos) {
      camera += photo.cam_from_world.Center() / static_cast<double>(survey_.photos.size());
    }
    const Vector3d centre = upright_from_world_.conjugate() * box_.center();
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: no photo looks at it: its middle is {:.3g} {} from the middle of "
                            "the cameras",
                            file_, (centre - camera).norm(), metric() ? "m" : "units"),
                "say which coordinate system it is in (--crs EPSG:n), what was taken off its "
                "coordinates (--offset X,Y,Z) and which axis is up (--up)");
  }

  void Measure() {
    if (survey_.cloud.empty()) {
      out_.notes.emplace_back(
          "there is no cloud yet: what of it the photos show is not measured; run until dense and "
          "import it again to have that in the report");
      return;
    }
    MeasureSupport(StreamOf(survey_.cloud), metric() ? kReach_m : kReachShare * Extent(),
                   metric() ? kCell_m : kReachShare * Extent(), out_.proxy);
  }

  void Name() {
    if (!survey_.plan || survey_.georef.frame != "enu") return;
    const FacadeNaming naming = NameFacades(*survey_.plan, survey_.georef, out_.proxy);
    if (!naming.shift_m) {
      out_.notes.emplace_back("its walls are not where the plan has facades");
      return;
    }
    out_.notes.push_back(fmt::format("{} of its {} walls are parts of {} of the plan's {} facades",
                                     naming.named, naming.walls, naming.facades,
                                     survey_.plan->facades.size()));
  }

  SurfaceModel model_;
  const SurfaceSurvey& survey_;
  const std::string& file_;
  Vector3d up_;
  Eigen::Quaterniond upright_from_world_;
  Eigen::AlignedBox3d box_;
  SurfaceProxy out_;
};

}  // namespace

SurfaceProxy ProxyOfSurfaces(SurfaceModel model, const SurfaceSurvey& survey, bool moves,
                             const std::string& file) {
  return Maker(std::move(model), survey, file).Make(moves);
}

}  // namespace stucco
