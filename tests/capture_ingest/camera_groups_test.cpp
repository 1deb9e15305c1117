// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/camera_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "survey/error.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

PhotoRecord Record(Tags tags, int width_px = 4000, int height_px = 3000) {
  PhotoRecord record;
  record.tags = std::move(tags);
  record.photo.usable = true;
  record.photo.width_px = width_px;
  record.photo.height_px = height_px;
  return record;
}

const Tags kDji = {{"Exif.Image.Make", "DJI"},
                   {"Exif.Image.Model", "FC6310R"},
                   {"Exif.Photo.FocalLength", "880/100"}};

Tags With(Tags tags, const std::string& key, const std::string& value) {
  tags[key] = value;
  return tags;
}

TEST(GroupCameras, EqualMetadataShareACamera) {
  std::vector<PhotoRecord> records = {Record(kDji), Record(kDji), Record({}), Record({})};
  const auto cameras = GroupCameras(records);
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(records[1].photo.camera, 0);
  EXPECT_EQ(records[3].photo.camera, 1);
  EXPECT_EQ(cameras[0].intrinsics.id, CameraId{1});
  EXPECT_EQ(cameras[1].intrinsics.id, CameraId{2});
  EXPECT_EQ(cameras[0].label, "DJI FC6310R, 4000 x 3000, 8.8 mm");
  EXPECT_EQ(cameras[1].label, "unknown camera, 4000 x 3000");
}

TEST(GroupCameras, WhateverTellsBodiesApartSeparatesThem) {
  const std::pair<const char*, const char*> differences[] = {
      {"Exif.Photo.BodySerialNumber", "B"},
      {"Exif.Photo.LensModel", "other"},
      {"Exif.Photo.FocalLength", "240/10"},
      {"Exif.Photo.DigitalZoomRatio", "2/1"},
      {"Exif.Image.Model", "FC220"},
      {"Xmp.Camera.BandName", "NIR"},
      {"Xmp.drone-dji.DewarpData", "2022;3700,3700,1,1,0,0,0,0,0"}};
  for (const auto& [key, value] : differences) {
    std::vector<PhotoRecord> records = {Record(kDji), Record(With(kDji, key, value))};
    EXPECT_EQ(GroupCameras(records).size(), 2U) << key;
  }
  std::vector<PhotoRecord> turned = {Record(kDji), Record(kDji, 3000, 4000)};
  EXPECT_EQ(GroupCameras(turned).size(), 2U);
}

TEST(GroupCameras, UnusablePhotosHaveNoCamera) {
  std::vector<PhotoRecord> records = {Record(kDji), Record({})};
  records[1].photo.usable = false;
  EXPECT_EQ(GroupCameras(records).size(), 1U);
  EXPECT_EQ(records[1].photo.camera, -1);
}

TEST(CameraLabel, DoesNotSayTheMakeTwice) {
  EXPECT_EQ(CameraLabel(Record({{"Exif.Image.Make", "EASTMAN KODAK COMPANY"},
                                {"Exif.Image.Model", "KODAK Z612 ZOOM DIGITAL CAMERA"}})),
            "KODAK Z612 ZOOM DIGITAL CAMERA, 4000 x 3000");
  EXPECT_EQ(CameraLabel(Record({{"Exif.Image.Make", "Canon"}, {"Exif.Image.Model", "Canon EOS"}})),
            "Canon EOS, 4000 x 3000");
  EXPECT_EQ(
      CameraLabel(Record({{"Exif.Image.Model", "FC220"}, {"Xmp.drone-dji.GimbalYawDegree", "1"}})),
      "DJI FC220, 4000 x 3000");
}

TEST(CameraLabel, ForeignBytesAreLeftOut) {
  EXPECT_EQ(CameraLabel(Record({{"Exif.Image.Model", "\xff\xfe"}})), "unknown camera, 4000 x 3000");
}

TEST(ApplyPriorCamera, SetsWhatFits) {
  std::vector<PhotoRecord> records = {Record(kDji), Record({}, 640, 480)};
  auto cameras = GroupCameras(records);
  const double prior[] = {3500, 3501, 2010, 1490, -0.1, 0.05, 0.001, -0.002};
  EXPECT_THAT(ApplyPriorCamera(prior, true, cameras), ElementsAre(HasSubstr("640")));
  EXPECT_THAT(cameras[0].intrinsics.params,
              ElementsAre(3500, 3501, 2010, 1490, -0.1, 0.05, 0.001, -0.002));
  EXPECT_EQ(cameras[0].focal_source, "option");
  EXPECT_TRUE(cameras[0].fixed);
  EXPECT_FALSE(cameras[1].fixed);
}

TEST(ApplyPriorCamera, FourValuesMeanNoDistortion) {
  std::vector<PhotoRecord> records = {
      Record(With(kDji, "Xmp.drone-dji.DewarpData", "2022;3700,3700,1,1,-0.2,0,0,0,0"))};
  auto cameras = GroupCameras(records);
  ASSERT_NE(cameras[0].intrinsics.params[4], 0);
  const double prior[] = {3500, 3501, 2010, 1490};
  EXPECT_THAT(ApplyPriorCamera(prior, false, cameras), IsEmpty());
  EXPECT_THAT(cameras[0].intrinsics.params, ElementsAre(3500, 3501, 2010, 1490, 0, 0, 0, 0));
  EXPECT_FALSE(cameras[0].fixed);
}

TEST(ApplyPriorCamera, RefusesWhatIsNoCamera) {
  std::vector<PhotoRecord> records = {Record(kDji)};
  auto cameras = GroupCameras(records);
  const std::vector<double> wrong[] = {{3500},
                                       {3500, 3500, 2000},
                                       {0, 3500, 2000, 1500},
                                       {-1, 3500, 2000, 1500},
                                       {NAN, 3500, 2000, 1500},
                                       {1, 2, 3, 4, 5},
                                       {900, 900, 320, 240}};  // of a smaller picture
  for (const auto& prior : wrong) {
    try {
      ApplyPriorCamera(prior, false, cameras);
      ADD_FAILURE() << prior.size();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
      EXPECT_THAT(error.what(), HasSubstr("ingest.prior_camera"));
    }
  }
  EXPECT_THAT(ApplyPriorCamera({}, true, cameras), IsEmpty());
}

}  // namespace
}  // namespace stucco
