// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "simulate/flight/flight_folder.h"
#include "simulate/render/renderer.h"
#include "survey/camera.h"
#include "survey/image.h"
#include "survey/proxy.h"

namespace stucco::evaluate {

// From how far away a photo at right angles to a wall shows it as finely as the finest photo of the
// flight does, taken or lost, in metres: the median over the wall of the least distance over the
// cosine of the angle, of the photos that see a place. A photo that was planned at right angles has
// its own distance. kNotMeasured where no photo sees the wall.
double IdealDistance(const Facet& wall, std::span<const simulate::FlownPhoto> photos,
                     const simulate::Renderer& scene);

// A camera before a wall.
struct IdealShot {
  const simulate::Renderer& scene;
  simulate::Light light;
  std::vector<bool> left_out;  // elements that it sees through
  Camera lens;
  simulate::PictureFaults faults;
  double distance_m = 0;
  std::array<double, 3> gains = {1, 1, 1};  // exposure and white balance
};

struct IdealPicture {
  Image picture;               // codes, on the texels of the plane
  std::vector<uint8_t> shown;  // by texel: nothing nearer than the plane's rays begin hides it
};

// What a wall looks like through photos as good as this camera's can be: at right angles to the
// middle of what each shows, as few as show all of the plane, blurred, noisy, sharpened and
// compressed as those of the flight, but without falloff to the corners; resampled onto the texels
// of the plane (cubically, a texel's pixels averaged), each from the photo before it. Requires a
// distance and a plane with texels.
IdealPicture TakeIdealPhotos(const IdealShot& shot, const simulate::PicturePlane& plane);

}  // namespace stucco::evaluate
