// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render/internal/shade.h"

#include <algorithm>
#include <cmath>

namespace stucco::simulate::internal {
namespace {

constexpr float kGroundAlbedo = 0.18f;  // of land beyond the scene: fields, woods, roads
// A clean double pane reflects about 8 % at right angles (four faces of 4 %, half of it absorbed
// and passed between them).
constexpr float kPaneReflectance = 0.08f;

// How the sky's brightness changes with the height over the horizon (z of the direction). Both have
// a cosine-weighted mean of 1 over the hemisphere, so that Light::sky is what open ground gets.
float ClearSky(float z) {
  const float low = 1 - z;
  return 0.91f + 1.35f * low * low * low * low;
}
float OvercastSky(float z) {  // Moon and Spencer, "Illumination from a non-uniform sky" (1942)
  return (1 + 2 * z) * 3 / 7;
}

// x to the 24th, round the sun.
float Glow(float x) {
  const float x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
  return x8 * x8 * x8;
}

Eigen::Array3f SkyRadiance(const Lighting& lighting, const Eigen::Vector3f& direction) {
  const float z = std::clamp(direction.z(), 0.0f, 1.0f);
  const Eigen::Array3f sky = lighting.light.sky.array();
  if (lighting.is_overcast) return sky * OvercastSky(z);
  // Near the horizon the long way through air makes it white; a glow lies round the sun.
  const float white = (1 - z) * (1 - z) * (1 - z);
  const Eigen::Array3f colour = sky + 0.7f * white * (lighting.mean_sky - sky);
  const float glow = 0.35f * Glow(std::max(0.0f, direction.dot(lighting.to_sun)));
  return colour * ClearSky(z) + glow * lighting.mean_sky * lighting.light.sun.array();
}

// The ray's footprint on the plane of a triangle: where the rays of the neighbouring pixels meet
// it, to first order (Igehy 1999), scaled to the part of the pixel that shows the triangle.
Footprint FootprintOf(const ViewRay& ray, const Place& place, const Surface& surface,
                      const Eigen::Vector2f& uv) {
  const Eigen::Vector3f& n = surface.normal;
  const float facing = n.dot(ray.ray.direction);
  const float inverse = std::abs(facing) > 1e-12f ? 1 / facing : 0;
  const auto slide = [&](const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
    const Eigen::Vector3f move = origin + place.at * direction;
    const Eigen::Vector3f on_plane =
        place.pixel_side * (move - ray.ray.direction * (n.dot(move) * inverse));
    return Eigen::Vector2f(surface.u_slope.dot(on_plane), surface.v_slope.dot(on_plane));
  };
  return {uv, slide(ray.origin_right, ray.direction_right),
          slide(ray.origin_down, ray.direction_down)};
}

Eigen::Vector3f Reflected(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal) {
  return direction - 2 * direction.dot(normal) * normal;
}

}  // namespace

Lighting LightingOf(const Light& light, const Eigen::Array3f& mean_albedo) {
  // What surfaces around a place send to it: most are ground, largely in the sun, and all see part
  // of the sky.
  constexpr float kShareInSun = 0.65f;
  constexpr float kShareOfSky = 0.7f;
  const float height = std::max(0.0f, static_cast<float>(light.to_sun.z()));
  // Around a house there is more paving and wall than in a scene's mean, which may be all meadow.
  const Eigen::Array3f albedo = (mean_albedo + mean_albedo.mean()) / 2;
  Lighting lighting;
  lighting.light = light;
  lighting.bounce =
      albedo * (kShareInSun * height * light.sun.array() + kShareOfSky * light.sky.array());
  lighting.to_sun = light.to_sun.cast<float>();
  lighting.mean_sky = light.sky.mean();
  lighting.is_overcast = light.sun.maxCoeff() <= 0;
  return lighting;
}

Eigen::Array3f Background(const Lighting& lighting, const Eigen::Vector3f& direction) {
  const Light& light = lighting.light;
  if (!light.lit) return Eigen::Array3f::Zero();
  Eigen::Array3f sky = SkyRadiance(lighting, direction);
  if (direction.z() >= 0) return sky;
  const float height = std::max(0.0f, static_cast<float>(light.to_sun.z()));
  const Eigen::Array3f land = kGroundAlbedo * Eigen::Array3f(0.9f, 1.0f, 0.75f) *
                              (height * light.sun.array() + light.sky.array());
  // Land near the horizon, here seen from 40 m up, is kilometres away and as pale as the sky there.
  constexpr float kHeight_m = 40;
  constexpr float kClearAir_m = 10000;
  const float haze_m = light.haze_m > 0 ? static_cast<float>(light.haze_m) : kClearAir_m;
  const float near = std::exp(kHeight_m / (direction.z() * haze_m));
  return sky + near * (land - sky);
}

bool Shader::FacesSun(int triangle, const Eigen::Vector3f& direction) const {
  const Surface& surface = scene->surface(triangle);
  const Eigen::Vector3f& to_sun = lighting.to_sun;
  if (!lighting.light.lit || lighting.is_overcast || to_sun.z() <= 0) return false;
  if (scene->scene().materials[surface.material].cut_out) return true;
  const float side = surface.normal.dot(direction) > 0 ? -1.0f : 1.0f;
  return side * surface.normal.dot(to_sun) > 0;
}

Ray Shader::ToSun(const Eigen::Vector3f& point, int triangle,
                  const Eigen::Vector3f& direction) const {
  // Off the surface, towards the viewer, by more than floats err at this distance from the origin.
  // Leaves are lit through from behind: towards the sun, or they would stand in their own shadow.
  const Surface& surface = scene->surface(triangle);
  const Eigen::Vector3f& to_sun = lighting.to_sun;
  const bool is_leaf = scene->scene().materials[surface.material].cut_out;
  const float facing = is_leaf ? surface.normal.dot(to_sun) : -surface.normal.dot(direction);
  const float lift = 5e-4f + 2e-6f * point.cwiseAbs().maxCoeff();
  return {point + std::copysign(lift, facing) * surface.normal, to_sun};
}

bool Shader::Mirrors(int triangle) const {
  const Surface& surface = scene->surface(triangle);
  return lighting.light.lit && scene->scene().materials[surface.material].gloss > kLeastGloss &&
         surface.normal.squaredNorm() > 0;
}

Eigen::Array3f Shader::Matt(const Footprint& footprint, const Place& place,
                            const Eigen::Vector3f& direction) const {
  const Surface& surface = scene->surface(place.triangle);
  const Material& material = scene->scene().materials[surface.material];
  Eigen::Array3f albedo = material.colour.array();
  if (const MipTexture* texture = scene->texture(surface.material)) {
    albedo *= texture->Sample(footprint).head<3>();
  }
  const Light& light = lighting.light;
  if (!light.lit) return albedo;
  if (const TextureGrain* grain = scene->grain(surface.material)) albedo *= grain->At(footprint);
  const float side = surface.normal.dot(direction) > 0 ? -1.0f : 1.0f;
  float slant = std::max(0.0f, side * surface.normal.dot(lighting.to_sun));
  // Leaves stand in all directions and pass part of the light.
  if (material.cut_out) slant = 0.35f + 0.35f * slant;
  const float sky = sky_light->At(place.triangle, place.b1, place.b2);
  return albedo * (place.in_sun * slant * light.sun.array() + sky * light.sky.array() +
                   (1 - sky) * lighting.bounce);
}

Eigen::Array3f Shader::Mirrored(const ViewRay& ray, const Place& place,
                                const Eigen::Vector3f& normal) const {
  ViewRay mirrored;
  mirrored.ray.origin = place.point + 1e-3f * normal;
  mirrored.ray.direction = Reflected(ray.ray.direction, normal);
  const auto slide = [&](const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
    const Eigen::Vector3f move = origin + place.at * direction;
    return Eigen::Vector3f(move -
                           ray.ray.direction * (normal.dot(move) / normal.dot(ray.ray.direction)));
  };
  mirrored.origin_right = slide(ray.origin_right, ray.direction_right);
  mirrored.origin_down = slide(ray.origin_down, ray.direction_down);
  mirrored.direction_right = Reflected(ray.direction_right, normal);
  mirrored.direction_down = Reflected(ray.direction_down, normal);
  const Hit hit = scene->Nearest(mirrored.ray, *left_out);
  const Eigen::Vector3f unit = mirrored.ray.direction.normalized();
  if (hit.triangle < 0) return Background(lighting, unit);
  Place there;
  there.triangle = hit.triangle;
  there.point = mirrored.ray.origin + hit.at * mirrored.ray.direction;
  there.at = hit.at;
  there.b1 = hit.b1;
  there.b2 = hit.b2;
  there.pixel_side = place.pixel_side;
  if (FacesSun(hit.triangle, mirrored.ray.direction)) {
    RayPack pack;
    pack[0] = ToSun(there.point, hit.triangle, mirrored.ray.direction);
    there.in_sun = scene->Blocked(pack, 1) ? 0.0f : 1.0f;
  }
  const Footprint footprint = FootprintOf(mirrored, there, scene->surface(hit.triangle),
                                          scene->UvAt(hit.triangle, there.point));
  return Matt(footprint, there, mirrored.ray.direction);
}

Eigen::Array3f Shader::Radiance(const ViewRay& ray, const Place& place) const {
  const Surface& surface = scene->surface(place.triangle);
  const Footprint footprint =
      FootprintOf(ray, place, surface, scene->UvAt(place.triangle, place.point));
  Eigen::Array3f colour = Matt(footprint, place, ray.ray.direction);
  const Light& light = lighting.light;
  if (!light.lit) return colour;
  const Material& material = scene->scene().materials[surface.material];
  const float length = ray.ray.direction.norm();
  if (Mirrors(place.triangle)) {
    const float facing = surface.normal.dot(ray.ray.direction) / length;
    const Eigen::Vector3f normal = facing > 0 ? Eigen::Vector3f(-surface.normal) : surface.normal;
    // Schlick, "An inexpensive BRDF model for physically-based rendering" (1994).
    const float grazing = 1 - std::abs(facing);
    const float squared = grazing * grazing;
    const float fresnel = kPaneReflectance + (1 - kPaneReflectance) * squared * squared * grazing;
    const float share = material.gloss * material.gloss * fresnel;
    colour += share * (Mirrored(ray, place, normal) - colour);
  }
  if (!(light.haze_m > 0)) return colour;
  const float through = std::exp(-place.at * length / static_cast<float>(light.haze_m));
  const Eigen::Vector3f horizon(ray.ray.direction.x(), ray.ray.direction.y(), 0);
  const Eigen::Array3f air = SkyRadiance(lighting, horizon.normalized());
  return air + through * (colour - air);
}

}  // namespace stucco::simulate::internal
