// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/position.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace stucco {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

Tags ExifPosition() {
  return {
      {"Exif.GPSInfo.GPSLatitudeRef", "N"},  {"Exif.GPSInfo.GPSLatitude", "45/1 1/1 537444/10000"},
      {"Exif.GPSInfo.GPSLongitudeRef", "E"}, {"Exif.GPSInfo.GPSLongitude", "7/1 37/1 136771/10000"},
      {"Exif.GPSInfo.GPSAltitudeRef", "0"},  {"Exif.GPSInfo.GPSAltitude", "349583/1000"}};
}

constexpr double kLatitude = 45 + 1 / 60.0 + 53.7444 / 3600;
constexpr double kLongitude = 7 + 37 / 60.0 + 13.6771 / 3600;

TEST(ReadPosition, ReadsExif) {
  const PositionReading reading = ReadPosition(ExifPosition());
  ASSERT_TRUE(reading.position);
  EXPECT_NEAR(reading.position->latitude_deg, kLatitude, 1e-12);
  EXPECT_NEAR(reading.position->longitude_deg, kLongitude, 1e-12);
  EXPECT_DOUBLE_EQ(reading.position->height_m, 349.583);
  EXPECT_TRUE(reading.position->has_height);
  EXPECT_FALSE(reading.position->rtk_fixed);
  EXPECT_THAT(reading.doubts, IsEmpty());
}

TEST(ReadPosition, SouthAndWestAreNegative) {
  Tags tags = ExifPosition();
  tags["Exif.GPSInfo.GPSLatitudeRef"] = "S";
  tags["Exif.GPSInfo.GPSLongitudeRef"] = "W";
  const auto position = ReadPosition(tags).position;
  ASSERT_TRUE(position);
  EXPECT_NEAR(position->latitude_deg, -kLatitude, 1e-12);
  EXPECT_NEAR(position->longitude_deg, -kLongitude, 1e-12);
}

TEST(ReadPosition, ReadsDegreesAndDecimalMinutes) {
  Tags tags = ExifPosition();
  tags["Exif.GPSInfo.GPSLatitude"] = "45/1 1895740/1000000";
  EXPECT_NEAR(ReadPosition(tags).position->latitude_deg, 45 + 1.89574 / 60, 1e-12);
}

TEST(ReadPosition, TakesTheFinerOfTwoThatAgree) {
  Tags tags = ExifPosition();
  tags["Xmp.drone-dji.GpsLatitude"] = "45.031595670";
  tags["Xmp.drone-dji.GpsLongtitude"] = "7.620465860";  // the early firmware's spelling
  EXPECT_DOUBLE_EQ(ReadPosition(tags).position->latitude_deg, 45.031595670);
  EXPECT_DOUBLE_EQ(ReadPosition(tags).position->longitude_deg, 7.620465860);
  tags["Xmp.drone-dji.GpsLatitude"] = "45.0316";
  tags["Xmp.drone-dji.GpsLongtitude"] = "7.6205";
  EXPECT_NEAR(ReadPosition(tags).position->latitude_deg, kLatitude, 1e-12);
}

TEST(ReadPosition, ExifWinsWhenTheyDisagree) {
  Tags tags = ExifPosition();
  tags["Xmp.drone-dji.GpsLatitude"] = "45.931595670";
  tags["Xmp.drone-dji.GpsLongitude"] = "7.620465860";
  const PositionReading reading = ReadPosition(tags);
  EXPECT_NEAR(reading.position->latitude_deg, kLatitude, 1e-12);
  EXPECT_THAT(reading.doubts, Contains(HasSubstr("apart")));
}

TEST(ReadPosition, SignedXmpWinsWhenTheHemisphereIsMissing) {
  Tags tags = ExifPosition();
  tags.erase("Exif.GPSInfo.GPSLatitudeRef");
  EXPECT_GT(ReadPosition(tags).position->latitude_deg, 0);
  EXPECT_THAT(ReadPosition(tags).doubts, Contains(HasSubstr("GPSLatitudeRef is missing")));
  tags["Xmp.drone-dji.GpsLatitude"] = "-45.0315957";
  tags["Xmp.drone-dji.GpsLongitude"] = "7.6204659";
  EXPECT_LT(ReadPosition(tags).position->latitude_deg, 0);
}

TEST(ReadPosition, ZeroPositionIsQuarantined) {
  Tags tags = ExifPosition();
  tags["Exif.GPSInfo.GPSLatitude"] = "0/1 0/1 0/1";
  tags["Exif.GPSInfo.GPSLongitude"] = "0/1 0/1 0/1";
  const PositionReading reading = ReadPosition(tags);
  EXPECT_FALSE(reading.position);
  EXPECT_THAT(reading.doubts, Contains(HasSubstr("placeholder")));
}

TEST(ReadPosition, BadFractionsCostOnlyThemselves) {
  Tags tags = ExifPosition();
  tags["Exif.GPSInfo.GPSLatitude"] = "0/0 0/0 0/0";
  EXPECT_FALSE(ReadPosition(tags).position);
  EXPECT_THAT(ReadPosition(tags).doubts, Contains(HasSubstr("malformed")));
  tags = ExifPosition();
  tags["Exif.GPSInfo.GPSAltitude"] = "5/0";
  ASSERT_TRUE(ReadPosition(tags).position);
  EXPECT_FALSE(ReadPosition(tags).position->has_height);
}

