// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/output/elevations.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "proxy/cloud/near_facets.h"
#include "survey/geometry2d.h"
#include "survey/image.h"

namespace stucco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr size_t kMostShown = 5'000'000;
constexpr double kPointsOfCell = 3;
constexpr double kLeastCell_m = 0.03;
constexpr int kAround = 5;      // a square of so many cells speaks for one without points
constexpr float kEnough = 1.5;  // when they have more points than this
constexpr double kFull_m = 0.15;
constexpr double kReachOverFull = 4;  // what lies farther off is another thing
constexpr double kFullShare = 0.001;  // of the model's size, where it has no metres
constexpr float kSameWay = 0.7F;      // cosine between the normals of a point and of its facet

constexpr int kPageWidth_px = 1800;
constexpr int kLargestTile_px = kPageWidth_px - 40;
constexpr int kMargin_px = 20;
constexpr int kCaption_px = 18;
constexpr int kHead_px = 56;
constexpr int kLeastTile_px = 170;  // room for a caption

// As R G B.
const cv::Scalar kPaper(255, 255, 255);
const cv::Scalar kInk(50, 55, 60);
const cv::Vec3b kUnseen(205, 209, 213);
const cv::Vec3b kOn(250, 250, 245);
const cv::Vec3b kBefore(178, 24, 43);
const cv::Vec3b kBehind(33, 102, 172);

struct Scale {
  double cell = 0;  // of the grids on facets
  double full = 0;  // distance at which colours are full
};

cv::Vec3b ColourOf(double distance, double full) {
  const double share = std::min(1.0, std::abs(distance) / full);
  const cv::Vec3b& end = distance > 0 ? kBefore : kBehind;
  cv::Vec3b colour;
  for (int k = 0; k < 3; ++k) {
    colour[k] = cv::saturate_cast<uint8_t>(kOn[k] + share * (end[k] - kOn[k]));
  }
  return colour;
}

// Distances of points in cells of a facet's plane, x to the right and y down as seen from outside.
class Elevation {
 public:
  Elevation(const Facet& facet, const Vector3d& up, double cell) : facet_(facet), cell_(cell) {
    u_ = up.cross(facet.normal);
    if (u_.norm() < kLevel) u_ = LongestEdge(facet);
    u_.normalize();
    v_ = u_.cross(facet.normal);  // down
    polygon_.rings.push_back(InPlane(facet.outer));
    for (const auto& hole : facet.holes) polygon_.rings.push_back(InPlane(hole));
    bounds_ = BoundsOf(polygon_);
    columns_ = static_cast<int>(bounds_.sizes().x() / cell_) + 1;
    rows_ = static_cast<int>(bounds_.sizes().y() / cell_) + 1;
    sums_ = cv::Mat1f::zeros(rows_, columns_);
    counts_ = cv::Mat1f::zeros(rows_, columns_);
  }

  void Add(const CloudPoint& point, double reach) {
    const bool has_normal = point.normal.squaredNorm() > 0;
    if (has_normal && point.normal.dot(facet_.normal.cast<float>()) < kSameWay) return;
    const double distance = facet_.normal.dot(point.position) - facet_.offset;
    if (std::abs(distance) > reach) return;
    const Vector2d at(u_.dot(point.position), v_.dot(point.position));
    if (!bounds_.contains(at) || !Contains(polygon_, at)) return;
    const Vector2d cell = (at - bounds_.min()) / cell_;
    const int x = std::min(columns_ - 1, static_cast<int>(cell.x()));
    const int y = std::min(rows_ - 1, static_cast<int>(cell.y()));
    sums_(y, x) += static_cast<float>(distance);
    ++counts_(y, x);
  }

