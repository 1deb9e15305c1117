// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/solids/solid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "proxy/facets/arrangement.h"
#include "proxy/facets/facets.h"
#include "proxy/planes/regularise.h"
#include "proxy/solids/closed_check.h"
#include "proxy/solids/partition.h"
#include "proxy/solids/solid_cells.h"

namespace stucco {
namespace {

constexpr size_t kMostCells = 20000;
constexpr double kLeastAgreement = 0.7;

// The building's frame: x along its main direction, z up, the origin amid its points.
struct Setting {
  Eigen::Isometry3d local_from_world = Eigen::Isometry3d::Identity();
  Eigen::AlignedBox3d box;  // local
};

Setting SettingOf(const PlanarScene& scene, const std::vector<const PlaneView*>& views,
                  const Plane* ground) {
  Eigen::Matrix3d rotation;
  std::vector<const Plane*> planes;
  planes.reserve(views.size());
  for (const PlaneView* view : views) planes.push_back(view->plane);
  const Eigen::Vector3d x = MainDirection(scene.up, planes);
  rotation << x.transpose(), scene.up.cross(x).transpose(), scene.up.transpose();
  Eigen::AlignedBox3d box;
  for (const PlaneView* view : views) {
    for (const int i : view->plane->points) box.extend(rotation * scene.samples.positions[i]);
  }
  if (ground != nullptr) {
    // Down to the ground at each corner of the box.
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3d p =
          rotation.transpose() * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
      const double along = ground->normal.dot(scene.up);
      box.extend(rotation * (p - ground->DistanceTo(p) / along * scene.up));
    }
  }
  Setting setting;
  const Eigen::Vector3d center = box.center();
  setting.local_from_world.linear() = rotation;
  setting.local_from_world.translation() = -center;
  const double margin = 2 * scene.tolerances.level_of_detail;
  setting.box = Eigen::AlignedBox3d(box.min() - center - Eigen::Vector3d::Constant(margin),
                                    box.max() - center + Eigen::Vector3d::Constant(margin));
  return setting;
}

CutPlane ToLocal(const Setting& setting, const Eigen::Vector3d& normal, double offset) {
  CutPlane local;
  local.normal = setting.local_from_world.linear() * normal;
  local.offset = offset + local.normal.dot(setting.local_from_world.translation());
  return local;
}

// Where the building stands: the ground, or the level of its lowest points.
CutPlane BaseOf(const PlanarScene& scene, const Setting& setting,
                const std::vector<const PlaneView*>& views, const Plane* ground) {
  if (ground != nullptr) return ToLocal(setting, ground->normal, ground->offset);
  std::vector<double> heights;
  for (const PlaneView* view : views) {
    for (const int i : view->plane->points) {
      heights.push_back((setting.local_from_world * scene.samples.positions[i]).z());
    }
  }
  const auto low = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 200);
  std::nth_element(heights.begin(), low, heights.end());
  return {.normal = Eigen::Vector3d::UnitZ(), .offset = *low};
}

struct BoundaryFacet {
  int plane = 0;
  bool outwards = true;  // the plane's normal points out of the solid
  IndexPolygon polygon;
};

bool IsBoundary(const Partition::Face& face, const std::vector<bool>& inside) {
  return (face.below >= 0 && inside[face.below]) != (face.above >= 0 && inside[face.above]);
}

// The boundary's faces of one plane and side, merged where they touch.
std::vector<BoundaryFacet> MergePlane(const Partition& partition, const std::vector<bool>& inside,
                                      int plane, bool outwards) {
  const Eigen::Vector3d normal = partition.planes[plane].normal * (outwards ? 1 : -1);
  const Eigen::Vector3d u = AnyPerpendicular(normal);
  const Eigen::Vector3d v = normal.cross(u);
  Arrangement arrangement;
  arrangement.vertices.resize(partition.vertices.size());
  std::map<std::pair<int, int>, Arrangement::Edge> edges;
  for (const auto& face : partition.faces) {
    if (face.plane != plane || !IsBoundary(face, inside)) continue;
    if ((face.below >= 0 && inside[face.below]) != outwards) continue;
    std::vector<int> loop = face.loop;
    if (!outwards) std::reverse(loop.begin(), loop.end());
    for (size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      const Eigen::Vector3d& p = partition.vertices[a];
      arrangement.vertices[a] = {u.dot(p), v.dot(p)};
      auto& edge = edges[{std::min(a, b), std::max(a, b)}];
      edge.from = std::min(a, b);
      edge.to = std::max(a, b);
      (a < b ? edge.left : edge.right) = static_cast<int>(arrangement.faces.size());
    }
    arrangement.faces.push_back(std::move(loop));
  }
  for (const auto& [key, edge] : edges) arrangement.edges.push_back(edge);
  std::vector<BoundaryFacet> merged;
  for (auto& polygon :
       UnionOfIndices(arrangement, std::vector<bool>(arrangement.faces.size(), true))) {
    merged.push_back({plane, outwards, std::move(polygon)});
  }
  return merged;
}

