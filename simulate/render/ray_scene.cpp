// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render/internal/ray_scene.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "survey/error.h"
#include "survey/parallel.h"
#include "survey/release.h"

namespace stucco::simulate::internal {
namespace {

constexpr int kCutOutPart = 1;

// What a filter function needs to know about the call that it serves.
struct Context {
  RTCIntersectContext base;  // first: Embree hands back its address
  const std::vector<bool>* left_out = nullptr;
};

void Start(Context& context, const std::vector<bool>& left_out, RTCFilterFunctionN pass_left_out,
           bool coherent) {
  rtcInitIntersectContext(&context.base);
  if (coherent) context.base.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  if (left_out.empty()) return;
  context.left_out = &left_out;
  context.base.filter = pass_left_out;
}

void Load(const RayPack& rays, RTCRay8& to) {
  for (int i = 0; i < kLanes; ++i) {
    const Ray& ray = rays[i];
    to.org_x[i] = ray.origin.x();
    to.org_y[i] = ray.origin.y();
    to.org_z[i] = ray.origin.z();
    to.dir_x[i] = ray.direction.x();
    to.dir_y[i] = ray.direction.y();
    to.dir_z[i] = ray.direction.z();
    to.tnear[i] = ray.from;
    to.tfar[i] = ray.to;
    to.time[i] = 0;
    to.mask[i] = std::numeric_limits<unsigned>::max();
    to.id[i] = static_cast<unsigned>(i);
    to.flags[i] = 0;
  }
}

// Which way u and v of a triangle change with the place: the rows of J with J e = duv for both
// edges and J n = 0. In double, since slivers cancel.
void FindUvSlopes(const Eigen::Vector3d& e1, const Eigen::Vector3d& e2,
                  const Eigen::Matrix2d& uv_edges, Surface& surface) {
  const Eigen::Vector3d normal = e1.cross(e2);
  const double area_squared = normal.squaredNorm();
  if (!(area_squared > 0)) return;
  const Eigen::Vector3d b1_slope = e2.cross(normal) / area_squared;
  const Eigen::Vector3d b2_slope = normal.cross(e1) / area_squared;
  surface.normal = normal.normalized().cast<float>();
  surface.u_slope = (uv_edges(0, 0) * b1_slope + uv_edges(0, 1) * b2_slope).cast<float>();
  surface.v_slope = (uv_edges(1, 0) * b1_slope + uv_edges(1, 1) * b2_slope).cast<float>();
}

bool HasGrain(const Material& material) {
  return material.texture >= 0 && !material.cut_out && material.gloss <= kLeastGloss;
}

bool StaysInside(const Eigen::Vector2f& uv) {
  constexpr float kSlack = 1e-3f;
  return uv.minCoeff() >= -kSlack && uv.maxCoeff() <= 1 + kSlack;
}

}  // namespace

RayScene::RayScene(Scene scene) : scene_(std::move(scene)) {
  CheckIndices();
  MakeSurfaces();
  MakeTextures();
  MakeTree();
}

RayScene::~RayScene() {
  if (tree_) rtcReleaseScene(tree_);
  if (device_) rtcReleaseDevice(device_);
}

void RayScene::CheckIndices() const {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw Error(ErrorKind::kBadInput, fmt::format("the scene is damaged: {}", what));
  };
  const size_t triangles = scene_.triangles.size();
  require(scene_.materials_of.size() == triangles, "not one material per triangle");
  require(scene_.elements_of.size() == triangles, "not one element per triangle");
  require(scene_.uv.size() == scene_.positions.size(), "not one uv per vertex");
  const auto vertices = static_cast<int>(scene_.positions.size());
  for (size_t i = 0; i < triangles; ++i) {
    const Eigen::Vector3i& t = scene_.triangles[i];
    require(t.minCoeff() >= 0 && t.maxCoeff() < vertices, "a triangle without its vertices");
    const int material = scene_.materials_of[i];
    require(material >= 0 && material < static_cast<int>(scene_.materials.size()),
            "a triangle without its material");
    const int element = scene_.elements_of[i];
    require(element >= 0 && element < static_cast<int>(scene_.elements.size()),
            "a triangle without its element");
  }
  for (const Eigen::Vector3f& p : scene_.positions) require(p.allFinite(), "a vertex at infinity");
  for (const Material& material : scene_.materials) {
    require(material.texture < static_cast<int>(scene_.textures.size()),
            "a material without its texture");
  }
  for (const Image& texture : scene_.textures) {
    require(texture.width_px > 0 && texture.height_px > 0 &&
                texture.data.size() ==
                    size_t{1} * texture.width_px * texture.height_px * texture.channels,
            "a texture without its texels");
  }
}

