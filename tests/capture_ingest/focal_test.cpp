// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/focal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "capture_ingest/sensors.h"

namespace stucco {
namespace {

constexpr char kDewarp[] =
    "2022-03-02;1973.0899658,1955.6500244,-19.0419922,-11.4249878,-0.42275,0.369101,0.0040638,"
    "0.0040638,-0.264306";

TEST(InitialIntrinsics, DewarpDataComeFirst) {
  const Tags tags = {{"Xmp.drone-dji.DewarpData", kDewarp},
                     {"Xmp.drone-dji.CalibratedOpticalCenterX", "800"},
                     {"Exif.Photo.FocalLengthIn35mmFilm", "40"}};
  const InitialCamera initial = InitialIntrinsics(tags, 1600, 1300);
  EXPECT_EQ(initial.source, "dewarp");
  const auto& p = initial.camera.params;
  ASSERT_EQ(p.size(), 8U);
  EXPECT_DOUBLE_EQ(p[0], 1973.0899658);
  EXPECT_DOUBLE_EQ(p[1], 1955.6500244);
  EXPECT_DOUBLE_EQ(p[2], 800 - 19.0419922);
  EXPECT_DOUBLE_EQ(p[3], 650 - 11.4249878);
  EXPECT_DOUBLE_EQ(p[6], 0.0040638);
  EXPECT_EQ(FindProblem(initial.camera), std::nullopt);
}

TEST(InitialIntrinsics, ThirdRadialTermIsFoldedIntoTheOthers) {
  const auto camera = CameraFromDewarpData(kDewarp, 1600, 1300, 1);
  ASSERT_TRUE(camera);
  const double corner = std::hypot(800 / 1973.09, 650 / 1955.65);
  for (double r = 0; r <= corner; r += 0.05) {
    const double r2 = r * r;
    const double full = r * (1 - 0.42275 * r2 + 0.369101 * r2 * r2 - 0.264306 * r2 * r2 * r2);
    const double folded = r * (1 + camera->params[4] * r2 + camera->params[5] * r2 * r2);
    EXPECT_NEAR(full * 1973, folded * 1973, 1.0) << r;  // pixels
  }
}

TEST(InitialIntrinsics, DewarpDataScaleWithThePhoto) {
  const Tags tags = {{"Xmp.drone-dji.DewarpData", kDewarp},
                     {"Xmp.drone-dji.CalibratedOpticalCenterX", "800"}};
  const InitialCamera half = InitialIntrinsics(tags, 800, 650);
  EXPECT_DOUBLE_EQ(half.camera.params[0], 1973.0899658 / 2);
  EXPECT_DOUBLE_EQ(half.camera.params[2], 400 - 19.0419922 / 2);
}

TEST(InitialIntrinsics, DewarpedPhotosHaveNoDistortion) {
  const Tags tags = {{"Xmp.drone-dji.DewarpData", kDewarp}, {"Xmp.drone-dji.DewarpFlag", "1"}};
  const InitialCamera initial = InitialIntrinsics(tags, 1600, 1300);
  EXPECT_EQ(initial.source, "dewarp");
  for (size_t i = 4; i < 8; ++i) EXPECT_EQ(initial.camera.params[i], 0);
}

TEST(InitialIntrinsics, MalformedDewarpDataFallThrough) {
  for (const char* text :
       {"", "2022-03-02;", "2022;1,2,3", "2022;0,0,0,0,0,0,0,0,0", "2022;a,b,c,d,e,f,g,h,i",
        "2022;1973,1955,99999,0,0,0,0,0,0", "2022;nan,1955,0,0,0,0,0,0,0"}) {
    const Tags tags = {{"Xmp.drone-dji.DewarpData", text},
                       {"Xmp.drone-dji.CalibratedFocalLength", "1913.333374"}};
    const InitialCamera initial = InitialIntrinsics(tags, 1600, 1300);
    EXPECT_EQ(initial.source, "dewarp") << text;
    EXPECT_DOUBLE_EQ(initial.camera.params[0], 1913.333374) << text;
  }
}

// Makers define the equivalent over the diagonal: these are their own calibrated values.
TEST(InitialIntrinsics, EquivalentOf35mmIsNearCalibratedValues) {
  const Tags p4m = {{"Exif.Photo.FocalLengthIn35mmFilm", "40"}};
  EXPECT_EQ(InitialIntrinsics(p4m, 1600, 1300).source, "exif_35mm");
  EXPECT_NEAR(InitialIntrinsics(p4m, 1600, 1300).camera.params[0], 1913, 0.02 * 1913);
  const Tags mavic_pro = {{"Exif.Photo.FocalLengthIn35mmFilm", "26"}};
  EXPECT_NEAR(InitialIntrinsics(mavic_pro, 4000, 2250).camera.params[0], 3066, 0.03 * 3066);
  EXPECT_DOUBLE_EQ(InitialIntrinsics(mavic_pro, 2250, 4000).camera.params[0],
                   InitialIntrinsics(mavic_pro, 4000, 2250).camera.params[0]);
}

TEST(InitialIntrinsics, FocalPlaneResolutionInEveryUnit) {
  // 5 mm behind 4000 pixels on 6.25 mm: 3200 pixels.
  const double per_mm = 4000 / 6.25;
  const std::pair<const char*, double> units[] = {
      {"2", per_mm * 25.4}, {"3", per_mm * 10}, {"4", per_mm}, {"5", per_mm / 1000}};
  for (const auto& [unit, resolution] : units) {
    const Tags tags = {{"Exif.Photo.FocalLength", "50/10"},
                       {"Exif.Photo.FocalLengthIn35mmFilm", "0"},
                       {"Exif.Photo.FocalPlaneXResolution", std::to_string(resolution)},
                       {"Exif.Photo.FocalPlaneResolutionUnit", unit},
                       {"Exif.Photo.PixelXDimension", "4000"}};
    EXPECT_EQ(InitialIntrinsics(tags, 4000, 3000).source, "exif_sensor") << unit;
    EXPECT_NEAR(InitialIntrinsics(tags, 4000, 3000).camera.params[0], 3200, 1) << unit;
    EXPECT_NEAR(InitialIntrinsics(tags, 2000, 1500).camera.params[0], 1600, 1) << unit;
  }
}

TEST(InitialIntrinsics, SensorTableThenDefault) {
  const Tags kodak = {{"Exif.Image.Model", "KODAK Z612 ZOOM DIGITAL CAMERA"},
                      {"Exif.Photo.FocalLength", "58/10"}};
  const InitialCamera initial = InitialIntrinsics(kodak, 2832, 2128);
  EXPECT_EQ(initial.source, "sensor_table");
  EXPECT_NEAR(initial.camera.params[0], 5.8 / 5.75 * 2832, 1e-9);
  const InitialCamera unknown = InitialIntrinsics({}, 1000, 3000);
  EXPECT_EQ(unknown.source, "default");
  EXPECT_DOUBLE_EQ(unknown.camera.params[0], 3600);
  EXPECT_DOUBLE_EQ(unknown.camera.params[2], 500);
}

TEST(InitialIntrinsics, ImpossibleValuesArePassedOver) {
  const Tags tags = {{"Exif.Photo.FocalLengthIn35mmFilm", "65535"},
                     {"Exif.Photo.FocalLength", "0/0"},
                     {"Exif.Photo.FocalPlaneXResolution", "1/0"},
                     {"Xmp.drone-dji.CalibratedFocalLength", "10.26"}};  // millimetres
  EXPECT_EQ(InitialIntrinsics(tags, 4000, 3000).source, "default");
}

TEST(SensorWidth, TakesTheMostSpecificModel) {
  EXPECT_DOUBLE_EQ(SensorWidth_mm("FC6310R").value(), 13.2);
  EXPECT_DOUBLE_EQ(SensorWidth_mm("Canon PowerShot S110").value(), 7.44);
  EXPECT_DOUBLE_EQ(SensorWidth_mm("Canon PowerShot SX260 HS").value(), 6.17);
  EXPECT_DOUBLE_EQ(SensorWidth_mm("NIKON D750").value(), 35.9);
  EXPECT_DOUBLE_EQ(SensorWidth_mm("NIKON D7100").value(), 23.5);
  EXPECT_EQ(SensorWidth_mm("Vogtlaender 1840"), std::nullopt);
  EXPECT_EQ(SensorWidth_mm(""), std::nullopt);
}

}  // namespace
}  // namespace stucco
