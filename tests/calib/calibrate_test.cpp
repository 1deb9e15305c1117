// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/calibrate.h"

#include <gtest/gtest.h>

#include "survey/captures.h"
#include "survey/files.h"
#include "survey/image.h"
#include "survey/survey_folder.h"
#include "tests/calib/made_scene.h"
#include "tests/survey/support.h"

namespace stucco::test {
namespace {

// A survey folder whose photos are noise: nothing in one is in another.
class Calibrate : public testing::Test {
 protected:
  Calibrate() {
    context_.survey = folder_ / "survey";
    context_.photos = folder_ / "photos";
    context_.out = folder_ / "out";
    for (const auto& path : {context_.survey / "ingest", context_.photos, context_.out}) {
      std::filesystem::create_directories(path);
    }
    context_.progress = &SilentProgress();
    context_.units = &NoUnits();
    captures_.cameras.push_back({"key",
                                 "Noise",
                                 {CameraId{1}, CameraModel::kPinhole, 160, 120, {150, 150, 80, 60}},
                                 "option"});
  }

  void AddPhoto(uint32_t seed, bool usable) {
    Random random(seed);
    Image image{160, 120, 3, std::vector<uint8_t>(160 * 120 * 3)};
    for (uint8_t& value : image.data) value = static_cast<uint8_t>(random.Uniform(0, 256));
    CapturedPhoto photo;
    photo.path = std::to_string(seed) + ".jpg";
    WriteImage(image, context_.photos / photo.path);
    photo.hash = HashFile(context_.photos / photo.path);
    photo.usable = usable;
    photo.why = usable ? "" : "too dark";
    photo.width_px = 160;
    photo.height_px = 120;
    photo.camera = usable ? 0 : -1;
    captures_.photos.push_back(photo);
  }

  Error Failure() {
    WriteCaptures(captures_, context_.survey / kCapturesFile);
    return ErrorOf([&] { RunCalib({}, context_); });
  }

  TemporaryFolder folder_;
  StageContext context_;
  Captures captures_;
};

TEST_F(Calibrate, NeedsTwoUsablePhotos) {
  AddPhoto(1, true);
  AddPhoto(2, false);
  const Error error = Failure();
  EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
  EXPECT_NE(std::string(error.what()).find("1 usable photo"), std::string::npos) << error.what();
  EXPECT_FALSE(error.remedy().empty());
}

TEST_F(Calibrate, SaysWhenPhotosDoNotOverlap) {
  for (uint32_t seed = 1; seed <= 3; ++seed) AddPhoto(seed, true);
  const Error error = Failure();
  EXPECT_EQ(error.kind(), ErrorKind::kStageFailed);
  EXPECT_NE(std::string(error.what()).find("no two photos overlap"), std::string::npos)
      << error.what();
  EXPECT_FALSE(error.remedy().empty());
}

TEST_F(Calibrate, NamesAPhotoThatIsGone) {
  for (uint32_t seed = 1; seed <= 2; ++seed) AddPhoto(seed, true);
  std::filesystem::remove(context_.photos / "2.jpg");
  const Error error = Failure();
  EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
  EXPECT_NE(std::string(error.what()).find("2.jpg"), std::string::npos) << error.what();
}

TEST(CalibOptions, AreAllInTheTable) {
  CalibOptions options;
  OptionTable table("calib");
  Describe(table, options);
  EXPECT_EQ(table.options().size(), 14u);
  EXPECT_EQ(SetOption(table, "max_features", OptionValue(int64_t{500})), "");
  EXPECT_EQ(options.max_features, 500);
  EXPECT_NE(SetOption(table, "camera_model", OptionValue(std::string("FISHEYE"))), "");
  EXPECT_NE(SetOption(table, "match_ratio", OptionValue(1.5)), "");
  EXPECT_EQ(SetOption(table, "georef", OptionValue(std::string("map"))), "");
  EXPECT_EQ(options.georef, "map");
  EXPECT_NE(SetOption(table, "georef", OptionValue(std::string("gps"))), "");
}

}  // namespace
}  // namespace stucco::test