  // Its longer side has at most `largest_px` pixels.
  cv::Mat Draw(double full, int largest_px) const {
    cv::Mat tile(rows_, columns_, CV_8UC3, kPaper);
    // Where points lie farther apart than cells, those around say how far the wall is there.
    cv::Mat sums, counts;
    const cv::Size around(kAround, kAround);
    cv::boxFilter(sums_, sums, CV_32F, around, {-1, -1}, /*normalize=*/false, cv::BORDER_CONSTANT);
    cv::boxFilter(counts_, counts, CV_32F, around, {-1, -1}, false, cv::BORDER_CONSTANT);
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        const Vector2d middle = bounds_.min() + cell_ * Vector2d(x + 0.5, y + 0.5);
        if (counts_(y, x) > 0) {
          tile.at<cv::Vec3b>(y, x) = ColourOf(sums_(y, x) / counts_(y, x), full);
        } else if (Contains(polygon_, middle)) {
          const float count = counts.at<float>(y, x);
          tile.at<cv::Vec3b>(y, x) =
              count < kEnough ? kUnseen : ColourOf(sums.at<float>(y, x) / count, full);
        }
      }
    }
    const double shrink = std::min(1.0, double(largest_px) / std::max(rows_, columns_));
    if (shrink < 1) {
      const cv::Mat whole = tile;
      cv::resize(whole, tile, {}, shrink, shrink, cv::INTER_AREA);
    }
    Outline(shrink, tile);
    return tile;
  }

  std::string Caption() const {
    return fmt::format("{}  {:.0f} % seen", facet_.id, 100 * facet_.seen);
  }

 private:
  static constexpr double kLevel = 0.05;  // sine of the slope below which a facet has no downhill

  static Vector3d LongestEdge(const Facet& facet) {
    Vector3d longest = Vector3d::Zero();
    for (size_t i = 0; i < facet.outer.size(); ++i) {
      const Vector3d edge = facet.outer[(i + 1) % facet.outer.size()] - facet.outer[i];
      if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
    }
    return longest;
  }

  Ring InPlane(const std::vector<Vector3d>& corners) const {
    Ring ring;
    ring.reserve(corners.size());
    for (const Vector3d& p : corners) ring.emplace_back(u_.dot(p), v_.dot(p));
    return ring;
  }

  void Outline(double shrink, cv::Mat& tile) const {
    for (const Ring& ring : polygon_.rings) {
      std::vector<cv::Point> corners;
      corners.reserve(ring.size());
      for (const Vector2d& p : ring) {
        const Vector2d pixel = (p - bounds_.min()) / cell_ * shrink;
        corners.emplace_back(std::min(tile.cols - 1, static_cast<int>(pixel.x())),
                             std::min(tile.rows - 1, static_cast<int>(pixel.y())));
      }
      cv::polylines(tile, corners, /*isClosed=*/true, kInk, 1, cv::LINE_8);
    }
  }

  const Facet& facet_;
  double cell_;
  Vector3d u_, v_;
  Polygon polygon_;
  Eigen::AlignedBox2d bounds_;
  int columns_ = 0, rows_ = 0;
  cv::Mat1f sums_, counts_;
};

void Write(cv::Mat& sheet, const std::string& text, cv::Point at) {
  cv::putText(sheet, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.4, kInk, 1, cv::LINE_AA);
}

// From behind to before, with the distances that they mean.
void DrawLegend(const Scale& scale, const std::string& unit, cv::Mat& sheet) {
  constexpr int kWide = 200, kHigh = 12;
  const cv::Point corner(sheet.cols - kMargin_px - kWide, kMargin_px);
  for (int x = 0; x < kWide; ++x) {
    const double distance = scale.full * (2.0 * x / (kWide - 1) - 1);
    sheet(cv::Rect(corner.x + x, corner.y, 1, kHigh))
        .setTo(cv::Scalar(ColourOf(distance, scale.full)));
  }
  const int line = corner.y + kHigh + 14;
  Write(sheet, fmt::format("{:.3g} {} behind", scale.full, unit), {corner.x - 20, line});
  Write(sheet, "before", {corner.x + kWide - 40, line});
}

// Where each tile goes: from the left to the right, then below.
struct Place {
  cv::Point corner;
  size_t tile = 0;
};

struct Page {
  std::vector<Place> places;
  int width_px = 0;
  int height_px = 0;
};

