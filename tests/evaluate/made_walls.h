// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "simulate/flight/flight_folder.h"
#include "simulate/render/renderer.h"
#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco::evaluate {

// A house of 3 x 2 x 2.5 m at the origin, walls B0001/F00 (south) to F03 with waves on them.
Proxy MadeHouse();

// Its walls as a scene, 1 cm a texel; elements are named as facets.
simulate::Scene MadeHouseScene();

// A square of 1 m at right angles to y, `y` in front of the south wall's middle.
void AddBoard(const std::string& element, double y, simulate::Scene& scene);

// The south, east, north and west wall as a perfect survey paints them: what the scene looks like
// at right angles, times `gains`, through the camera's curve. Texels of `texel_m`, whose origin is
// `shift` texels to the left: content lies that far to the right.
struct Painting {
  double texel_m = 0.01;
  double shift = 0;
  Eigen::Vector3d gains = Eigen::Vector3d::Ones();
  std::vector<bool> left_out = {};  // elements that are not painted; their shade is
};
TextureSet PaintHouse(const simulate::Renderer& scene, const simulate::Light& light,
                      const Painting& painting, const std::filesystem::path& folder);

// A photo held out: a camera with a distorted lens south of the house.
simulate::FlownPhoto HeldOutPhoto(const std::string& path, double exposure);

// The picture of a model that carries its light, as the photo's sensor records it.
Image Recorded(const simulate::Renderer& model, const simulate::FlownPhoto& photo);

}  // namespace stucco::evaluate
