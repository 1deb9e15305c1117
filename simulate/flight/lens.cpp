// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulate/random.h"
#include "survey/error.h"

namespace stucco::simulate {
namespace {

constexpr uint64_t kLensSeed = 0x1E45;
constexpr double kFilmDiagonal_mm = 43.2666;  // of 36 x 24 mm

// What the radial terms do at the corner of the frame, as shares of the radius; about those of the
// wide cameras of DJI's factory calibrations.
constexpr double kCornerK1 = -0.075;
constexpr double kCornerK2 = 0.012;
constexpr double kTangential = 2e-4;

void RequireCamera(const PlannedCamera& planned) {
  const bool is_whole = planned.width_px > 0 && planned.height_px > 0 && planned.focal_m > 0 &&
                        planned.sensor_width_m > 0 && planned.sensor_height_m > 0;
  if (is_whole) return;
  throw Error(ErrorKind::kBadInput, "the plan does not say which camera it is for",
              "give its field \"camera\" (docs/formats.md), or make the plan with stucco plan");
}

bool HasARayForEveryPixel(const Camera& camera) {
  constexpr int kSteps = 16;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d pixel(camera.width_px * (i / double{kSteps}),
                                  camera.height_px * (j / double{kSteps}));
      const auto ray = camera.Unproject(pixel);
      if (!ray || !camera.IsInvertibleAt(*ray)) return false;
    }
  }
  return true;
}

}  // namespace

Camera MakeLens(const PlannedCamera& planned, const FlightOptions& options) {
  RequireCamera(planned);
  Random random(SeedOf(static_cast<uint64_t>(options.seed), kLensSeed));
  Camera camera;
  camera.id = CameraId{1};
  camera.model = CameraModel::kOpenCv;
  camera.width_px = std::max(1, static_cast<int>(std::lround(planned.width_px * options.scale)));
  camera.height_px = std::max(1, static_cast<int>(std::lround(planned.height_px * options.scale)));
  const double size = random.Uniform(0.005, 0.015);
  const double off = random.Unit() < 0.5 ? -size : size;
  const double focal_x =
      planned.focal_m / planned.sensor_width_m * camera.width_px * (1 + off * options.distortion);
  // Pixels are square to a few parts in a hundred thousand.
  const double focal_y = focal_x * (1 + 3e-5 * random.Normal() * options.distortion);
  const double shift_px = 0.004 * camera.width_px * options.distortion;
  const double centre_x = camera.width_px / 2.0 + shift_px * random.Uniform(-1, 1);
  const double centre_y = camera.height_px / 2.0 + shift_px * random.Uniform(-1, 1);
  const double corner2 =
      (Eigen::Vector2d(camera.width_px, camera.height_px) / (2 * focal_x)).squaredNorm();
  const double k1 = options.distortion * kCornerK1 * random.Uniform(0.8, 1.2) / corner2;
  const double k2 = options.distortion * kCornerK2 * random.Uniform(0.8, 1.2) / (corner2 * corner2);
  const double p1 = options.distortion * kTangential * random.Uniform(-1, 1);
  const double p2 = options.distortion * kTangential * random.Uniform(-1, 1);
  camera.params = {focal_x, focal_y, centre_x, centre_y, k1, k2, p1, p2};
  if (!HasARayForEveryPixel(camera)) {
    throw Error(
        ErrorKind::kUsage,
        fmt::format("distortion {:g}: this lens would show some places twice", options.distortion),
        "choose a smaller value");
  }
  return camera;
}

int FocalOn35mm_mm(const PlannedCamera& planned) {
  const double diagonal_m = std::hypot(planned.sensor_width_m, planned.sensor_height_m);
  return static_cast<int>(std::lround(planned.focal_m / diagonal_m * kFilmDiagonal_mm));
}

}  // namespace stucco::simulate
