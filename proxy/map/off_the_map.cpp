// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/off_the_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>

#include "proxy/facets/outline.h"
#include "proxy/map/corners.h"
#include "proxy/map/floors.h"
#include "proxy/map/ground_around.h"
#include "proxy/map/move_edges.h"
#include "proxy/map/registration.h"

namespace stucco {
namespace {

constexpr double kSmallest_m2 = 10;
constexpr double kOverhang_m = 1.2;
// Roofs go on over this much of which one sees neither them nor anything below.
constexpr double kUnseen_m = 3;

bool IsInside(std::span<const Polygon> floors, std::span<const Eigen::AlignedBox2d> boxes,
              const Eigen::Vector2d& p) {
  for (size_t f = 0; f < floors.size(); ++f) {
    if (boxes[f].contains(p) && Contains(floors[f], p)) return true;
  }
  return false;
}

// A wall as a line of the ground plan, between the ends of its samples.
struct WallLine {
  static constexpr double kBin_m = 0.5;

  Eigen::Vector2d outwards;
  double offset = 0;
  double from = 0, to = 0;   // along the direction to the left of `outwards`
  std::vector<double> tops;  // of the wall, by half metres from `from`
  bool sure = false;         // large, none of leaves, and nothing shows right behind it
  std::vector<int> samples;

  Eigen::Vector2d Along() const { return {-outwards.y(), outwards.x()}; }

  // Where a place on a roof is: close before the wall as its eaves, or as what leans on it, below
  // more of the wall.
  enum class Before { kNot, kAsEaves, kLeaning };
  Before PlaceOf(const Eigen::Vector3d& p, const Eigen::Vector3d& roof_normal) const {
    constexpr double kAboveRoof_m = 0.5;
    const double off = outwards.dot(p.head<2>()) - offset, at = Along().dot(p.head<2>());
    if (!(off > 0 && off < kOverhang_m && at > from && at < to)) return Before::kNot;
    const double roof = p.z() + off * outwards.dot(roof_normal.head<2>()) / roof_normal.z();
    const bool more = tops[static_cast<size_t>((at - from) / kBin_m)] > roof + kAboveRoof_m;
    return more ? Before::kLeaning : Before::kAsEaves;
  }
  bool IsSeenAt(double at) const {
    return std::isfinite(tops[static_cast<size_t>((at - from) / kBin_m)]);
  }
  CutLine Crease() const {
    return {
        .point = outwards * offset, .direction = Along(), .crease = true, .from = from, .to = to};
  }
};

WallLine LineOf(const Segment2d& edge) {
  WallLine line;
  line.outwards = OutwardsOf(edge);
  line.offset = line.outwards.dot(edge.a);
  std::tie(line.from, line.to) = std::minmax({line.Along().dot(edge.a), line.Along().dot(edge.b)});
  return line;
}

// What of one cluster of planes lies beside all floors.
struct Beside {
  std::vector<int> roof;  // samples, without eaves and balconies
  std::vector<WallLine> walls;
};

// Samples that a plane of a roof has beside all floors.
struct RoofBeside {
  Eigen::Vector3d normal;
  std::vector<int> samples;
};

class NewFootprints {
 public:
  NewFootprints(const PlanarScene& scene, const UprightSurvey& survey,
                std::span<const Building> closed)
      : scene_(scene), survey_(survey), floors_(FootprintsOf(closed, UprightFromWorld(scene.up))) {
    for (const Polygon& floor : floors_) boxes_.push_back(stucco::BoundsOf(floor));
  }

  void Find(const std::vector<Plane>& cluster, std::vector<FittedBuilding>& found) const {
    const Beside beside = BesideFloors(cluster);
    if (beside.roof.empty()) return;
    const PlaneRaster raster = RasterOver(beside.roof);
    const cv::Mat votes = VotesForRoof(beside, raster);
    const cv::Mat roofed = Roofed(votes, raster);
    cv::Mat joined, patches, figures, middles;
    cv::morphologyEx(roofed, joined, cv::MORPH_CLOSE, Disc(kUnseen_m / 2, raster));
    joined.setTo(0, votes < 0);
    cv::bitwise_or(joined, roofed, joined);
    const int count = cv::connectedComponentsWithStats(joined, patches, figures, middles, 4);
    for (int patch = 1; patch < count; ++patch) {
      const int* box = figures.ptr<int>(patch);
      const cv::Rect around = WithMargin({box[cv::CC_STAT_LEFT], box[cv::CC_STAT_TOP],
                                          box[cv::CC_STAT_WIDTH], box[cv::CC_STAT_HEIGHT]},
                                         raster);
      cv::Mat hits = patches(around) == patch;
      cv::bitwise_and(hits, roofed(around), hits);
      if (cv::countNonZero(hits) * raster.cell * raster.cell < kSmallest_m2) continue;
      AddOutlines(PatchOf(raster, around, hits, votes(around)), beside.walls, found);
    }
  }

