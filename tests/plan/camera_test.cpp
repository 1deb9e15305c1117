// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "plan/camera/preset.h"
#include "survey/error.h"

namespace stucco::plan {
namespace {

using testing::HasSubstr;

TEST(FindCamera, KnowsTheMavic) {
  const CameraPreset preset = FindCamera("mavic-3e");
  EXPECT_EQ(preset.camera.name, "mavic-3e");
  EXPECT_EQ(preset.camera.label, "DJI Mavic 3 Enterprise, wide");
  EXPECT_NEAR(preset.camera.sensor_width_m, 0.0173, 1e-12);
  EXPECT_NEAR(preset.camera.sensor_height_m, 0.013, 1e-12);
  EXPECT_NEAR(preset.camera.focal_m, 0.01229, 1e-12);
  EXPECT_EQ(preset.camera.width_px, 5280);
  EXPECT_EQ(preset.camera.height_px, 3956);
  EXPECT_EQ(preset.dji_drone, 77);
  EXPECT_EQ(preset.dji_payload, 66);
  EXPECT_EQ(preset.battery_scale, 1);
}

TEST(FindCamera, EveryPresetIsPossible) {
  const std::vector<std::string> names = CameraNames();
  EXPECT_THAT(names, testing::UnorderedElementsAre("mavic-3e", "phantom-4-rtk", "m300-p1-35",
                                                   "mini-3-pro"));
  for (const std::string& name : names) {
    const CameraPreset preset = FindCamera(name);
    const PlannedCamera& camera = preset.camera;
    EXPECT_FALSE(camera.label.empty());
    EXPECT_NEAR(camera.sensor_width_m / camera.width_px, camera.sensor_height_m / camera.height_px,
                1e-3 * 1e-3)
        << name;
    EXPECT_GT(preset.HorizontalFov(), 50 * std::numbers::pi / 180) << name;
    EXPECT_LT(preset.HorizontalFov(), 80 * std::numbers::pi / 180) << name;
    EXPECT_GT(preset.battery_scale, 0.9) << name;
    EXPECT_LT(preset.battery_scale, 2) << name;
  }
  EXPECT_EQ(FindCamera("m300-p1-35").dji_drone, 60);
  EXPECT_EQ(FindCamera("mini-3-pro").dji_drone, 68);
}

TEST(CameraPreset, GeometryOfAKnownCamera) {
  const CameraPreset preset = FindCamera("20x10mm,10mm,2000x1000");
  EXPECT_NEAR(preset.HorizontalFov(), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(preset.WidthAt(30), 60, 1e-9);
  EXPECT_NEAR(preset.HeightAt(30), 30, 1e-9);
  EXPECT_NEAR(preset.PixelPitch(), 1e-5, 1e-15);
  EXPECT_NEAR(preset.DistanceForGsd(0.04), 40, 1e-9);
}

TEST(FindCamera, TakesACameraInNumbers) {
  for (const char* text :
       {"17.3x13mm,12.29mm,5280x3956", " 17.3 x 13 mm , 12.29 mm , 5280 x 3956 px",
        "17.3X13,12.29,5280X3956"}) {
    const CameraPreset preset = FindCamera(text);
    EXPECT_NEAR(preset.camera.sensor_width_m, 0.0173, 1e-12);
    EXPECT_NEAR(preset.camera.focal_m, 0.01229, 1e-12);
    EXPECT_EQ(preset.camera.height_px, 3956);
    EXPECT_EQ(preset.dji_drone, 0);
  }
}

std::string Complaint(const std::string& name) {
  try {
    FindCamera(name);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    return std::string(error.what()) + " | " + error.remedy();
  }
  return "";
}

TEST(FindCamera, SuggestsTheNearestName) {
  EXPECT_THAT(Complaint("mavic3e"), HasSubstr("did you mean mavic-3e?"));
  EXPECT_THAT(Complaint("phantom-4"), HasSubstr("did you mean phantom-4-rtk?"));
  EXPECT_THAT(Complaint("hasselblad"), testing::Not(HasSubstr("did you mean")));
  EXPECT_THAT(Complaint("hasselblad"),
              HasSubstr("m300-p1-35, mavic-3e, mini-3-pro, phantom-4-rtk"));
  EXPECT_THAT(Complaint(""), HasSubstr("there is no such camera"));
}

TEST(FindCamera, RefusesWhatIsNoCamera) {
  EXPECT_THAT(Complaint("17.3x13mm,12.29mm"), HasSubstr("there is no such camera"));
  EXPECT_THAT(Complaint("1.2.3x13mm,12mm,5280x3956"), HasSubstr("there is no such camera"));
  EXPECT_THAT(Complaint("173x130mm,12mm,5280x3956"), HasSubstr("1 to 100 mm"));
  EXPECT_THAT(Complaint("17.3x13mm,0mm,5280x3956"), HasSubstr("focal length is 1 to 1000 mm"));
  EXPECT_THAT(Complaint("17.3x13mm,12mm,52x39"), HasSubstr("100 to 50000 pixels"));
  EXPECT_THAT(Complaint("17.3x13mm,12mm,99999999999x39"), HasSubstr("there is no such camera"));
  EXPECT_THAT(Complaint("13x17.3mm,12.29mm,5280x3956"), HasSubstr("pixels are square"));
}

}  // namespace
}  // namespace stucco::plan
