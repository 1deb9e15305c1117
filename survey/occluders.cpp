// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/occluders.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "survey/error.h"

namespace stucco {

struct Occluders::State {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // taken off, as rays are in float

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  void Attach(std::span<const Eigen::Vector3d> vertices,
              std::span<const std::array<uint32_t, 3>> triangles) const;
};

void Occluders::State::Attach(std::span<const Eigen::Vector3d> vertices,
                              std::span<const std::array<uint32_t, 3>> triangles) const {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* xyz = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices.size()));
  for (size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3f local = (vertices[i] - center).cast<float>();
    std::copy_n(local.data(), 3, xyz + 3 * i);
  }
  auto* corners = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), triangles.size()));
  for (size_t i = 0; i < triangles.size(); ++i) {
    std::copy_n(triangles[i].data(), 3, corners + 3 * i);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

Occluders::Occluders(std::span<const Eigen::Vector3d> vertices,
                     std::span<const std::array<uint32_t, 3>> triangles)
    : state_(std::make_unique<State>()) {
  assert(std::ranges::all_of(triangles,
                             [&](const auto& t) { return std::ranges::max(t) < vertices.size(); }));
  for (const Eigen::Vector3d& vertex : vertices) state_->center += vertex;
  if (!vertices.empty()) state_->center /= static_cast<double>(vertices.size());
  // Without a number of threads: one would hold for TBB in the whole process while the device
  // lives.
  state_->device = rtcNewDevice(nullptr);
  if (!state_->device) {
    throw Error(ErrorKind::kStageFailed, "Embree could not be started on this processor");
  }
  state_->scene = rtcNewScene(state_->device);
  rtcSetSceneFlags(state_->scene, RTC_SCENE_FLAG_ROBUST);
  if (!triangles.empty()) state_->Attach(vertices, triangles);
  rtcCommitScene(state_->scene);
}

Occluders::~Occluders() = default;
Occluders::Occluders(Occluders&&) noexcept = default;
Occluders& Occluders::operator=(Occluders&&) noexcept = default;

namespace {

RTCRay MakeRay(const Eigen::Vector3d& from, const Eigen::Vector3d& way, float reach) {
  const Eigen::Vector3f start = from.cast<float>();
  const Eigen::Vector3f direction = way.cast<float>();
  RTCRay ray{};
  ray.org_x = start.x();
  ray.org_y = start.y();
  ray.org_z = start.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = 0;
  ray.tfar = reach;
  ray.mask = std::numeric_limits<unsigned>::max();
  return ray;
}

}  // namespace

bool Occluders::Block(const Eigen::Vector3d& from, const Eigen::Vector3d& way, double reach) const {
  RTCRay ray = MakeRay(from - state_->center, way, static_cast<float>(reach));
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(state_->scene, &context, &ray);
  return ray.tfar < 0;
}

std::optional<double> Occluders::FirstHit(const Eigen::Vector3d& from,
                                          const Eigen::Vector3d& way) const {
  RTCRayHit hit{};
  hit.ray = MakeRay(from - state_->center, way, std::numeric_limits<float>::infinity());
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(state_->scene, &context, &hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return hit.ray.tfar;
}

}  // namespace stucco