TEST(ReadPosition, OffEarthIsQuarantined) {
  Tags tags = ExifPosition();
  tags["Exif.GPSInfo.GPSLatitude"] = "145/1 0/1 0/1";
  EXPECT_FALSE(ReadPosition(tags).position);
}

TEST(ReadPosition, HeightOfExactlyZeroIsQuarantined) {
  Tags tags = ExifPosition();
  tags["Exif.GPSInfo.GPSAltitude"] = "0/1";
  const PositionReading reading = ReadPosition(tags);
  ASSERT_TRUE(reading.position);
  EXPECT_FALSE(reading.position->has_height);
  EXPECT_THAT(reading.doubts, Contains(HasSubstr("exactly 0")));
  tags["Xmp.drone-dji.AbsoluteAltitude"] = "+349.58";
  EXPECT_DOUBLE_EQ(ReadPosition(tags).position->height_m, 349.58);
}

TEST(ReadPosition, BelowSeaLevelAndItsWrongForms) {
  Tags tags = ExifPosition();
  tags["Exif.GPSInfo.GPSAltitude"] = "120/10";
  tags["Exif.GPSInfo.GPSAltitudeRef"] = "1";
  EXPECT_DOUBLE_EQ(ReadPosition(tags).position->height_m, -12);
  tags["Exif.GPSInfo.GPSAltitudeRef"] = "49";  // the character '1'
  EXPECT_DOUBLE_EQ(ReadPosition(tags).position->height_m, -12);
  tags["Xmp.drone-dji.AbsoluteAltitude"] = "+12.00";  // XMP has the sign right
  EXPECT_DOUBLE_EQ(ReadPosition(tags).position->height_m, 12);
}

TEST(ReadPosition, RtkFixHasItsDeviations) {
  Tags tags = ExifPosition();
  tags["Xmp.drone-dji.RtkFlag"] = "50";
  tags["Xmp.drone-dji.RtkStdLat"] = "0.014";
  tags["Xmp.drone-dji.RtkStdLon"] = "0.014";
  tags["Xmp.drone-dji.RtkStdHgt"] = "0.025";
  auto position = ReadPosition(tags).position;
  EXPECT_TRUE(position->rtk_fixed);
  EXPECT_NEAR(position->sigma_horizontal_m, 0.014, 1e-12);
  EXPECT_DOUBLE_EQ(position->sigma_vertical_m, 0.025);
  tags["Xmp.drone-dji.RtkStdLat"] = "0";  // a bad value falls back to what a fix usually has
  position = ReadPosition(tags).position;
  EXPECT_TRUE(position->rtk_fixed);
  EXPECT_DOUBLE_EQ(position->sigma_horizontal_m, 0.02);
}

TEST(ReadPosition, AnyFloatSolutionHasItsDeviations) {
  Tags tags = ExifPosition();
  for (const auto& [flag, sigma_m] :
       std::map<std::string, double>{{"31", GeoPosition().sigma_horizontal_m},
                                     {"32", 0.5},
                                     {"34", 0.5},
                                     {"49", 0.5},
                                     {"51", GeoPosition().sigma_horizontal_m}}) {
    tags["Xmp.drone-dji.RtkFlag"] = flag;
    const auto position = ReadPosition(tags).position;
    EXPECT_FALSE(position->rtk_fixed) << flag;
    EXPECT_DOUBLE_EQ(position->sigma_horizontal_m, sigma_m) << flag;
  }
  tags["Xmp.drone-dji.RtkFlag"] = "48";
  tags["Xmp.drone-dji.RtkStdHgt"] = "0.3";
  EXPECT_DOUBLE_EQ(ReadPosition(tags).position->sigma_vertical_m, 0.3);
}

TEST(ReadPosition, WithoutFixTheDeviationsOfTheLastAreNotBelieved) {
  Tags tags = ExifPosition();
  tags["Xmp.drone-dji.RtkFlag"] = "16";
  tags["Xmp.drone-dji.RtkStdLat"] = "0.014";
  tags["Xmp.drone-dji.RtkStdLon"] = "0.012";
  const auto position = ReadPosition(tags).position;
  EXPECT_FALSE(position->rtk_fixed);
  EXPECT_DOUBLE_EQ(position->sigma_horizontal_m, GeoPosition().sigma_horizontal_m);
}

TEST(ReadPosition, ParrotStatesItsAccuracy) {
  Tags tags = ExifPosition();
  tags["Xmp.Camera.GPSXYAccuracy"] = "2.138";
  tags["Xmp.Camera.GPSZAccuracy"] = "3.362";
  const auto position = ReadPosition(tags).position;
  EXPECT_DOUBLE_EQ(position->sigma_horizontal_m, 2.138);
  EXPECT_DOUBLE_EQ(position->sigma_vertical_m, 3.362);
}

TEST(ReadPosition, NothingFromNothing) {
  EXPECT_FALSE(ReadPosition({}).position);
  EXPECT_THAT(ReadPosition({}).doubts, IsEmpty());
}

}  // namespace
}  // namespace stucco