// Vertices that are a corner of some ring; the others lie on straight edges of all their rings.
std::set<int> CornersOf(const Partition& partition, const std::vector<BoundaryFacet>& facets) {
  constexpr double kStraight = 1e-7;
  std::set<int> corners;
  const auto visit = [&](const std::vector<int>& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector3d& p = partition.vertices[ring[i]];
      const Eigen::Vector3d in =
          (p - partition.vertices[ring[(i + ring.size() - 1) % ring.size()]]).normalized();
      const Eigen::Vector3d out =
          (partition.vertices[ring[(i + 1) % ring.size()]] - p).normalized();
      if (in.cross(out).norm() > kStraight || in.dot(out) < 0) corners.insert(ring[i]);
    }
  };
  for (const auto& facet : facets) {
    visit(facet.polygon.outer);
    for (const auto& hole : facet.polygon.holes) visit(hole);
  }
  return corners;
}

std::vector<BoundaryFacet> BoundaryOf(const Partition& partition, const std::vector<bool>& inside) {
  std::vector<BoundaryFacet> facets;
  for (int plane = 0; plane < static_cast<int>(partition.planes.size()); ++plane) {
    for (const bool outwards : {true, false}) {
      for (auto& facet : MergePlane(partition, inside, plane, outwards)) {
        facets.push_back(std::move(facet));
      }
    }
  }
  const auto corners = CornersOf(partition, facets);
  for (auto& facet : facets) {
    const auto straight = [&](int v) { return corners.count(v) == 0; };
    std::erase_if(facet.polygon.outer, straight);
    for (auto& hole : facet.polygon.holes) std::erase_if(hole, straight);
  }
  return facets;
}

// The role of a facet by its normal alone; the sides nobody saw have no other.
PlaneRole RoleOf(double upwards) {
  constexpr double kSinOfWall = 0.035;   // 2 degrees
  constexpr double kSinOfLevel = 0.998;  // within 4 degrees of level
  if (std::abs(upwards) < kSinOfWall) return PlaneRole::kWall;
  if (upwards < 0) return PlaneRole::kCeiling;
  return upwards > kSinOfLevel ? PlaneRole::kHorizontal : PlaneRole::kSlope;
}

// A facet of the world, with figures from the view of its plane (null: a plane without points).
Facet ToFacet(const PlanarScene& scene, const Setting& setting, const Partition& partition,
              const BoundaryFacet& boundary, const PlaneView* view) {
  const Eigen::Isometry3d world_from_local = setting.local_from_world.inverse();
  const auto to_world = [&](const std::vector<int>& ring) {
    std::vector<Eigen::Vector3d> points;
    points.reserve(ring.size());
    for (const int v : ring) points.push_back(world_from_local * partition.vertices[v]);
    return points;
  };
  Plane plane;
  const CutPlane& cut = partition.planes[boundary.plane];
  plane.normal = world_from_local.linear() * cut.normal;
  plane.offset = cut.offset + plane.normal.dot(world_from_local.translation());
  if (!boundary.outwards) {
    plane.normal = -plane.normal;
    plane.offset = -plane.offset;
  }
  const bool seen = view != nullptr && boundary.outwards;
  const bool wall = view != nullptr && view->plane->role == PlaneRole::kWall;  // it may lean
  plane.role = wall ? PlaneRole::kWall : RoleOf(plane.normal.dot(scene.up));
  PlaneView blank;
  blank.plane = &plane;
  blank.raster.frame =
      FrameOf(plane, scene.up, scene.main_direction, world_from_local.translation());
  const PlaneView& used = seen ? *view : blank;
  const auto flatten = [&](const std::vector<int>& ring) {
    Ring points;
    for (const auto& p : to_world(ring)) points.push_back(used.raster.frame.ToPlane(p));
    return points;
  };
  Polygon polygon{{flatten(boundary.polygon.outer)}};
  for (const auto& hole : boundary.polygon.holes) polygon.rings.push_back(flatten(hole));
  Facet facet = MakeFacet(scene.samples, used, polygon);
  if (!seen) facet.source = "extruded";
  // The exact corners, so that neighbouring facets share them.
  facet.outer = to_world(boundary.polygon.outer);
  for (size_t h = 0; h < facet.holes.size(); ++h) {
    facet.holes[h] = to_world(boundary.polygon.holes[h]);
  }
  return facet;
}

