// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/model/site_model.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "survey/error.h"
#include "survey/triangulate.h"

namespace stucco::plan {
namespace {

// A ray ends this much before its point, so that the surface the point lies on does not count.
constexpr double kEndsBefore_m = 0.02;
// The ground is bilinear between samples, the mesh is not: lowered by this much, it hides points
// behind hills but no point that lies on it.
constexpr double kGroundLowered_m = 0.5;
// A part with more air than this below it has an underside.
constexpr double kAirBelow_m = 0.5;

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;

  uint32_t Add(const Eigen::Vector3d& vertex) {
    vertices.push_back(vertex);
    return static_cast<uint32_t>(vertices.size() - 1);
  }
};

void AddWalls(const Footprint& footprint, Mesh& mesh) {
  for (const Ring& ring : footprint.outline.rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& a = ring[i];
      const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
      const uint32_t first = mesh.Add({a.x(), a.y(), footprint.z_m.from_m});
      mesh.Add({b.x(), b.y(), footprint.z_m.from_m});
      mesh.Add({b.x(), b.y(), footprint.z_m.to_m});
      mesh.Add({a.x(), a.y(), footprint.z_m.to_m});
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
}

void AddSlab(const Polygon& outline, double z, Mesh& mesh) {
  Facet facet;
  for (size_t r = 0; r < outline.rings.size(); ++r) {
    auto& corners = r == 0 ? facet.outer : facet.holes.emplace_back();
    for (const Eigen::Vector2d& corner : outline.rings[r]) {
      corners.push_back({corner.x(), corner.y(), z});
    }
  }
  facet.normal = Eigen::Vector3d::UnitZ();
  facet.offset = z;
  const FacetTriangles part = TriangulateFacet(facet);
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& t : part.triangles) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

void AddGround(const Terrain& terrain, Mesh& mesh) {
  if (terrain.IsFlat()) return;  // nothing looks at the ground from below
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (int row = 0; row < terrain.rows; ++row) {
    for (int column = 0; column < terrain.columns; ++column) {
      const Eigen::Vector2d at = terrain.corner + terrain.step_m * Eigen::Vector2d(column, row);
      const double z = terrain.z_m[static_cast<size_t>(row) * terrain.columns + column];
      mesh.Add({at.x(), at.y(), z - kGroundLowered_m});
    }
  }
  for (int row = 0; row + 1 < terrain.rows; ++row) {
    for (int column = 0; column + 1 < terrain.columns; ++column) {
      const uint32_t corner = first + static_cast<uint32_t>(row * terrain.columns + column);
      const uint32_t above = corner + static_cast<uint32_t>(terrain.columns);
      mesh.triangles.push_back({corner, corner + 1, above + 1});
      mesh.triangles.push_back({corner, above + 1, above});
    }
  }
}

Mesh MeshOf(const Site& site) {
  Mesh mesh;
  for (const Footprint& footprint : site.footprints) {
    AddWalls(footprint, mesh);
    AddSlab(footprint.outline, footprint.z_m.to_m, mesh);
    const double ground = site.terrain.HeightAt(footprint.outline.rings.front().front());
    if (footprint.z_m.from_m > ground + kAirBelow_m) {
      AddSlab(footprint.outline, footprint.z_m.from_m, mesh);
    }
  }
  AddGround(site.terrain, mesh);
  return mesh;
}

}  // namespace

struct SiteModel::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // taken off, as rays are in float

  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  void Attach(const Mesh& mesh) const;
};

void SiteModel::State::Attach(const Mesh& mesh) const {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* xyz = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                          RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                          mesh.vertices.size()));
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3f local = (mesh.vertices[i] - center).cast<float>();
    std::copy_n(local.data(), 3, xyz + 3 * i);
  }
  auto* corners = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), mesh.triangles.size()));
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::copy_n(mesh.triangles[i].data(), 3, corners + 3 * i);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

SiteModel::SiteModel(const Site& site) : state_(std::make_unique<State>()) {
  const Mesh mesh = MeshOf(site);
  for (const Eigen::Vector3d& vertex : mesh.vertices) state_->center += vertex;
  if (!mesh.vertices.empty()) state_->center /= static_cast<double>(mesh.vertices.size());
  state_->device = rtcNewDevice("threads=1");
  if (!state_->device) {
    throw Error(ErrorKind::kStageFailed, "Embree could not be started on this processor");
  }
  state_->scene = rtcNewScene(state_->device);
  rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
  if (!mesh.triangles.empty()) state_->Attach(mesh);
  rtcCommitScene(state_->scene);
}

SiteModel::~SiteModel() = default;
SiteModel::SiteModel(SiteModel&&) noexcept = default;
SiteModel& SiteModel::operator=(SiteModel&&) noexcept = default;

bool SiteModel::Sees(const Eigen::Vector3d& camera, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d way = point - camera;
  const double distance = way.norm();
  if (!(distance > kEndsBefore_m)) return true;
  const Eigen::Vector3f start = (camera - state_->center).cast<float>();
  const Eigen::Vector3f direction = (way / distance).cast<float>();
  RTCRay ray{};
  ray.org_x = start.x();
  ray.org_y = start.y();
  ray.org_z = start.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = 0;
  ray.tfar = static_cast<float>(distance - kEndsBefore_m);
  ray.mask = std::numeric_limits<unsigned>::max();
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(state_->scene, &context, &ray);
  return !(ray.tfar < 0);
}

}  // namespace stucco::plan
