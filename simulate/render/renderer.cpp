// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render/renderer.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <limits>
#include <mutex>

#include "simulate/render/internal/picture.h"
#include "simulate/render/internal/ray_scene.h"
#include "simulate/render/internal/shade.h"
#include "simulate/render/internal/sky_light.h"
#include "simulate/render/internal/view.h"
#include "survey/error.h"

namespace stucco::simulate {
namespace {

using internal::RayScene;
using internal::SkyLight;

int ThreadsOf(const RenderOptions& options) {
  return options.threads > 0 ? options.threads : std::numeric_limits<int>::max();
}

void RequireSane(const Camera& camera, const Pose& cam_from_world) {
  if (const auto problem = FindProblem(camera)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("no picture can be drawn: the camera's {}", *problem));
  }
  if (!cam_from_world.translation.allFinite() || !cam_from_world.rotation.coeffs().allFinite()) {
    throw Error(ErrorKind::kBadInput, "no picture can be drawn: the camera's pose is not finite");
  }
}

// What surfaces reflect on average, by area.
Eigen::Array3f MeanAlbedo(const RayScene& scene) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  double area = 0;
  std::vector<Eigen::Array3d> albedos;
  for (size_t i = 0; i < scene.scene().materials.size(); ++i) {
    const internal::MipTexture* texture = scene.texture(static_cast<int>(i));
    Eigen::Array3f albedo = scene.scene().materials[i].colour.array();
    if (texture) albedo *= texture->Mean();
    albedos.push_back(albedo.cast<double>());
  }
  for (const Eigen::Vector3i& t : scene.scene().triangles) {
    const auto& p = scene.scene().positions;
    const size_t i = &t - scene.scene().triangles.data();
    const double part = 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm();
    sum += part * albedos[scene.scene().materials_of[i]];
    area += part;
  }
  return area > 0 ? (sum / area).cast<float>().eval() : Eigen::Array3f::Zero().eval();
}

}  // namespace

struct Renderer::State {
  RayScene scene;
  Eigen::Array3f mean_albedo;
  internal::LensTables lenses;
  std::once_flag sky_light_made;
  std::unique_ptr<const SkyLight> sky_light;  // only lit pictures need it

  explicit State(Scene model) : scene(std::move(model)), mean_albedo(MeanAlbedo(scene)) {}

  void MakeSkyLight() {
    std::call_once(sky_light_made, [&] { sky_light = std::make_unique<SkyLight>(scene); });
  }

  Radiance Draw(const internal::View& view, const Light& light, const RenderOptions& options) {
    if (light.lit) MakeSkyLight();
    internal::Shader shader;
    shader.scene = &scene;
    shader.sky_light = sky_light.get();
    shader.lighting = internal::LightingOf(light, mean_albedo);
    shader.left_out = &options.left_out;
    return internal::DrawPicture(view, shader, ThreadsOf(options));
  }
};

Renderer::Renderer(Scene scene) : state_(std::make_unique<State>(std::move(scene))) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const Scene& Renderer::scene() const {
  return state_->scene.scene();
}

void Renderer::PrepareLight() const {
  state_->MakeSkyLight();
}

Radiance Renderer::Photograph(const Camera& camera, const Pose& cam_from_world, const Light& light,
                              const RenderOptions& options) const {
  RequireSane(camera, cam_from_world);
  return state_->Draw(internal::ViewOf(state_->lenses.For(camera), camera, cam_from_world), light,
                      options);
}

Radiance Renderer::Flatten(const PicturePlane& plane, const Light& light,
                           const RenderOptions& options) const {
  return state_->Draw(internal::ViewOf(plane), light, options);
}

std::vector<float> Renderer::Heights(const PicturePlane& plane,
                                     const RenderOptions& options) const {
  RenderOptions limited = options;
  limited.threads = ThreadsOf(options);
  std::vector<float> heights =
      internal::MeasureWays(internal::ViewOf(plane), state_->scene, limited);
  for (float& value : heights) {
    value = value > 0 ? static_cast<float>(plane.from_m) - value
                      : std::numeric_limits<float>::quiet_NaN();
  }
  return heights;
}

DepthMap Renderer::Depth(const Camera& camera, const Pose& cam_from_world,
                         const RenderOptions& options) const {
  RequireSane(camera, cam_from_world);
  RenderOptions limited = options;
  limited.threads = ThreadsOf(options);
  const internal::View view = internal::ViewOf(state_->lenses.For(camera), camera, cam_from_world);
  return ExactDepths(camera.width_px, camera.height_px,
                     internal::MeasureWays(view, state_->scene, limited));
}

std::optional<RayHit> Renderer::Cast(const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& direction) const {
  if (!from.allFinite() || !direction.allFinite() || direction.isZero(0)) return std::nullopt;
  const Eigen::Vector3d unit = direction.normalized();
  internal::Ray ray;
  ray.origin = from.cast<float>();
  ray.direction = unit.cast<float>();
  const internal::Hit hit = state_->scene.Nearest(ray, {});
  if (hit.triangle < 0) return std::nullopt;
  const internal::Surface& surface = state_->scene.surface(hit.triangle);
  Eigen::Vector3d normal = surface.normal.cast<double>();
  if (normal.dot(unit) > 0) normal = -normal;
  return RayHit{from + static_cast<double>(hit.at) * unit, normal, hit.at, surface.element};
}

}  // namespace stucco::simulate