// Share of the planes' points with solid behind and air in front of them.
double AgreementOf(const PlanarScene& scene, const Setting& setting, const Partition& partition,
                   const std::vector<const PlaneView*>& views, const std::vector<bool>& inside) {
  size_t agree = 0, all = 0;
  for (const PlaneView* view : views) {
    const Eigen::Vector3d step =
        setting.local_from_world.linear() * view->plane->normal * scene.tolerances.level_of_detail;
    for (const int i : view->plane->points) {
      const Eigen::Vector3d p = setting.local_from_world * scene.samples.positions[i];
      ++all;
      if (!setting.box.contains(p - step)) continue;
      const bool front = setting.box.contains(p + step) && inside[partition.CellAt(p + step)];
      agree += inside[partition.CellAt(p - step)] && !front;
    }
  }
  return all == 0 ? 0 : static_cast<double>(agree) / static_cast<double>(all);
}

void MarkBottom(const PlanarScene& scene, const CutPlane& base, const Setting& setting,
                std::vector<Facet>& facets) {
  for (Facet& facet : facets) {
    if (facet.normal.dot(scene.up) > -0.5) continue;
    const Eigen::Vector3d p = setting.local_from_world * facet.outer[0];
    if (std::abs(base.normal.dot(p) - base.offset) < 1e-6 * setting.box.sizes().norm()) {
      facet.facet_class = FacetClass::kGround;
      facet.source = "extruded";
    }
  }
}

double SupportOf(const std::vector<Facet>& facets) {
  double area = 0, seen = 0;
  for (const Facet& facet : facets) {
    if (facet.facet_class == FacetClass::kGround) continue;
    area += facet.area;
    seen += facet.area * facet.seen;
  }
  return area > 0 ? seen / area : 0;
}

}  // namespace

Solid CloseBuilding(const PlanarScene& scene, const std::vector<const PlaneView*>& all_views,
                    const Plane* ground, const SolidOptions& options) {
  Solid solid;
  std::vector<const PlaneView*> views = all_views;
  std::stable_sort(views.begin(), views.end(), [](const PlaneView* a, const PlaneView* b) {
    return a->plane->area > b->plane->area;
  });
  views.resize(std::min(views.size(), static_cast<size_t>(options.max_planes)));
  if (views.size() < 3) {
    solid.why_not = "fewer than three planes";
    return solid;
  }
  const Setting setting = SettingOf(scene, views, ground);
  const CutPlane base = BaseOf(scene, setting, views, ground);
  std::vector<CutPlane> cuts = {base};
  cuts.reserve(views.size() + 1);
  for (const PlaneView* view : views) {
    cuts.push_back(ToLocal(setting, view->plane->normal, view->plane->offset));
  }
  const Partition partition = PartitionBox(setting.box, cuts, kMostCells);
  std::vector<const PlaneView*> view_of_cut(views.begin(), views.end());
  view_of_cut.insert(view_of_cut.begin(), nullptr);
  const SolidInput input{
      .scene = &scene, .views = view_of_cut, .local_from_world = setting.local_from_world};
  const CellEvidence evidence = GatherEvidence(partition, setting.box, input);
  const auto inside = LabelCells(partition, evidence, Partition::kBoxPlanes);
  for (const BoundaryFacet& boundary : BoundaryOf(partition, inside)) {
    const int cut = boundary.plane - Partition::kBoxPlanes;
    solid.facets.push_back(
        ToFacet(scene, setting, partition, boundary, cut >= 0 ? view_of_cut[cut] : nullptr));
  }
  MarkBottom(scene, base, setting, solid.facets);
  solid.support = SupportOf(solid.facets);
  solid.agreement = AgreementOf(scene, setting, partition, views, inside);
  if (solid.facets.empty()) {
    solid.why_not = "its planes enclose nothing";
  } else if (solid.support < options.least_support) {
    solid.why_not =
        fmt::format("points cover {:.0f} % of its walls and roofs", 100 * solid.support);
  } else if (solid.agreement < kLeastAgreement) {
    solid.why_not = fmt::format("it agrees with {:.0f} % of the points", 100 * solid.agreement);
  } else if (const auto problem = FindOpening(solid.facets)) {
    solid.why_not = *problem;
  }
  if (!solid.why_not.empty()) solid.facets.clear();
  return solid;
}

}  // namespace stucco
