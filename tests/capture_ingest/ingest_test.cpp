// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/ingest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <opencv2/imgcodecs.hpp>

#include "survey/captures.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/image.h"
#include "tests/capture_ingest/photo_maker.h"

namespace stucco {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Collector : public Progress {
 public:
  void Begin(std::string_view, size_t) override {}
  void Advance(size_t) override {}
  void Warn(std::string_view text) override { warnings += std::string(text) + "\n"; }
  void Note(std::string_view text) override { notes += std::string(text) + "\n"; }
  bool Cancelled() const override { return cancelled; }

  std::string warnings;
  std::string notes;
  bool cancelled = false;
};

class MemoryUnits : public UnitStore {
 public:
  std::optional<std::string> Load(std::string_view, std::string_view key) override {
    const std::lock_guard lock(mutex_);
    const auto found = units.find(std::string(key));
    return found == units.end() ? std::nullopt : std::optional(found->second);
  }
  void Save(std::string_view, std::string_view key, std::string_view bytes) override {
    const std::lock_guard lock(mutex_);
    units[std::string(key)] = bytes;
    ++saved;
  }

  std::map<std::string, std::string> units;
  int saved = 0;

 private:
  std::mutex mutex_;
};

class Ingest : public testing::Test {
 protected:
  Captures Run(const IngestOptions& options = {}, int threads = 2) {
    const std::filesystem::path out = work_.path() / "out";
    std::filesystem::create_directories(out);
    StageContext context;
    context.survey = work_.path();
    context.photos = photos_.path();
    context.out = out;
    context.threads = threads;
    context.progress = &progress_;
    context.units = &units_;
    RunIngest(options, context);
    return ReadCaptures(out / "captures.json");
  }