 private:
  Beside BesideFloors(const std::vector<Plane>& cluster) const {
    constexpr double kRoof = 0.26;  // cosine: 75 degrees of pitch
    constexpr size_t kFewest = 12;
    Beside beside;
    const Eigen::Matrix3d upright_from_world = UprightFromWorld(scene_.up);
    std::vector<RoofBeside> roofs;
    for (const Plane& plane : cluster) {
      const Eigen::Vector3d normal = upright_from_world * plane.normal;
      std::vector<int> outside;
      double low = INFINITY, high = -INFINITY;
      for (const int i : plane.points) {
        const Eigen::Vector3d& p = survey_.samples.positions[i];
        if (IsInside(floors_, boxes_, p.head<2>())) continue;
        outside.push_back(i);
        low = std::min(low, p.z());
        high = std::max(high, p.z());
      }
      if (normal.z() > kRoof) {
        if (IsOfLeaves(scene_, plane)) continue;
        roofs.push_back({normal, std::move(outside)});
      } else if (LooksLikeWall(normal) && outside.size() >= kFewest && high - low > kRaised_m) {
        // The inner faces of parapets are lower, and look at the roof.
        beside.walls.push_back(WallOf(plane, normal, outside));
        beside.walls.back().sure = plane.area > kSmallest_m2 && !IsOfLeaves(scene_, plane);
      }
    }
    for (WallLine& wall : beside.walls) {
      wall.sure = wall.sure && !std::ranges::any_of(beside.walls, [&](const WallLine& other) {
                    return ShowsBehind(wall, other);
                  });
    }
    for (const RoofBeside& roof : roofs) AddRoof(roof, beside);
    return beside;
  }

  // Whether the other one is a wall that shows between this one's pieces: fronts of balconies stand
  // in a plane of their own before it. A wall hides what stands behind it below its top.
  bool ShowsBehind(const WallLine& front, const WallLine& other) const {
    constexpr double kSameWay = 0.98;   // cosine of 11 degrees
    constexpr double kNearest_m = 0.4;  // deeper than panes and doors lie back
    constexpr double kFarthest_m = 2.2;
    constexpr double kMuch = 0.25;  // of its own samples
    if (front.outwards.dot(other.outwards) < kSameWay) return false;
    size_t behind = 0;
    for (const int i : other.samples) {
      const Eigen::Vector3d& p = survey_.samples.positions[i];
      const double off = front.offset - front.outwards.dot(p.head<2>());
      const double at = front.Along().dot(p.head<2>());
      if (off < kNearest_m || off > kFarthest_m || at < front.from || at > front.to) continue;
      const double top = front.tops[static_cast<size_t>((at - front.from) / WallLine::kBin_m)];
      behind += p.z() < top - kNearest_m;
    }
    return static_cast<double>(behind) > kMuch * static_cast<double>(front.samples.size());
  }

  // The roof of a wing that leans on a wall goes on far before it; balconies end there.
  void AddRoof(const RoofBeside& from, Beside& beside) const {
    constexpr double kMostLeaning = 0.5;
    constexpr double kSameWay = 0.87;  // cosine of 30 degrees: leaves that touch a roof look away
    std::vector<int> roof;
    size_t leaning = 0;
    for (const int i : from.samples) {
      const Eigen::Vector3d& p = survey_.samples.positions[i];
      bool leans = false, is_eaves = false;
      for (const WallLine& wall : beside.walls) {
        const WallLine::Before place = wall.PlaceOf(p, from.normal);
        leans = leans || place == WallLine::Before::kLeaning;
        is_eaves = is_eaves || place == WallLine::Before::kAsEaves;
      }
      if (leans) ++leaning;
      if (!is_eaves && survey_.samples.normals[i].dot(from.normal) > kSameWay) roof.push_back(i);
    }
    if (leaning > kMostLeaning * static_cast<double>(from.samples.size())) return;
    beside.roof.insert(beside.roof.end(), roof.begin(), roof.end());
  }

