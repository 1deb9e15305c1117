// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/surface_index.h"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

constexpr size_t kDistancesOfTask = 1024;

// Ericson, "Real-Time Collision Detection" (2005), section 5.1.5.
Vector3d NearestOnTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                           const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return d1 > d3 ? Vector3d(a + d1 / (d1 - d3) * ab) : a;
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return d2 > d6 ? Vector3d(a + d2 / (d2 - d6) * ac) : a;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double along = (d4 - d3) + (d5 - d6);
    return along > 0 ? Vector3d(b + (d4 - d3) / along * (c - b)) : b;
  }
  const double all = va + vb + vc;
  return a + ab * (vb / all) + ac * (vc / all);
}

struct Search {
  const Surface* surface;
  Vector3d point;
  double slack;  // what rounding to floats may hide
  NearestPlace nearest;
};

bool VisitTriangle(RTCPointQueryFunctionArguments* arguments) {
  Search& search = *static_cast<Search*>(arguments->userPtr);
  const Surface& surface = *search.surface;
  const auto& t = surface.triangles[arguments->primID];
  const Vector3d on = NearestOnTriangle(search.point, surface.vertices[t[0]],
                                        surface.vertices[t[1]], surface.vertices[t[2]]);
  const double distance = (on - search.point).norm();
  if (!(distance < search.nearest.distance)) return false;
  search.nearest = {distance, on, surface.groups[arguments->primID]};
  arguments->query->radius = static_cast<float>(distance + search.slack);
  return true;  // the radius has changed
}

}  // namespace

// A tree of its own: that of survey/occluders.h answers rays alone, not which triangle is nearest,
// and rounds coordinates after taking their middle off, so that lines of sight would change.
struct SurfaceIndex::State {
  Surface surface;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  double slack = 0;

  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  void Build();
};

void SurfaceIndex::State::Build() {
  device = rtcNewDevice(nullptr);
  if (!device) throw Error(ErrorKind::kOutOfResource, "Embree could not be started");
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), std::max<size_t>(surface.vertices.size(), 1)));
  auto* corners = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), std::max<size_t>(surface.triangles.size(), 1)));
  if (!vertices || !corners) {
    rtcReleaseGeometry(geometry);
    throw Error(ErrorKind::kOutOfResource, "no memory for the tree of a surface");
  }
  double reach = 0;
  for (size_t i = 0; i < surface.vertices.size(); ++i) {
    for (int k = 0; k < 3; ++k) vertices[3 * i + k] = static_cast<float>(surface.vertices[i][k]);
    reach = std::max(reach, surface.vertices[i].cwiseAbs().maxCoeff());
  }
  if (surface.vertices.empty()) std::fill(vertices, vertices + 3, 0.0f);
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    std::copy(surface.triangles[i].begin(), surface.triangles[i].end(), corners + 3 * i);
  }
  if (surface.triangles.empty()) std::fill(corners, corners + 3, 0u);
  // A float has 24 binary digits; the point, the corner and the boxes around it are each rounded.
  slack = std::ldexp(reach, -21);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
}

SurfaceIndex::SurfaceIndex(Surface surface) : state_(std::make_unique<State>()) {
  state_->surface = std::move(surface);
  assert(state_->surface.groups.size() == state_->surface.triangles.size());
  assert(std::ranges::all_of(state_->surface.triangles, [&](const auto& triangle) {
    return std::ranges::max(triangle) < state_->surface.vertices.size();
  }));
  state_->Build();
}
SurfaceIndex::~SurfaceIndex() = default;
SurfaceIndex::SurfaceIndex(SurfaceIndex&&) noexcept = default;
SurfaceIndex& SurfaceIndex::operator=(SurfaceIndex&&) noexcept = default;

const Surface& SurfaceIndex::surface() const {
  return state_->surface;
}

NearestPlace SurfaceIndex::Nearest(const Vector3d& point) const {
  Search search{
      &state_->surface, point, state_->slack + std::ldexp(point.cwiseAbs().maxCoeff(), -21), {}};
  if (state_->surface.triangles.empty()) return search.nearest;
  RTCPointQuery query{};
  query.x = static_cast<float>(point.x());
  query.y = static_cast<float>(point.y());
  query.z = static_cast<float>(point.z());
  query.radius = std::numeric_limits<float>::infinity();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(state_->scene, &query, &context, VisitTriangle, &search);
  return search.nearest;
}

bool SurfaceIndex::Blocked(const Vector3d& from, const Vector3d& to) const {
  if (state_->surface.triangles.empty()) return false;
  const Vector3d way = to - from;
  RTCRay ray{};
  ray.org_x = static_cast<float>(from.x());
  ray.org_y = static_cast<float>(from.y());
  ray.org_z = static_cast<float>(from.z());
  ray.dir_x = static_cast<float>(way.x());
  ray.dir_y = static_cast<float>(way.y());
  ray.dir_z = static_cast<float>(way.z());
  ray.tnear = 0;
  ray.tfar = 1;
  ray.mask = ~0u;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(state_->scene, &context, &ray);
  return ray.tfar < 0;
}

std::vector<double> Distances(std::span<const Vector3d> points, const SurfaceIndex& index,
                              int threads) {
  std::vector<double> distances(points.size());
  ParallelFor((points.size() + kDistancesOfTask - 1) / kDistancesOfTask, threads,
              [&](size_t block) {
                const size_t end = std::min(points.size(), (block + 1) * kDistancesOfTask);
                for (size_t i = block * kDistancesOfTask; i < end; ++i)
                  distances[i] = index.Distance(points[i]);
              });
  return distances;
}

}  // namespace stucco::evaluate