Page LayOut(const std::vector<cv::Mat>& tiles) {
  Page page;
  int x = kMargin_px;
  int y = kHead_px;
  int row_px = 0;
  for (size_t i = 0; i < tiles.size(); ++i) {
    const int wide = std::max(kLeastTile_px, tiles[i].cols);
    if (x > kMargin_px && x + wide + kMargin_px > kPageWidth_px) {
      x = kMargin_px;
      y += row_px + kCaption_px + kMargin_px;
      row_px = 0;
    }
    page.places.push_back({{x, y}, i});
    x += wide + kMargin_px;
    page.width_px = std::max(page.width_px, x);
    row_px = std::max(row_px, tiles[i].rows);
  }
  page.height_px = y + row_px + kCaption_px + kMargin_px;
  constexpr int kLeastWidth_px = 480;  // for the head
  page.width_px = std::max(page.width_px, kLeastWidth_px);
  return page;
}

Image Draw(const Building& building, const std::vector<Elevation>& elevations, const Scale& scale,
           const std::string& unit) {
  std::vector<cv::Mat> tiles;
  tiles.reserve(elevations.size());
  for (const Elevation& elevation : elevations) {
    tiles.push_back(elevation.Draw(scale.full, kLargestTile_px));
  }
  const Page page = LayOut(tiles);
  cv::Mat sheet(page.height_px, page.width_px, CV_8UC3, kPaper);
  Write(sheet, building.id, {kMargin_px, kMargin_px + 8});
  Write(sheet, "points before and behind its planes", {kMargin_px, kMargin_px + 24});
  DrawLegend(scale, unit, sheet);
  for (const Place& place : page.places) {
    const cv::Mat& tile = tiles[place.tile];
    tile.copyTo(sheet(cv::Rect(place.corner, tile.size())));
    Write(sheet, elevations[place.tile].Caption(),
          {place.corner.x, place.corner.y + tile.rows + kCaption_px - 4});
  }
  Image image{sheet.cols, sheet.rows, 3, {}};
  image.data.assign(sheet.datastart, sheet.dataend);
  return image;
}

bool IsDrawn(const Building& building, const Facet& facet) {
  return building.id != "G0" && facet.facet_class != FacetClass::kGround;
}

Scale ScaleOf(const Proxy& proxy, size_t points) {
  double area = 0;
  Eigen::AlignedBox3d box;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      if (!IsDrawn(building, facet)) continue;
      area += facet.area;
      for (const Vector3d& p : facet.outer) box.extend(p);
    }
  }
  const double many = static_cast<double>(std::clamp<size_t>(points, 1, kMostShown));
  Scale scale;
  scale.cell = std::sqrt(kPointsOfCell * area / many);
  if (proxy.metric) scale.cell = std::max(scale.cell, kLeastCell_m);
  scale.full = proxy.metric || box.isEmpty() ? kFull_m : kFullShare * box.diagonal().norm();
  return scale;
}

}  // namespace

void WriteElevations(const PointStream& cloud, const Proxy& proxy,
                     const std::filesystem::path& folder) {
  const Scale scale = ScaleOf(proxy, cloud.count);
  std::vector<const Facet*> facets;
  std::vector<std::vector<Elevation>> of_building;
  std::vector<std::pair<size_t, size_t>> at;  // building and place of each facet
  for (size_t b = 0; b < proxy.buildings.size(); ++b) {
    of_building.emplace_back();
    for (const Facet& facet : proxy.buildings[b].facets) {
      if (!IsDrawn(proxy.buildings[b], facet)) continue;
      at.emplace_back(b, of_building.back().size());
      of_building.back().emplace_back(facet, proxy.up, scale.cell);
      facets.push_back(&facet);
    }
  }
  const double reach = kReachOverFull * scale.full;
  ForEachPointNear(cloud, facets, reach, kMostShown, [&](size_t i, const CloudPoint& point) {
    of_building[at[i].first][at[i].second].Add(point, reach);
  });
  std::filesystem::create_directories(folder);
  for (size_t b = 0; b < proxy.buildings.size(); ++b) {
    if (of_building[b].empty()) continue;
    const Building& building = proxy.buildings[b];
    WriteImage(Draw(building, of_building[b], scale, proxy.metric ? "m" : "units"),
               folder / ElevationFile(building));
  }
}

}  // namespace stucco