  WallLine WallOf(const Plane& plane, const Eigen::Vector3d& normal,
                  const std::vector<int>& samples) const {
    WallLine wall;
    wall.samples = samples;
    wall.outwards = normal.head<2>().normalized();
    wall.offset = plane.offset / normal.head<2>().norm();
    std::vector<double> along;
    along.reserve(samples.size());
    for (const int i : samples) {
      along.push_back(wall.Along().dot(survey_.samples.positions[i].head<2>()));
    }
    std::ranges::sort(along);
    const size_t stray = along.size() / 50;
    wall.from = along[stray];
    wall.to = along[along.size() - 1 - stray];
    wall.tops.assign(static_cast<size_t>((wall.to - wall.from) / WallLine::kBin_m) + 1, -INFINITY);
    for (const int i : samples) {
      const Eigen::Vector3d& p = survey_.samples.positions[i];
      const double at = wall.Along().dot(p.head<2>());
      if (at < wall.from || at > wall.to) continue;
      double& top = wall.tops[static_cast<size_t>((at - wall.from) / WallLine::kBin_m)];
      top = std::max(top, p.z());
    }
    return wall;
  }

  PlaneRaster RasterOver(const std::vector<int>& samples) const {
    PlaneRaster raster;
    Eigen::AlignedBox2d box;
    for (const int i : samples) box.extend(survey_.samples.positions[i].head<2>());
    raster.cell = std::max(2 * survey_.tolerances.spacing, survey_.tolerances.level_of_detail / 2);
    raster.origin = box.min().array() - 2 * kOverhang_m;
    const Eigen::Vector2d size = box.sizes().array() + 4 * kOverhang_m;
    raster.width = static_cast<int>(size.x() / raster.cell) + 1;
    raster.height = static_cast<int>(size.y() / raster.cell) + 1;
    return raster;
  }

  // By cells, how many more samples lie on roofs than elsewhere: crowns that touch a roof have some
  // leaves on its plane, and below eaves one sees the ground. Walls do not count.
  cv::Mat VotesForRoof(const Beside& beside, const PlaneRaster& raster) const {
    constexpr double kSideways = 0.5;  // cosine of 60 degrees
    cv::Mat votes = cv::Mat::zeros(raster.height, raster.width, CV_32S);
    const auto vote = [&](int sample, int weight) {
      const int at = raster.IndexAt(survey_.samples.positions[sample].head<2>());
      if (at >= 0) votes.at<int>(at / raster.width, at % raster.width) += weight;
    };
    const Eigen::AlignedBox2d box(raster.origin, raster.Center(raster.width, raster.height));
    for (const int i : survey_.bins.In(box)) {
      if (survey_.samples.normals[i].z() > kSideways) vote(i, -1);
    }
    for (const int i : beside.roof) vote(i, 2);
    for (const WallLine& wall : beside.walls) {
      if (wall.sure) VoteBehind(wall, raster, votes);
    }
    return votes;
  }

  // Right behind a wall is its house, whatever stands on its edge: trees lean on it from before it.
  void VoteBehind(const WallLine& wall, const PlaneRaster& raster, cv::Mat& votes) const {
    for (double at = wall.from; at < wall.to; at += raster.cell / 2) {
      if (!wall.IsSeenAt(at)) continue;
      for (double off = raster.cell / 2; off < kOverhang_m; off += raster.cell / 2) {
        const Eigen::Vector2d p = wall.Along() * at + wall.outwards * (wall.offset - off);
        const int cell = raster.IndexAt(p);
        if (cell < 0 || IsInside(floors_, boxes_, p)) continue;
        int& count = votes.at<int>(cell / raster.width, cell % raster.width);
        count = std::max(count, 1);
      }
    }
  }

  // With room around it for all that an outline looks at.
  static cv::Rect WithMargin(const cv::Rect& box, const PlaneRaster& raster) {
    const int margin = static_cast<int>(std::ceil(2 * kUnseen_m / raster.cell));
    return cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin,
                    box.height + 2 * margin) &
           cv::Rect(0, 0, raster.width, raster.height);
  }