void RayScene::MakeSurfaces() {
  surfaces_.resize(scene_.triangles.size());
  for (size_t i = 0; i < surfaces_.size(); ++i) {
    const Eigen::Vector3i& t = scene_.triangles[i];
    const auto corner = [&](int k) { return scene_.positions[t[k]].cast<double>().eval(); };
    const auto uv = [&](int k) { return scene_.uv[t[k]].cast<double>().eval(); };
    Surface& surface = surfaces_[i];
    surface.corner = scene_.positions[t[0]];
    surface.normal = surface.u_slope = surface.v_slope = Eigen::Vector3f::Zero();
    surface.uv = scene_.uv[t[0]];
    surface.material = scene_.materials_of[i];
    surface.element = scene_.elements_of[i];
    Eigen::Matrix2d uv_edges;
    uv_edges << uv(1) - uv(0), uv(2) - uv(0);
    FindUvSlopes(corner(1) - corner(0), corner(2) - corner(0), uv_edges, surface);
  }
}

void RayScene::MakeTextures() {
  std::vector<char> repeats(scene_.textures.size(), false);
  for (size_t i = 0; i < scene_.triangles.size(); ++i) {
    const int texture = scene_.materials[scene_.materials_of[i]].texture;
    if (texture < 0) continue;
    for (const int vertex : scene_.triangles[i]) {
      if (!StaysInside(scene_.uv[vertex])) repeats[texture] = true;
    }
  }
  std::vector<char> is_cut_out(scene_.textures.size(), false);
  std::vector<char> has_grain(scene_.textures.size(), false);
  for (const Material& material : scene_.materials) {
    if (material.texture < 0) continue;
    if (material.cut_out) is_cut_out[material.texture] = true;
    if (HasGrain(material)) has_grain[material.texture] = true;
  }
  textures_.resize(scene_.textures.size());
  grains_.resize(scene_.textures.size());
  masks_.resize(scene_.textures.size());
  constexpr int kAll = std::numeric_limits<int>::max();
  ParallelFor(textures_.size(), kAll, [&](size_t i) {
    Image& image = scene_.textures[i];
    textures_[i] = std::make_unique<MipTexture>(image, repeats[i]);
    if (is_cut_out[i]) masks_[i] = std::make_unique<AlphaMask>(image, repeats[i]);
    if (has_grain[i]) grains_[i] = std::make_unique<TextureGrain>(image, static_cast<uint32_t>(i));
    Release(image.data);
  });
}

const TextureGrain* RayScene::grain(int material) const {
  const Material& m = scene_.materials[material];
  return HasGrain(m) ? grains_[m.texture].get() : nullptr;
}

RayScene::Leaf RayScene::LeafOf(int triangle) const {
  const Eigen::Vector3i& t = scene_.triangles[triangle];
  const auto& uv = scene_.uv;
  return {uv[t[0]], uv[t[1]] - uv[t[0]], uv[t[2]] - uv[t[0]],
          masks_[scene_.materials[scene_.materials_of[triangle]].texture].get()};
}

void RayScene::MakeTree() {
  device_ = rtcNewDevice(nullptr);
  if (!device_) {
    throw Error(ErrorKind::kStageFailed, "Embree could not be started on this processor");
  }
  tree_ = rtcNewScene(device_);
  rtcSetSceneFlags(tree_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                     RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  for (size_t i = 0; i < scene_.triangles.size(); ++i) {
    const Material& material = scene_.materials[scene_.materials_of[i]];
    Part& part = parts_[material.cut_out && material.texture >= 0 ? kCutOutPart : 0];
    part.triangles.push_back(static_cast<int>(i));
    part.corners.push_back(scene_.triangles[i]);
    if (&part == &parts_[kCutOutPart]) part.leaves.push_back(LeafOf(static_cast<int>(i)));
  }
  // Embree reads 16 bytes at each vertex.
  scene_.positions.emplace_back(Eigen::Vector3f::Zero());
  AddPart(parts_[0], false);
  AddPart(parts_[kCutOutPart], true);
  scene_.positions.pop_back();  // the memory stays
  rtcCommitScene(tree_);
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) {
    throw Error(ErrorKind::kOutOfResource, "Embree could not build its tree over the scene",
                "take a smaller scene, or a machine with more memory");
  }
}

