// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace stucco::simulate {

// What shines on a scene. Values are linear and relative: a white surface lit by `sun` at right
// angles and nothing else has radiance `sun`.
struct Light {
  bool lit = true;  // false: colours as they are (albedo), for models that carry their light
  Eigen::Vector3d to_sun = Eigen::Vector3d(0.3, -0.5, 0.81).normalized();
  Eigen::Vector3f sun = {1.0f, 0.96f, 0.88f};
  Eigen::Vector3f sky = {0.30f, 0.36f, 0.46f};  // an open horizontal surface gets this
  double haze_m = 0;                            // distance at which contrast is 1/e; 0: clear air
};

// The sun's direction (towards it) at an hour of local solar time on a day of 2026, 1 is January 1;
// 366 is that of 2027. Meeus, "Astronomical Algorithms" (1998), ch. 25, to a tenth of a degree at
// the longitude of Greenwich; half a day of declination, 0.2 degrees, at the other side of the
// earth.
Eigen::Vector3d SunDirection(double latitude_deg, int day_of_2026, double solar_hour);

}  // namespace stucco::simulate
