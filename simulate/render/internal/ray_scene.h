// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "simulate/render/internal/alpha_mask.h"
#include "simulate/render/internal/mip_texture.h"
#include "simulate/render/internal/texture_grain.h"
#include "simulate/scene/scene.h"

namespace stucco::simulate::internal {

inline constexpr int kLanes = 8;             // rays that travel together
inline constexpr float kLeastGloss = 0.05f;  // of what mirrors

// A triangle as shading needs it: what a place on its plane has for uv is a linear function of the
// place, which, unlike barycentric coordinates, stays well conditioned on slivers.
struct Surface {
  Eigen::Vector3f corner;
  Eigen::Vector3f normal;   // unit; zero for a triangle without area
  Eigen::Vector3f u_slope;  // du/dp
  Eigen::Vector3f v_slope;
  Eigen::Vector2f uv;  // at `corner`
  int material = 0;
  int element = 0;
};

struct Ray {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  // of any length
  float from = 0;                                       // in lengths of `direction`
  float to = std::numeric_limits<float>::infinity();
};

struct Hit {
  int triangle = -1;
  float at = 0;  // in lengths of the ray's direction
  float b1 = 0;  // barycentric coordinates of the second and third corner
  float b2 = 0;
};

using RayPack = std::array<Ray, kLanes>;
using HitPack = std::array<Hit, kLanes>;

// Triangles, textures and Embree's tree over them. Cut-out materials let rays pass where their
// texture is transparent.
class RayScene {
 public:
  explicit RayScene(Scene scene);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // `count` rays of the pack; `neighbours` says that they run side by side, which is quicker then.
  // Elements of `left_out` are not there.
  HitPack Nearest(const RayPack& rays, int count, const std::vector<bool>& left_out,
                  bool neighbours = true) const;
  // Bit i is set where something is on the way of ray i, wanted in the picture or not: light does
  // not know.
  uint32_t Blocked(const RayPack& rays, int count) const;
  Hit Nearest(const Ray& ray, const std::vector<bool>& left_out) const;

  const Scene& scene() const { return scene_; }  // its textures have no texels left
  const Surface& surface(int triangle) const { return surfaces_[triangle]; }
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const MipTexture* texture(int material) const {
    const int texture = scene_.materials[material].texture;
    return texture < 0 ? nullptr : textures_[texture].get();
  }
  // Detail below the texels; none for what mirrors, is cut out or has no texture.
  const TextureGrain* grain(int material) const;
  Eigen::Vector2f UvAt(int triangle, const Eigen::Vector3f& place) const {
    const Surface& s = surfaces_[triangle];
    const Eigen::Vector3f way = place - s.corner;
    return s.uv + Eigen::Vector2f(s.u_slope.dot(way), s.v_slope.dot(way));
  }

 private:
  // What decides whether a ray passes a cut-out triangle, close together: it is asked often.
  struct Leaf {
    Eigen::Vector2f uv, uv_first, uv_second;  // at a corner, and along both edges from there
    const AlphaMask* mask = nullptr;
  };
  struct Part {  // one Embree geometry
    const RayScene* scene = nullptr;
    std::vector<int> triangles;  // of the scene
    std::vector<Eigen::Vector3i> corners;
    std::vector<Leaf> leaves;  // one per triangle where the part is cut out
  };

  void CheckIndices() const;
  void MakeSurfaces();
  void MakeTextures();
  void MakeTree();
  void AddPart(Part& part, bool cut_out);
  Leaf LeafOf(int triangle) const;
  static void PassThroughHoles(const RTCFilterFunctionNArguments* arguments);
  static void PassLeftOut(const RTCFilterFunctionNArguments* arguments);

  Scene scene_;
  std::vector<Surface> surfaces_;
  std::vector<std::unique_ptr<MipTexture>> textures_;
  std::vector<std::unique_ptr<TextureGrain>> grains_;
  std::vector<std::unique_ptr<AlphaMask>> masks_;  // of textures that are cut out
  std::array<Part, 2> parts_;                      // solid, cut out; the index is Embree's geomID
  RTCDevice device_ = nullptr;
  RTCScene tree_ = nullptr;
};

}  // namespace stucco::simulate::internal
