// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/localise/localise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"

namespace stucco {
namespace {

// Whole runs are in tests/pipeline/verbs/retexture_test.cpp.

TEST(LocalisePhotos, SaysWhatIsNeededWhenThePhotosOfTheModelAreGone) {
  FinishedModel model;
  model.photos = "/not/there";
  model.captures.cameras.resize(1);
  CapturedPhoto& photo = model.captures.photos.emplace_back();
  photo.path = "a.jpg";
  photo.usable = true;
  photo.camera = 0;
  model.reconstruction.cameras[CameraId{1}] = {
      CameraId{1}, CameraModel::kSimplePinhole, 100, 100, {80, 50, 50}};
  model.reconstruction.photos[PhotoId{1}] = {PhotoId{1}, CameraId{1}, "a.jpg", {}, {}};
  StageContext context;
  context.progress = &SilentProgress();
  context.units = &NoUnits();
  try {
    LocalisePhotos({}, model, model.captures, context);
    FAIL() << "was not refused";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(e.what(), testing::HasSubstr("/not/there"));
    EXPECT_THAT(e.remedy(), testing::HasSubstr(".stucco/units/calib"));
  }
}

}  // namespace
}  // namespace stucco
