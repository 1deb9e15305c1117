// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "simulate/render/internal/ray_scene.h"
#include "simulate/render/internal/sky_light.h"
#include "simulate/render/internal/view.h"
#include "simulate/render/light.h"

namespace stucco::simulate::internal {

struct Lighting {
  Light light;
  Eigen::Array3f bounce = Eigen::Array3f::Zero();  // what places get where they do not see the sky
  // Of `light`, as every ray needs it.
  Eigen::Vector3f to_sun = Eigen::Vector3f::UnitZ();
  float mean_sky = 0;
  bool is_overcast = false;
};

Lighting LightingOf(const Light& light, const Eigen::Array3f& mean_albedo);

// Radiance of the sky and, below the horizon, of land far away, in a unit direction; black where
// light.lit is false.
Eigen::Array3f Background(const Lighting& lighting, const Eigen::Vector3f& direction);

// A place where a ray, or several rays of one pixel, met a triangle.
struct Place {
  int triangle = -1;
  Eigen::Vector3f point;
  float at = 0;  // in lengths of the ray's direction
  float b1 = 0;
  float b2 = 0;
  float in_sun = 0;      // share of its rays that see the sun
  float pixel_side = 1;  // of the part of the pixel that shows it
};

struct Shader {
  const RayScene* scene = nullptr;
  const SkyLight* sky_light = nullptr;  // may be missing where light.lit is false
  Lighting lighting;
  const std::vector<bool>* left_out = nullptr;

  // What a ray that met a triangle sees there.
  Eigen::Array3f Radiance(const ViewRay& ray, const Place& place) const;
  // True for panes, which mirror more than nothing.
  bool Mirrors(int triangle) const;
  // True where the sun can shine on this side of the triangle.
  bool FacesSun(int triangle, const Eigen::Vector3f& direction) const;
  // The way from a place towards the sun.
  Ray ToSun(const Eigen::Vector3f& point, int triangle, const Eigen::Vector3f& direction) const;

 private:
  Eigen::Array3f Matt(const Footprint& footprint, const Place& place,
                      const Eigen::Vector3f& direction) const;
  Eigen::Array3f Mirrored(const ViewRay& ray, const Place& place,
                          const Eigen::Vector3f& normal) const;
};

}  // namespace stucco::simulate::internal
