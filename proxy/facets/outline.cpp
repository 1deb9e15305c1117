// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "proxy/facets/contour_lines.h"
#include "proxy/facets/min_cut.h"

namespace stucco {
namespace {

// Prices per area of labelling a cell of each kind of evidence wrongly; the free numbers of the
// method. A border costs its length times the level of detail times its kind's price.
constexpr double kSeenOut = 1.0;
constexpr double kGapOut = 0.15;
constexpr double kOpenIn = 1.0;
constexpr double kUnknownIn = 0.8;
constexpr double kContourBorder = 0.6;
constexpr double kFreeBorder = 1.0;
constexpr double kActiveCrease = 0.15;
constexpr double kIdleCrease = 3;  // where nothing says that the planes meet

using Counts = std::array<int, 5>;  // cells by Evidence

// Cells whose centre lies in a convex face.
Counts CountCells(const PlaneRaster& raster, const std::vector<Evidence>& evidence,
                  const Arrangement& arrangement, const std::vector<int>& face) {
  Counts counts = {0, 0, 0, 0, 0};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const int v : face) {
    low = std::min(low, arrangement.vertices[v].y());
    high = std::max(high, arrangement.vertices[v].y());
  }
  const auto row_of = [&](double y) { return (y - raster.origin.y()) / raster.cell - 0.5; };
  const int first = std::max(0, static_cast<int>(std::ceil(row_of(low))));
  const int last = std::min(raster.height - 1, static_cast<int>(std::ceil(row_of(high))) - 1);
  for (int y = first; y <= last; ++y) {
    const double at = raster.Center(0, y).y();
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (size_t i = 0; i < face.size(); ++i) {
      const Eigen::Vector2d& a = arrangement.vertices[face[i]];
      const Eigen::Vector2d& b = arrangement.vertices[face[(i + 1) % face.size()]];
      if ((a.y() > at) == (b.y() > at)) continue;
      const double x = a.x() + (at - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (!(left <= right)) continue;
    const auto column_of = [&](double x) { return (x - raster.origin.x()) / raster.cell - 0.5; };
    const int begin = std::max(0, static_cast<int>(std::ceil(column_of(left))));
    const int end = std::min(raster.width, static_cast<int>(std::ceil(column_of(right))));
    for (int x = begin; x < end; ++x) ++counts[static_cast<int>(evidence[raster.Index(x, y)])];
  }
  return counts;
}

std::vector<CutNode> PriceFaces(const PlaneRaster& raster, const std::vector<Evidence>& evidence,
                                const Arrangement& arrangement) {
  const double cell_area = raster.cell * raster.cell;
  std::vector<CutNode> nodes(arrangement.faces.size());
  for (size_t f = 0; f < nodes.size(); ++f) {
    const Counts counts = CountCells(raster, evidence, arrangement, arrangement.faces[f]);
    const auto count = [&](Evidence e) { return cell_area * counts[static_cast<int>(e)]; };
    nodes[f].cost_out = kSeenOut * count(Evidence::kSeen) + kGapOut * count(Evidence::kGap);
    nodes[f].cost_in = kOpenIn * count(Evidence::kOpen) + kUnknownIn * count(Evidence::kUnknown);
  }
  return nodes;
}

// The evidence of a cell near a crease, where that is active.
Evidence NearCrease(const CutLine& crease, const Eigen::Vector2d& p, Evidence evidence,
                    double to_seen, const OutlineOptions& options) {
  constexpr double kFootReach = 3;  // of options.reach
  if (!crease.IsActiveAt(p)) return evidence;
  const double above = crease.HeightOf(p);
  if (crease.foot && above < -options.epsilon) return Evidence::kOpen;
  const double reach = options.reach * (crease.foot ? kFootReach : 1);
  const bool lost = evidence == Evidence::kUnknown && to_seen <= reach && std::abs(above) <= reach;
  const bool shared = evidence == Evidence::kSeen && std::abs(above) <= options.epsilon;
  return lost || shared ? Evidence::kBetween : evidence;
}

// Near a crease where it is active some cells are free to either side: unknown ones near seen cells
// (the strip that matching lost at an edge), and seen ones so near to the other plane that their
// points may be the other's. Below its foot a wall is over.
std::vector<Evidence> FreeStrips(const PlaneRaster& raster, std::vector<Evidence> evidence,
                                 const std::vector<float>& to_seen,
                                 const std::vector<CutLine>& creases,
                                 const OutlineOptions& options) {
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const size_t i = raster.Index(x, y);
      const Eigen::Vector2d p = raster.Center(x, y);
      for (const CutLine& crease : creases) {
        evidence[i] = NearCrease(crease, p, evidence[i], to_seen[i], options);
      }
    }
  }
  return evidence;
}

void DropSmall(double min_area, std::vector<Polygon>& polygons) {
  for (Polygon& polygon : polygons) {
    const auto holes = polygon.rings.begin() + 1;
    polygon.rings.erase(
        std::remove_if(holes, polygon.rings.end(),
                       [&](const Ring& hole) { return -SignedArea(hole) < min_area; }),
        polygon.rings.end());
  }
  std::erase_if(polygons, [&](const Polygon& polygon) { return Area(polygon) < min_area; });
}

}  // namespace

std::vector<Polygon> Outline(const PlaneRaster& raster, const std::vector<Evidence>& known,
                             const std::vector<float>& to_seen, const std::vector<CutLine>& creases,
                             const OutlineOptions& options) {
  std::vector<CutLine> lines = creases;
  const auto contour = ContourLines(raster, known, creases,
                                    {.detail = options.detail,
                                     .most_lines = options.most_lines,
                                     .follow_creases = options.follow_creases,
                                     .free_length = options.free_length});
  lines.insert(lines.end(), contour.begin(), contour.end());
  const auto evidence = FreeStrips(raster, known, to_seen, creases, options);
  const Eigen::AlignedBox2d box(
      raster.origin,
      Eigen::Vector2d(raster.origin + raster.cell * Eigen::Vector2d(raster.width, raster.height)));
  const Arrangement arrangement = Arrange(box, lines);
  const auto nodes = PriceFaces(raster, evidence, arrangement);
  std::vector<CutLink> links;
  for (const auto& edge : arrangement.edges) {
    if (edge.left < 0 || edge.right < 0) continue;
    const Eigen::Vector2d a = arrangement.vertices[edge.from], b = arrangement.vertices[edge.to];
    double price = kContourBorder;
    if (edge.line >= 0 && lines[edge.line].crease) {
      price = lines[edge.line].IsActiveAt((a + b) / 2) ? kActiveCrease : kIdleCrease;
    } else if (edge.line >= 0 && lines[edge.line].free) {
      price = kFreeBorder;
    }
    links.push_back({edge.left, edge.right, price * options.detail * (b - a).norm()});
  }
  const auto inside = CheapestLabels(nodes, links);
  auto polygons = UnionOf(arrangement, inside);
  DropSmall(options.min_area, polygons);
  return polygons;
}

}  // namespace stucco
