// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/evaluate/made_walls.h"

#include <cmath>

#include "evaluate/picture/tone.h"
#include "simulate/flight/sensor.h"
#include "survey/srgb.h"
#include "tests/evaluate/made_pictures.h"
#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

// A rectangle a, b, c, d counter-clockwise from its lower left corner, with a picture.
void AddRectangle(const std::string& element, const std::vector<Vector3d>& corners, Image texture,
                  simulate::Scene& scene) {
  const int first = static_cast<int>(scene.positions.size());
  const int index = static_cast<int>(scene.elements.size());
  for (const Vector3d& corner : corners) scene.positions.push_back(corner.cast<float>());
  for (const auto& [u, v] : {std::pair{0, 1}, {1, 1}, {1, 0}, {0, 0}}) {
    scene.uv.emplace_back(static_cast<float>(u), static_cast<float>(v));
  }
  scene.triangles.push_back({first, first + 1, first + 2});
  scene.triangles.push_back({first, first + 2, first + 3});
  scene.materials_of.insert(scene.materials_of.end(), 2, static_cast<int>(scene.materials.size()));
  scene.elements_of.insert(scene.elements_of.end(), 2, index);
  simulate::Material material;
  material.name = element;
  material.texture = static_cast<int>(scene.textures.size());
  scene.materials.push_back(material);
  scene.textures.push_back(std::move(texture));
  scene.elements.push_back(element);
}

}  // namespace

Proxy MadeHouse() {
  Proxy house;
  house.metric = true;
  house.buildings = {MadeBox("B0001", {0, 0, 0}, {3, 2, 2.5})};
  return house;
}

simulate::Scene MadeHouseScene() {
  simulate::Scene scene;
  const Proxy house = MadeHouse();
  for (const Facet& facet : house.buildings[0].facets) {
    if (facet.facet_class != FacetClass::kWall) continue;
    const double width = (facet.outer[1] - facet.outer[0]).norm();
    const double height = (facet.outer[3] - facet.outer[0]).norm();
    AddRectangle(facet.id, facet.outer,
                 Waves(static_cast<int>(std::lround(width / 0.01)),
                       static_cast<int>(std::lround(height / 0.01))),
                 scene);
  }
  return scene;
}

void AddBoard(const std::string& element, double y, simulate::Scene& scene) {
  AddRectangle(element, {{1, -y, 0.5}, {2, -y, 0.5}, {2, -y, 1.5}, {1, -y, 1.5}},
               Plain(8, 8, 20, 200, 20), scene);
}

TextureSet PaintHouse(const simulate::Renderer& scene, const simulate::Light& light,
                      const Painting& painting, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  TextureSet textures;
  const Proxy house = MadeHouse();
  for (const Facet& facet : house.buildings[0].facets) {
    if (facet.facet_class != FacetClass::kWall) continue;
    const Vector3d along = facet.outer[1] - facet.outer[0];
    simulate::PicturePlane plane;
    plane.origin = facet.outer[3];
    plane.u_axis = along.normalized();
    plane.metres_per_texel = painting.texel_m;
    plane.width_px = static_cast<int>(std::lround(along.norm() / painting.texel_m));
    plane.height_px =
        static_cast<int>(std::lround((facet.outer[3] - facet.outer[0]).norm() / painting.texel_m));
    TexturedFacet texture;
    texture.id = facet.id;
    texture.image = "wall" + facet.id.substr(facet.id.size() - 2) + ".png";
    texture.width_px = plane.width_px;
    texture.height_px = plane.height_px;
    texture.metres_per_texel = plane.metres_per_texel;
    texture.origin = plane.origin;
    texture.u_axis = plane.u_axis;
    texture.v_axis = plane.v_axis;
    plane.origin -= painting.shift * painting.texel_m * plane.u_axis;
    const simulate::Radiance radiance =
        scene.Flatten(plane, light, {.threads = 1, .left_out = painting.left_out});
    const Eigen::Vector3d& gains = painting.gains;
    WriteImage(Developed(radiance.rgb, {plane.width_px, plane.height_px},
                         {gains.x(), gains.y(), gains.z()}),
               folder / texture.image);
    textures.facets.push_back(std::move(texture));
  }
  return textures;
}

simulate::FlownPhoto HeldOutPhoto(const std::string& path, double exposure) {
  simulate::FlownPhoto photo;
  photo.path = path;
  photo.camera = {CameraId{2}, CameraModel::kRadial, 480, 360, {420, 240, 180, -0.08, 0.02}};
  Eigen::Matrix3d rotation;  // x east, y down, z north
  rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  photo.cam_from_world.rotation = rotation;
  photo.cam_from_world.translation = -(rotation * Eigen::Vector3d(1.2, -4, 1.3));
  photo.exposure = exposure;
  photo.white_balance = {1.1, 1, 0.9};
  photo.held_out = true;
  return photo;
}

Image Recorded(const simulate::Renderer& model, const simulate::FlownPhoto& photo) {
  constexpr double kLost = 0.3;  // light in the farthest corner
  simulate::Radiance radiance =
      model.Photograph(photo.camera, photo.cam_from_world, {.lit = false});
  for (size_t i = 0; i < radiance.rgb.size(); ++i) {
    const Eigen::Vector2d pixel(i / 3 % photo.camera.width_px + 0.5,
                                i / 3 / photo.camera.width_px + 0.5);
    radiance.rgb[i] = LightOfCode(SrgbCode(radiance.rgb[i])) *
                      static_cast<float>(simulate::Vignetting(photo.camera, kLost, pixel));
  }
  const Eigen::Vector3d gains = 0.8 * photo.exposure * photo.white_balance;
  return Developed(radiance.rgb, {photo.camera.width_px, photo.camera.height_px},
                   {gains.x(), gains.y(), gains.z()});
}

}  // namespace stucco::evaluate