  // A part of a raster: seen where one patch has a roof, open where more votes are against one.
  static PlaneRaster PatchOf(const PlaneRaster& whole, const cv::Rect& part, const cv::Mat& hits,
                             const cv::Mat& votes) {
    PlaneRaster patch;
    patch.frame = whole.frame;
    patch.cell = whole.cell;
    patch.origin = whole.origin + whole.cell * Eigen::Vector2d(part.x, part.y);
    patch.width = part.width;
    patch.height = part.height;
    for (int y = 0; y < part.height; ++y) {
      for (int x = 0; x < part.width; ++x) {
        patch.hits.push_back(hits.at<uint8_t>(y, x) != 0 ? 1 : 0);
        patch.through.push_back(static_cast<uint8_t>(std::clamp(-votes.at<int>(y, x), 0, 255)));
      }
    }
    return patch;
  }

  static cv::Mat Disc(double radius_m, const PlaneRaster& raster) {
    const int size = 2 * static_cast<int>(std::ceil(radius_m / raster.cell)) + 1;
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size});
  }

  // Cells under a roof, without eaves, and without strips that are as narrow.
  static cv::Mat Roofed(const cv::Mat& votes, const PlaneRaster& raster) {
    cv::Mat roofed = votes > 0;
    cv::morphologyEx(roofed, roofed, cv::MORPH_CLOSE, Disc(kOverhang_m / 2, raster));
    cv::Mat wide;
    cv::morphologyEx(roofed, wide, cv::MORPH_OPEN, Disc(kOverhang_m, raster));
    cv::dilate(wide, wide, Disc(kOverhang_m / 2, raster));  // the corners that this took off
    cv::Mat kept;
    cv::bitwise_and(roofed, wide, kept);
    return kept;
  }

  void AddOutlines(const PlaneRaster& raster, const std::vector<WallLine>& walls,
                   std::vector<FittedBuilding>& found) const {
    const Tolerances& tolerances = survey_.tolerances;
    const Eigen::AlignedBox2d box(raster.origin, raster.Center(raster.width, raster.height));
    std::vector<CutLine> creases;
    creases.reserve(walls.size());
    for (const WallLine& wall : walls) creases.push_back(wall.Crease());
    for (size_t f = 0; f < floors_.size(); ++f) {
      if (!boxes_[f].intersects(box)) continue;
      for (const Ring& ring : floors_[f].rings) {
        for (size_t i = 0; i < ring.size(); ++i) {
          creases.push_back(LineOf(EdgeOf(ring, i)).Crease());
        }
      }
    }
    const auto evidence = Classify(raster, kUnseen_m, 0);
    std::vector<char> seen(evidence.size());
    for (size_t i = 0; i < seen.size(); ++i) seen[i] = evidence[i] == Evidence::kSeen ? 1 : 0;
    const auto outlines = Outline(raster, evidence, DistancesTo(raster, seen), creases,
                                  {.detail = 2 * tolerances.level_of_detail,
                                   .min_area = kSmallest_m2,
                                   .epsilon = tolerances.epsilon,
                                   .reach = kOverhang_m / 2,
                                   .free_length = 5 * tolerances.level_of_detail});
    const auto is_on = [](const Segment2d& edge, const CutLine& line) {
      constexpr double kOnIt_m = 0.01;
      return std::abs(Cross(line.direction, edge.a - line.point)) < kOnIt_m &&
             std::abs(Cross(line.direction, edge.b - line.point)) < kOnIt_m;
    };
    const auto is_held = [&](const Segment2d& edge) {
      return std::ranges::any_of(creases, [&](const CutLine& line) { return is_on(edge, line); });
    };
    // What holds an outline may be the front of a balcony; a wall that is large, and behind which
    // none shows, or a neighbour's is the house's own.
    const auto is_surely_held = [&](const Segment2d& edge) {
      for (size_t i = 0; i < creases.size(); ++i) {
        if ((i >= walls.size() || walls[i].sure) && is_on(edge, creases[i])) return true;
      }
      return false;
    };
    for (const Polygon& outline : outlines) {
      Polygon squared = outline;
      for (Ring& ring : squared.rings) {
        ring = WithCorners(std::move(ring), is_held, 2 * kUnseen_m);
        ring = WithoutSteps(std::move(ring), is_surely_held, 2 * kUnseen_m, kOverhang_m);
      }
      // Where it touches itself it is for the solid to show whether it closes.
      found.push_back(FootprintOf(IsSimple(squared) ? squared : outline, walls));
    }
  }

  // Its edges are held where walls are.
  FittedBuilding FootprintOf(const Polygon& outline, const std::vector<WallLine>& walls) const {
    FittedBuilding footprint;
    footprint.building.parts = {outline};
    double held = 0, all = 0;
    for (const Ring& ring : outline.rings) {
      for (size_t i = 0; i < ring.size(); ++i) {
        FittedEdge& edge = footprint.edges.emplace_back();
        edge.line = EdgeOf(ring, i);
        const WallLine line = LineOf(edge.line);
        edge.fitted = std::ranges::any_of(walls, [&](const WallLine& wall) {
          return wall.outwards.dot(line.outwards) > 0.999 &&
                 std::abs(wall.offset - line.offset) < 0.01;
        });
        const double length = line.to - line.from;
        all += length;
        if (edge.fitted) held += length;
      }
    }
    footprint.held = held / all;
    const auto ground = GroundAround(survey_, footprint.building);
    footprint.ground = ground.value_or(LowestNear(outline));
    footprint.building.z_m = {footprint.ground, footprint.ground + kRaised_m};
    return footprint;
  }

  double LowestNear(const Polygon& outline) const {
    double lowest = INFINITY;
    for (const int i : survey_.bins.In(stucco::BoundsOf(outline))) {
      lowest = std::min(lowest, survey_.samples.positions[i].z());
    }
    return lowest;
  }

  const PlanarScene& scene_;
  const UprightSurvey& survey_;
  std::vector<Polygon> floors_;
  std::vector<Eigen::AlignedBox2d> boxes_;  // of the floors
};

}  // namespace

