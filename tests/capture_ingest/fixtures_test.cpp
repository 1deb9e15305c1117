// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Photos of real cameras, with what exiftool reads from them. They are not part of the repository:
// they are looked for in the folder that STUCCO_DATA names, else in ../shared/data beside it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "capture_ingest/camera_groups.h"
#include "capture_ingest/photo_record.h"

namespace stucco {
namespace {

std::filesystem::path DataFolder() {
  if (const char* named = std::getenv("STUCCO_DATA")) return named;
  return std::filesystem::path(STUCCO_ROOT) / "../shared/data";
}

const std::filesystem::path kData = DataFolder();

PhotoRecord Inspect(const std::string& folder, const std::string& name) {
  StageContext context;
  context.photos = kData / folder;
  context.progress = &SilentProgress();
  context.units = &NoUnits();
  return InspectPhoto({name, name, ""}, 200, context);
}

class RealPhotos : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"ingest_fixtures", "mirafiori/images"}) {
      if (!std::filesystem::is_directory(kData / folder)) {
        GTEST_SKIP() << kData / folder << " is not here";
      }
    }
  }

  static CapturedCamera CameraOf(const PhotoRecord& record) {
    std::vector<PhotoRecord> records = {record};
    return GroupCameras(records).at(0);
  }
};

TEST_F(RealPhotos, CanonWithGps) {
  const PhotoRecord record = Inspect("ingest_fixtures", "Canon_SX260HS_gps.jpg");
  ASSERT_TRUE(record.photo.usable) << record.photo.why;
  ASSERT_TRUE(record.photo.position);
  EXPECT_NEAR(record.photo.position->latitude_deg, 30 + 10 / 60.0 + 17.71 / 3600, 1e-5);
  EXPECT_NEAR(record.photo.position->longitude_deg, -(98 + 5 / 60.0 + 24.45 / 3600), 1e-5);
  EXPECT_NEAR(record.photo.position->height_m, 421.3, 0.05);
  EXPECT_FALSE(record.photo.gimbal);
  const CapturedCamera camera = CameraOf(record);
  EXPECT_EQ(camera.focal_source, "exif_sensor");
  EXPECT_NEAR(camera.intrinsics.FocalX(), 4.5 * 16393.44262 / 25.4, 1);
}

TEST_F(RealPhotos, DjiMavic2EnterpriseDual) {
  const PhotoRecord record = Inspect("ingest_fixtures", "DJI_FC2403_M2EDual_RGB.JPG");
  ASSERT_TRUE(record.photo.usable) << record.photo.why;
  EXPECT_NEAR(record.photo.position->latitude_deg, -(36 + 54 / 60.0 + 40.30 / 3600), 1e-5);
  EXPECT_NEAR(record.photo.position->longitude_deg, 174 + 53 / 60.0 + 16.51 / 3600, 1e-5);
  EXPECT_NEAR(record.photo.gimbal->yaw_deg, -139.6, 1e-9);
  EXPECT_EQ(CameraOf(record).focal_source, "exif_35mm");
}

TEST_F(RealPhotos, DjiThermalTwin) {
  const PhotoRecord record = Inspect("ingest_fixtures", "DJI_FC2403_M2EDual_thermal_pitch0.JPG");
  ASSERT_TRUE(record.photo.usable) << record.photo.why;
  EXPECT_NEAR(record.photo.position->height_m, 36.56, 0.01);
  EXPECT_NEAR(record.photo.gimbal->yaw_deg, 113.2, 1e-9);
  EXPECT_DOUBLE_EQ(record.photo.gimbal->pitch_deg, 0);
}

TEST_F(RealPhotos, ParrotSequoia) {
  const PhotoRecord record = Inspect("ingest_fixtures", "ParrotSequoia_RGB_negYaw.JPG");
  ASSERT_TRUE(record.photo.usable) << record.photo.why;
  EXPECT_NEAR(record.photo.gimbal->yaw_deg, -13.305, 1e-9);
  EXPECT_NEAR(record.photo.gimbal->pitch_deg, 5.18259 - 90, 1e-9);
  EXPECT_NEAR(record.photo.position->sigma_horizontal_m, 2.138, 1e-9);
  EXPECT_NEAR(record.photo.position->height_m, 349.1, 0.1);  // exiftool cuts the digits off
}

TEST_F(RealPhotos, PhoneWithoutMake) {
  const PhotoRecord record = Inspect("ingest_fixtures", "phone_gps_noMake.jpg");
  ASSERT_TRUE(record.photo.usable) << record.photo.why;
  EXPECT_NEAR(record.photo.position->latitude_deg, 52 + 31 / 60.0 + 8.10 / 3600, 1e-5);
  EXPECT_EQ(CameraOf(record).focal_source, "exif_35mm");
}

TEST_F(RealPhotos, DjiWithRtkAndDewarpData) {
  const PhotoRecord record = Inspect("mirafiori/images", "DJI_0010.JPG");
  ASSERT_TRUE(record.photo.usable) << record.photo.why;
  EXPECT_TRUE(record.photo.position->rtk_fixed);
  EXPECT_NEAR(record.photo.position->latitude_deg, 45.03159568, 1e-12);
  EXPECT_NEAR(record.photo.position->height_m, 349.583, 1e-9);
  EXPECT_NEAR(record.photo.position->sigma_vertical_m, 0.0205, 1e-9);
  const CapturedCamera camera = CameraOf(record);
  EXPECT_EQ(camera.focal_source, "dewarp");
  EXPECT_NEAR(camera.intrinsics.FocalX(), 1973.09, 0.01);
  EXPECT_EQ(camera.label, "DJI FC6360, 1600 x 1300, 5.7 mm");
}

}  // namespace
}  // namespace stucco
