// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "capture_ingest/focal.h"
#include "capture_ingest/gimbal.h"
#include "capture_ingest/photo_record.h"
#include "capture_ingest/position.h"
#include "simulate/flight/metadata.h"
#include "tests/capture_ingest/photo_maker.h"

// What the virtual drone writes must be read back as if a drone had written it.
namespace stucco {
namespace {

simulate::PhotoMetadata Metadata() {
  simulate::PhotoMetadata m;
  m.model = "M3E";
  m.exif_time = "2026:04:30 10:00:12";
  m.milliseconds = 250;
  m.latitude_deg = 50.087512345;
  m.longitude_deg = -14.421399999;
  m.height_m = 231.456;
  m.above_takeoff_m = 12.34;
  m.gimbal = {-72.46, -20.04, 0};
  m.shutter = {1.0 / 1250, 200};
  m.focal_mm = 12.29;
  m.focal_35mm_mm = 25;
  m.width_px = 320;
  m.height_px = 240;
  m.uuid = "0123456789abcdef0123456789abcdef";
  return m;
}

TEST(SimulatedPhoto, IngestReadsPositionGimbalTimeAndFocalLength) {
  const PhotoTags read = ReadTags(simulate::WithMetadata(MakeJpeg(1), Metadata()));
  EXPECT_EQ(read.problem, "");
  const PositionReading reading = ReadPosition(read.tags);
  EXPECT_THAT(reading.doubts, ::testing::IsEmpty());
  ASSERT_TRUE(reading.position.has_value());
  EXPECT_NEAR(reading.position->latitude_deg, 50.087512345, 1e-9);
  EXPECT_NEAR(reading.position->longitude_deg, -14.421399999, 1e-9);
  EXPECT_NEAR(reading.position->height_m, 231.456, 1e-9);
  EXPECT_FALSE(reading.position->rtk_fixed);
  EXPECT_NEAR(reading.height_above_takeoff_m.value(), 12.34, 1e-9);
  const GimbalReading gimbal = ReadGimbal(read.tags);
  ASSERT_TRUE(gimbal.angles.has_value());
  EXPECT_NEAR(gimbal.angles->yaw_deg, -72.5, 1e-9);  // to a tenth of a degree
  EXPECT_NEAR(gimbal.angles->pitch_deg, -20.0, 1e-9);
  EXPECT_EQ(Text(read.tags, "Exif.Photo.DateTimeOriginal"), "2026:04:30 10:00:12");
  EXPECT_EQ(Text(read.tags, "Exif.Photo.SubSecTimeOriginal"), "250");
  EXPECT_EQ(Text(read.tags, "Exif.Image.Make"), "DJI");
  EXPECT_EQ(Number(read.tags, "Exif.Photo.ISOSpeedRatings"), 200);
  const InitialCamera camera = InitialIntrinsics(read.tags, 320, 240);
  EXPECT_EQ(camera.source, "exif_35mm");
  EXPECT_NEAR(camera.camera.FocalX(), 25 / 43.2666 * 400, 0.1);
}

TEST(SimulatedPhoto, IngestReadsRtk) {
  simulate::PhotoMetadata m = Metadata();
  m.rtk = true;
  m.rtk_sigma_m = {0.011, 0.012, 0.02};
  m.height_m = -3.25;
  const PhotoTags read = ReadTags(simulate::WithMetadata(MakeJpeg(1), m));
  const PositionReading reading = ReadPosition(read.tags);
  ASSERT_TRUE(reading.position.has_value());
  EXPECT_TRUE(reading.position->rtk_fixed);
  EXPECT_NEAR(reading.position->sigma_vertical_m, 0.02, 1e-9);
  EXPECT_NEAR(reading.position->height_m, -3.25, 1e-9);
}

TEST(SimulatedPhoto, SouthAndSixtySecondsAreWrittenRight) {
  simulate::PhotoMetadata m = Metadata();
  m.latitude_deg = -(33 + 59 / 60.0 + 59.99999 / 3600);
  const PhotoTags read = ReadTags(simulate::WithMetadata(MakeJpeg(1), m));
  EXPECT_EQ(Text(read.tags, "Exif.GPSInfo.GPSLatitudeRef"), "S");
  EXPECT_EQ(Text(read.tags, "Exif.GPSInfo.GPSLatitude"), "34/1 0/1 0/10000");
}

TEST(SimulatedPhoto, AnyNameOfACameraIsReadBack) {
  simulate::PhotoMetadata m = Metadata();
  m.model = "R&D \"wide\"";
  const std::string jpeg = simulate::WithMetadata(MakeJpeg(1), m);
  EXPECT_THAT(jpeg, ::testing::HasSubstr("tiff:Model=\"R&amp;D &quot;wide&quot;\""));
  const PhotoTags read = ReadTags(jpeg);
  EXPECT_EQ(read.problem, "");
  EXPECT_EQ(Text(read.tags, "Exif.Image.Model"), m.model);
  EXPECT_TRUE(ReadGimbal(read.tags).angles.has_value());
}

TEST(SimulatedPhoto, PictureIsUntouchedAndBytesAreTheSame) {
  const std::string jpeg = MakeJpeg(3);
  const std::string once = simulate::WithMetadata(jpeg, Metadata());
  EXPECT_EQ(once, simulate::WithMetadata(jpeg, Metadata()));
  EXPECT_NE(once.find(jpeg.substr(jpeg.size() - 2000)), std::string::npos);
}

// The tool that people check photos with.
TEST(SimulatedPhoto, ExiftoolReadsIt) {
  if (std::system("exiftool -ver > /dev/null 2>&1") != 0) GTEST_SKIP() << "no exiftool here";
  const TempFolder folder;
  folder.Write("photo.JPG", simulate::WithMetadata(MakeJpeg(1), Metadata()));
  const std::string command = fmt::format(
      "exiftool -n -s3 -p '$Model|$DateTimeOriginal|$XMP-drone-dji:GimbalYawDegree|"
      "$EXIF:GPSLatitude|$EXIF:GPSLongitudeRef|$EXIF:GPSAltitude|$FocalLength|"
      "$XMP-drone-dji:GPSLatitude|$XMP-drone-dji:AbsoluteAltitude|$Warning' -m '{}' 2>&1",
      (folder.path() / "photo.JPG").string());
  std::string output;
  FILE* pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::array<char, 512> line{};
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) output += line.data();
  EXPECT_EQ(pclose(pipe), 0) << output;
  EXPECT_EQ(
      output.substr(0, output.find('\n')),
      "M3E|2026:04:30 10:00:12|-72.50|50.0875123333333|W|231.456|12.29|+50.087512345|+231.456|")
      << output;
}

}  // namespace
}  // namespace stucco