std::vector<std::vector<Plane>> OffTheMap(const PlanarScene& scene,
                                          const std::vector<MapBuilding>& outlines,
                                          ProxyFindings& findings) {
  constexpr double kBeside_m = 1.5;   // eaves, balconies and steps belong to their building
  constexpr double kWorthAWord = 10;  // square metres
  const Eigen::Matrix3d upright_from_world = UprightFromWorld(scene.up);
  std::vector<Eigen::AlignedBox2d> boxes;
  boxes.reserve(outlines.size());
  for (const MapBuilding& outline : outlines) boxes.push_back(BoundsOf(outline, kBeside_m));
  const auto on_map = [&](int sample) {
    const Eigen::Vector2d p = (upright_from_world * scene.samples.positions[sample]).head<2>();
    for (size_t b = 0; b < outlines.size(); ++b) {
      if (boxes[b].contains(p) && DistanceTo(outlines[b], p) < kBeside_m) return true;
    }
    return false;
  };
  std::vector<std::vector<Plane>> left;
  for (const std::vector<Plane>& building : scene.buildings) {
    std::vector<Plane> planes;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double area = 0;
    for (Plane plane : building) {
      std::erase_if(plane.points, on_map);
      Measure(scene.samples, 2.5 * scene.tolerances.spacing, plane);
      if (plane.points.size() < 3 || plane.area < scene.tolerances.min_area) continue;
      middle += plane.area * scene.samples.positions[plane.points[plane.points.size() / 2]];
      area += plane.area;
      planes.push_back(std::move(plane));
    }
    if (planes.empty()) continue;
    if (area > kWorthAWord) {
      findings.notes.push_back(
          fmt::format("on no footprint: {} planes, {:.0f} m2, at {:.0f} m east and {:.0f} m north",
                      planes.size(), area, middle.x() / area, middle.y() / area));
    }
    left.push_back(std::move(planes));
  }
  return left;
}

std::vector<FittedBuilding> FindNewFootprints(const PlanarScene& scene, const UprightSurvey& survey,
                                              std::span<const Building> closed) {
  const NewFootprints finder(scene, survey, closed);
  std::vector<FittedBuilding> found;
  for (const std::vector<Plane>& cluster : scene.buildings) finder.Find(cluster, found);
  return found;
}

}  // namespace stucco