  Error Failure(const IngestOptions& options = {}) {
    try {
      Run(options);
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "no error";
    return Error(ErrorKind::kStageFailed, "no error");
  }

  std::string Output(const char* name) { return ReadFile(work_.path() / "out" / name); }

  const CapturedPhoto& Photo(const Captures& captures, const std::string& path) {
    for (const CapturedPhoto& photo : captures.photos) {
      if (photo.path == path) return photo;
    }
    throw std::runtime_error("no photo " + path);
  }

  TempFolder photos_;
  TempFolder work_;
  Collector progress_;
  MemoryUnits units_;
};

TEST_F(Ingest, ReadsADjiFlight) {
  for (int i = 0; i < 3; ++i) {
    photos_.Write("DJI_000" + std::to_string(i) + ".JPG", MakeDjiPhoto(i, 45 + i * 1e-4, 7, 350));
  }
  const Captures captures = Run();
  ASSERT_EQ(captures.photos.size(), 3U);
  ASSERT_EQ(captures.cameras.size(), 1U);
  EXPECT_EQ(captures.cameras[0].label, "DJI FC6310R, 320 x 240, 8.8 mm");
  EXPECT_EQ(captures.cameras[0].focal_source, "exif_35mm");
  const CapturedPhoto& photo = captures.photos[1];
  EXPECT_EQ(photo.path, "DJI_0001.JPG");
  EXPECT_TRUE(photo.usable);
  EXPECT_EQ(photo.why, "");
  EXPECT_EQ(photo.width_px, 320);
  EXPECT_EQ(photo.height_px, 240);
  EXPECT_EQ(photo.capture_time, "2025:03:01 12:00:00");
  EXPECT_EQ(photo.hash, HashFile(photos_.path() / photo.path));
  EXPECT_GT(photo.sharpness, 0);
  ASSERT_TRUE(photo.position);
  EXPECT_NEAR(photo.position->latitude_deg, 45.0001, 1e-7);
  EXPECT_NEAR(photo.position->height_m, 350, 0.01);
  ASSERT_TRUE(photo.gimbal);
  EXPECT_DOUBLE_EQ(photo.gimbal->yaw_deg, 30.1);
  EXPECT_THAT(progress_.notes, HasSubstr("3 of 3 photos"));
  EXPECT_THAT(progress_.warnings, IsEmpty());
}

TEST_F(Ingest, ReadsExposures) {
  std::map<std::string, std::string> exif = {{"Exif.Photo.ExposureTime", "1/800"},
                                             {"Exif.Photo.ISOSpeedRatings", "400"},
                                             {"Exif.Photo.FNumber", "4/1"}};
  photos_.Write("a.jpg", WithMetadata(MakeJpeg(1), exif));
  exif["Exif.Photo.ExposureTime"] = "1/0";
  photos_.Write("b.jpg", WithMetadata(MakeJpeg(2), exif));
  exif.erase("Exif.Photo.ExposureTime");
  photos_.Write("c.jpg", WithMetadata(MakeJpeg(3), exif));
  const Captures captures = Run();
  ASSERT_EQ(captures.photos.size(), 3U);
  EXPECT_DOUBLE_EQ(captures.photos[0].exposure_s.value_or(0), 4.0 / 800 / 16);
  EXPECT_EQ(captures.photos[1].exposure_s, std::nullopt);
  EXPECT_EQ(captures.photos[2].exposure_s, std::nullopt);
}

TEST_F(Ingest, ListsEveryBadFileWithReasonAndRemedy) {
  const std::string jpeg = MakeJpeg(1);
  photos_.Write("a.jpg", jpeg);
  photos_.Write("b.jpg", MakeJpeg(2));
  photos_.Write("empty.jpg", "");
  photos_.Write("text.jpg", "these are not the pixels you are looking for");
  std::vector<uchar> png;
  cv::imencode(".png", cv::Mat(240, 320, CV_8UC3, cv::Scalar(1, 2, 3)), png);
  photos_.Write("png.jpg", {png.begin(), png.end()});
  for (const int percent : {1, 10, 50, 90, 99}) {
    photos_.Write("cut" + std::to_string(percent) + ".jpg",
                  jpeg.substr(0, jpeg.size() * percent / 100));
  }
  photos_.Write("small.jpg", MakeJpeg(3, 120, 90));
  photos_.Write("notes.txt", "not listed");
  const Captures captures = Run();
  ASSERT_EQ(captures.photos.size(), 11U);
  for (const CapturedPhoto& photo : captures.photos) {
    const bool good = photo.path == "a.jpg" || photo.path == "b.jpg";
    EXPECT_EQ(photo.usable, good) << photo.path;
    if (good) continue;
    EXPECT_THAT(photo.why, HasSubstr(";")) << photo.path;
    EXPECT_THAT(photo.why, Not(HasSubstr(photos_.path().string()))) << photo.path;
    EXPECT_EQ(photo.camera, -1);
    EXPECT_THAT(progress_.warnings, HasSubstr(photo.path));
  }
  EXPECT_THAT(Photo(captures, "png.jpg").why, HasSubstr("PNG"));
  EXPECT_THAT(Photo(captures, "small.jpg").why, HasSubstr("min_side_px"));
}

TEST_F(Ingest, KeepsTheFirstOfTwins) {
  photos_.Write("a.jpg", MakeJpeg(1));
  photos_.Write("b.jpg", MakeJpeg(2));
  photos_.Write("z/copy of a.jpg", MakeJpeg(1));
  const Captures captures = Run();
  EXPECT_TRUE(Photo(captures, "a.jpg").usable);
  const CapturedPhoto& copy = Photo(captures, "z/copy of a.jpg");
  EXPECT_FALSE(copy.usable);
  EXPECT_EQ(copy.duplicate_of, "a.jpg");
  EXPECT_THAT(copy.why, HasSubstr("identical to a.jpg"));
}

TEST_F(Ingest, TwoCamerasMixed) {
  photos_.Write("a.jpg", MakeDjiPhoto(1, 45, 7, 300));
  photos_.Write("b.jpg", WithMetadata(MakeJpeg(2, 400, 300), {{"Exif.Image.Model", "FC220"}}));
  photos_.Write("c.jpg", MakeDjiPhoto(3, 45, 7, 300));
  const Captures captures = Run();
  ASSERT_EQ(captures.cameras.size(), 2U);
  EXPECT_EQ(captures.photos[0].camera, 0);
  EXPECT_EQ(captures.photos[1].camera, 1);
  EXPECT_EQ(captures.photos[2].camera, 0);
}

TEST_F(Ingest, PhotosWithoutMetadataAreFine) {
  photos_.Write("a.jpg", MakeJpeg(1));
  photos_.Write("b.jpg", MakeJpeg(2));
  const Captures captures = Run();
  EXPECT_EQ(captures.cameras.size(), 1U);
  EXPECT_EQ(captures.cameras[0].focal_source, "default");
  EXPECT_FALSE(captures.photos[0].position);
  EXPECT_FALSE(captures.photos[0].gimbal);
}

TEST_F(Ingest, DoubtfulValuesAreNamed) {
  photos_.Write("a.jpg", MakeDjiPhoto(1, 0, 0, 300));
  photos_.Write("b.jpg", MakeDjiPhoto(2, 45, 7, 300));
  const Captures captures = Run();
  EXPECT_TRUE(captures.photos[0].usable);
  EXPECT_FALSE(captures.photos[0].position);
  EXPECT_THAT(progress_.warnings, HasSubstr("a.jpg: EXIF position 0, 0"));
}

TEST_F(Ingest, PriorCameraIsTaken) {
  photos_.Write("a.jpg", MakeJpeg(1));
  photos_.Write("b.jpg", MakeJpeg(2));
  const Captures captures = Run({.prior_camera = {300, 301, 160, 120}, .prior_camera_fixed = true});
  EXPECT_EQ(captures.cameras[0].focal_source, "option");
  EXPECT_TRUE(captures.cameras[0].fixed);
  EXPECT_EQ(captures.cameras[0].intrinsics.params[1], 301);
  EXPECT_EQ(Failure({.prior_camera = {300}}).kind(), ErrorKind::kUsage);
}

TEST_F(Ingest, EmptyFolderIsAnError) {
  const Error error = Failure();
  EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
  EXPECT_THAT(error.what(), HasSubstr(photos_.path().string()));
  EXPECT_THAT(error.remedy(), Not(IsEmpty()));
}

TEST_F(Ingest, OnePhotoIsAnErrorThatSaysWhatElseWasThere) {
  photos_.Write("a.jpg", MakeJpeg(1));
  photos_.Write("b.jpg", "");
  const Error error = Failure();
  EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
  EXPECT_THAT(error.what(), HasSubstr("only 1 of 2"));
  EXPECT_THAT(error.what(), HasSubstr("b.jpg: the file is empty"));
}

TEST_F(Ingest, NoUsablePhotoIsAnError) {
  photos_.Write("a.jpg", "x");
  photos_.Write("b.jpg", "");
  EXPECT_THAT(Failure().what(), HasSubstr("none of 2"));
}

TEST_F(Ingest, OutputsDoNotDependOnThreadsOrOnThePlace) {
  for (int i = 0; i < 9; ++i) {
    photos_.Write("flight/" + std::to_string(i) + ".jpg", MakeDjiPhoto(i, 45, 7 + i * 1e-4, 300));
  }
  photos_.Write("broken.jpg", "broken");
  Run({}, 1);
  const std::string captures = Output("captures.json");
  const std::string sheet = Output("contact-sheet.jpg");
  units_.units.clear();
  Run({}, 4);
  EXPECT_EQ(Output("captures.json"), captures);
  EXPECT_EQ(Output("contact-sheet.jpg"), sheet);
  EXPECT_THAT(captures, Not(HasSubstr(photos_.path().string())));
}

TEST_F(Ingest, EachPhotoIsDecodedOnce) {
  for (int i = 0; i < 4; ++i) photos_.Write(std::to_string(i) + ".jpg", MakeJpeg(i));
  Run();
  EXPECT_EQ(units_.saved, 4);
  const std::string captures = Output("captures.json");
  photos_.Write("new.jpg", MakeJpeg(9));
  Run();
  EXPECT_EQ(units_.saved, 5);
  std::filesystem::remove(photos_.path() / "new.jpg");
  Run();
  EXPECT_EQ(units_.saved, 5);
  EXPECT_EQ(Output("captures.json"), captures);
}

TEST_F(Ingest, PhotosAreNotTouched) {
  photos_.Write("a.jpg", MakeDjiPhoto(1, 45, 7, 300));
  photos_.Write("b.jpg", MakeDjiPhoto(2, 45, 7, 300));
  for (const char* name : {"a.jpg", "b.jpg"}) {
    std::filesystem::permissions(photos_.path() / name, std::filesystem::perms::owner_read);
  }
  const auto time = std::filesystem::last_write_time(photos_.path() / "a.jpg");
  const std::string hash = HashFile(photos_.path() / "a.jpg");
  Run();
  EXPECT_EQ(std::filesystem::last_write_time(photos_.path() / "a.jpg"), time);
  EXPECT_EQ(HashFile(photos_.path() / "a.jpg"), hash);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(photos_.path()), {}), 2);
}

