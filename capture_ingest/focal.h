// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "capture_ingest/tags.h"
#include "survey/camera.h"

namespace stucco {

// Where self-calibration starts: an OPENCV camera and where its focal length is from, in the words
// of CapturedCamera::focal_source.
struct InitialCamera {
  Camera camera;
  std::string source;
};

// The first of: DJI's dewarp data or calibrated focal length, the 35 mm equivalent, the focal plane
// resolution, the table of sensors, 1.2 times the longer side. Values that would mean a field of
// view no camera has are passed over. The camera's id is not set. Requires sizes above 0, as does
// the next.
InitialCamera InitialIntrinsics(const Tags& tags, int width_px, int height_px);

// "2022-06-08;fx,fy,cx,cy,k1,k2,p1,p2,k3" in pixels, the principal point from the image centre,
// scaled by `scale`; nothing when malformed. Brown's third radial term is folded into the first
// two by least squares over the picture.
std::optional<Camera> CameraFromDewarpData(std::string_view text, int width_px, int height_px,
                                           double scale);

}  // namespace stucco
