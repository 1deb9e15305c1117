// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/gimbal.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "survey/attitude.h"

namespace stucco {
namespace {

struct Convention {
  const char* yaw;
  const char* pitch;
  const char* roll;
  bool nadir_is_zero;  // pitch 0 looks straight down (Pix4D's Camera namespace)
};

constexpr std::array kConventions = {
    Convention{"Xmp.drone-dji.GimbalYawDegree", "Xmp.drone-dji.GimbalPitchDegree",
               "Xmp.drone-dji.GimbalRollDegree", false},
    // Autel since the EVO II.
    Convention{"Xmp.drone.GimbalYawDegree", "Xmp.drone.GimbalPitchDegree",
               "Xmp.drone.GimbalRollDegree", false},
    Convention{"Xmp.drone-parrot.CameraYawDegree", "Xmp.drone-parrot.CameraPitchDegree",
               "Xmp.drone-parrot.CameraRollDegree", false},
    Convention{"Xmp.drone-skydio.CameraOrientationNED/drone-skydio:Yaw",
               "Xmp.drone-skydio.CameraOrientationNED/drone-skydio:Pitch",
               "Xmp.drone-skydio.CameraOrientationNED/drone-skydio:Roll", false},
    Convention{"Xmp.skydio.CameraOrientationNED/skydio:Yaw",
               "Xmp.skydio.CameraOrientationNED/skydio:Pitch",
               "Xmp.skydio.CameraOrientationNED/skydio:Roll", false},
    // senseFly, Parrot Sequoia, early Autel.
    Convention{"Xmp.Camera.Yaw", "Xmp.Camera.Pitch", "Xmp.Camera.Roll", true},
};

bool IsSenseFly(const Tags& tags) {
  const std::string make = Text(tags, "Exif.Image.Make");
  return make == "senseFly" || make == "SENSEFLY" || make == "sensefly";
}

std::optional<GimbalAngles> Read(const Tags& tags, const Convention& convention) {
  const auto yaw = Number(tags, convention.yaw);
  const auto pitch = Number(tags, convention.pitch);
  if (!yaw || !pitch) return std::nullopt;
  GimbalAngles angles{*yaw, *pitch, Number(tags, convention.roll).value_or(0)};
  if (convention.nadir_is_zero) {
    angles.pitch_deg -= 90;
    if (IsSenseFly(tags)) angles.roll_deg = -angles.roll_deg;
  }
  return angles;
}

std::optional<std::string> FindProblem(const GimbalAngles& angles) {
  if (!(std::abs(angles.yaw_deg) <= 360) || !(std::abs(angles.pitch_deg) <= 180) ||
      !(std::abs(angles.roll_deg) <= 180)) {
    return fmt::format("gimbal angles {:g}, {:g}, {:g} are out of range", angles.yaw_deg,
                       angles.pitch_deg, angles.roll_deg);
  }
  if (angles.yaw_deg == 0 && angles.pitch_deg == 0 && angles.roll_deg == 0) {
    return std::string("gimbal angles of exactly 0, 0, 0 are a placeholder");
  }
  return std::nullopt;
}

}  // namespace

GimbalAngles Normalized(const GimbalAngles& angles) {
  GimbalAngles same{WrappedDegrees(angles.yaw_deg), WrappedDegrees(angles.pitch_deg),
                    WrappedDegrees(angles.roll_deg)};
  if (std::abs(same.roll_deg) <= 90) return same;
  // (yaw, pitch, roll) and (yaw + 180, 180 - pitch, roll + 180) are one rotation.
  const GimbalAngles other{WrappedDegrees(same.yaw_deg + 180), WrappedDegrees(180 - same.pitch_deg),
                           WrappedDegrees(same.roll_deg + 180)};
  constexpr double kMostPitch_deg = 100;  // past straight down by what gimbals reach
  return std::abs(other.pitch_deg) <= kMostPitch_deg ? other : same;
}

GimbalReading ReadGimbal(const Tags& tags) {
  GimbalReading reading;
  for (const Convention& convention : kConventions) {
    const auto angles = Read(tags, convention);
    if (!angles) continue;
    if (auto problem = FindProblem(*angles)) {
      reading.doubts.push_back(std::move(*problem));
      continue;
    }
    reading.angles = Normalized(*angles);
    return reading;
  }
  return reading;
}

}  // namespace stucco