TEST_F(Ingest, StopsWhenAsked) {
  photos_.Write("a.jpg", MakeJpeg(1));
  photos_.Write("b.jpg", MakeJpeg(2));
  progress_.cancelled = true;
  EXPECT_EQ(Failure().kind(), ErrorKind::kInterrupted);
}

TEST_F(Ingest, ContactSheetHasAThumbnailEach) {
  for (int i = 0; i < 10; ++i) photos_.Write(std::to_string(i) + ".jpg", MakeJpeg(i));
  photos_.Write("broken 😀.jpg", "broken");
  Run();
  const Image sheet = ReadImage(work_.path() / "out" / "contact-sheet.jpg");
  EXPECT_EQ(sheet.width_px, 8 * 172);
  EXPECT_EQ(sheet.height_px, 2 * 148);  // eleven photos: two rows
  size_t red = 0;
  for (int y = 0; y < sheet.height_px; ++y) {
    for (int x = 0; x < sheet.width_px; ++x) {
      const uint8_t* pixel = sheet.Pixel(x, y);
      const bool in_last_cell = x >= 2 * 172 && x < 3 * 172 && y >= 148;
      if (in_last_cell && pixel[0] > 150 && pixel[1] < 90 && pixel[2] < 90) ++red;
    }
  }
  EXPECT_GT(red, 1000U);
}

}  // namespace
}  // namespace stucco