void RayScene::AddPart(Part& part, bool cut_out) {
  part.scene = this;
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (!part.triangles.empty()) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               scene_.positions.data(), 0, sizeof(Eigen::Vector3f),
                               scene_.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               part.corners.data(), 0, sizeof(Eigen::Vector3i),
                               part.corners.size());
  }
  rtcSetGeometryUserData(geometry, &part);
  if (cut_out) {
    rtcSetGeometryIntersectFilterFunction(geometry, PassThroughHoles);
    rtcSetGeometryOccludedFilterFunction(geometry, PassThroughHoles);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(tree_, geometry, cut_out ? kCutOutPart : 0);
  rtcReleaseGeometry(geometry);
}

void RayScene::PassThroughHoles(const RTCFilterFunctionNArguments* arguments) {
  const auto& part = *static_cast<const Part*>(arguments->geometryUserPtr);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] != -1) continue;
    const Leaf& leaf = part.leaves[RTCHitN_primID(arguments->hit, arguments->N, i)];
    const float b1 = RTCHitN_u(arguments->hit, arguments->N, i);
    const float b2 = RTCHitN_v(arguments->hit, arguments->N, i);
    const Eigen::Vector2f at = leaf.uv + b1 * leaf.uv_first + b2 * leaf.uv_second;
    if (!leaf.mask->IsOpaque(at)) arguments->valid[i] = 0;
  }
}

void RayScene::PassLeftOut(const RTCFilterFunctionNArguments* arguments) {
  const auto& context = *reinterpret_cast<const Context*>(arguments->context);
  const auto& part = *static_cast<const Part*>(arguments->geometryUserPtr);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] != -1) continue;
    const int triangle = part.triangles[RTCHitN_primID(arguments->hit, arguments->N, i)];
    const int element = part.scene->surfaces_[triangle].element;
    if (element < static_cast<int>(context.left_out->size()) && (*context.left_out)[element]) {
      arguments->valid[i] = 0;
    }
  }
}

HitPack RayScene::Nearest(const RayPack& rays, int count, const std::vector<bool>& left_out,
                          bool neighbours) const {
  alignas(32) std::array<int, kLanes> valid;
  for (int i = 0; i < kLanes; ++i) valid[i] = i < count ? -1 : 0;
  alignas(32) RTCRayHit8 pack;
  Load(rays, pack.ray);
  for (int i = 0; i < kLanes; ++i) {
    pack.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    pack.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  Context context;
  Start(context, left_out, PassLeftOut, neighbours);
  rtcIntersect8(valid.data(), tree_, &context.base, &pack);
  HitPack hits;
  for (int i = 0; i < count; ++i) {
    if (pack.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    hits[i] = {parts_[pack.hit.geomID[i]].triangles[pack.hit.primID[i]], pack.ray.tfar[i],
               pack.hit.u[i], pack.hit.v[i]};
  }
  return hits;
}

uint32_t RayScene::Blocked(const RayPack& rays, int count) const {
  alignas(32) std::array<int, kLanes> valid;
  for (int i = 0; i < kLanes; ++i) valid[i] = i < count ? -1 : 0;
  alignas(32) RTCRay8 pack;
  Load(rays, pack);
  Context context;
  Start(context, {}, PassLeftOut, true);
  rtcOccluded8(valid.data(), tree_, &context.base, &pack);
  uint32_t blocked = 0;
  for (int i = 0; i < count; ++i) {
    if (pack.tfar[i] < 0) blocked |= 1u << i;
  }
  return blocked;
}

Hit RayScene::Nearest(const Ray& ray, const std::vector<bool>& left_out) const {
  RTCRayHit one{};
  one.ray.org_x = ray.origin.x();
  one.ray.org_y = ray.origin.y();
  one.ray.org_z = ray.origin.z();
  one.ray.dir_x = ray.direction.x();
  one.ray.dir_y = ray.direction.y();
  one.ray.dir_z = ray.direction.z();
  one.ray.tnear = ray.from;
  one.ray.tfar = ray.to;
  one.ray.mask = std::numeric_limits<unsigned>::max();
  one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  Context context;
  Start(context, left_out, PassLeftOut, false);
  rtcIntersect1(tree_, &context.base, &one);
  if (one.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {parts_[one.hit.geomID].triangles[one.hit.primID], one.ray.tfar, one.hit.u, one.hit.v};
}

}  // namespace stucco::simulate::internal
