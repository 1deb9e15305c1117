// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/flight_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "simulate/random.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/files.h"

namespace stucco::simulate {
namespace {

class FlightFolder : public ::testing::Test {
 protected:
  FlightFolder() { std::filesystem::create_directories(survey_ / kTruthFolder); }
  ~FlightFolder() override { std::filesystem::remove_all(survey_); }

  const std::filesystem::path survey_ =
      std::filesystem::path(::testing::TempDir()) / ("flight_folder_" + std::to_string(getpid()));
};

Flight FlightOfFour() {
  Random random(7);
  Flight flight;
  flight.scene = "town/scene";
  flight.seed = 9;
  flight.made_from = "abc";
  flight.scene_hash = "def";
  flight.faults = {0.1, 0.2, 0.3, 0.4, 55};
  flight.georef.frame = "enu";
  flight.georef.origin_latitude_deg = 50.1;
  flight.georef.origin_longitude_deg = -14.2;
  flight.georef.origin_height_m = 212.25;
  for (int i = 0; i < 4; ++i) {
    FlownPhoto photo;
    photo.path = "photo" + std::to_string(i) + ".JPG";
    photo.view = "v" + std::to_string(i);
    photo.camera.id = CameraId{1};
    photo.camera.model = CameraModel::kOpenCv;
    photo.camera.width_px = 400;
    photo.camera.height_px = 300;
    photo.camera.params = {280.1, 280.2, 201.3, 149.4, -0.1, 0.02, 1e-4, -2e-5};
    photo.cam_from_world.rotation =
        Eigen::Quaterniond(random.Normal(), random.Normal(), random.Normal(), random.Normal())
            .normalized();
    photo.cam_from_world.translation = {random.Normal(), random.Normal(), random.Normal()};
    photo.light.haze_m = 4000;
    photo.time_s = i / 3.0;
    photo.exposure = 0.7 + random.Unit();
    photo.white_balance = {1.05, 1, 1 / 3.0};
    flight.photos.push_back(photo);
  }
  flight.photos[1].lost = true;
  flight.photos[2].duplicate_of = "photo0.JPG";
  flight.photos[3].held_out = true;
  flight.photos[3].path = "held_out/photo3.JPG";
  return flight;
}

TEST_F(FlightFolder, ReadsBackWhatWasWritten) {
  const Flight flight = FlightOfFour();
  WriteFlight(flight, survey_);
  const Flight back = ReadFlight(survey_);
  EXPECT_EQ(back.scene, flight.scene);
  EXPECT_EQ(back.seed, flight.seed);
  EXPECT_EQ(back.faults.motion_blur_px, 0.1);
  EXPECT_EQ(back.faults.focus_blur_px, 0.2);
  EXPECT_EQ(back.faults.noise, 0.3);
  EXPECT_EQ(back.faults.sharpening, 0.4);
  EXPECT_EQ(back.faults.jpeg_quality, 55);
  EXPECT_EQ(back.made_from, flight.made_from);
  EXPECT_EQ(back.scene_hash, flight.scene_hash);
  EXPECT_EQ(back.georef.frame, "enu");
  EXPECT_EQ(back.georef.origin_height_m, 212.25);
  ASSERT_EQ(back.photos.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    const FlownPhoto& was = flight.photos[i];
    const FlownPhoto& is = back.photos[i];
    EXPECT_EQ(is.path, was.path);
    EXPECT_EQ(is.view, was.view);
    EXPECT_EQ(is.camera.params, was.camera.params);
    EXPECT_EQ(is.cam_from_world.rotation.coeffs(), was.cam_from_world.rotation.coeffs());
    EXPECT_EQ(is.cam_from_world.translation, was.cam_from_world.translation);
    EXPECT_EQ(is.light.to_sun, was.light.to_sun);
    EXPECT_EQ(is.light.sky, was.light.sky);
    EXPECT_EQ(is.time_s, was.time_s);
    EXPECT_EQ(is.exposure, was.exposure);
    EXPECT_EQ(is.white_balance, was.white_balance);
    EXPECT_EQ(is.lost, was.lost);
    EXPECT_EQ(is.held_out, was.held_out);
    EXPECT_EQ(is.duplicate_of, was.duplicate_of);
  }
}

TEST_F(FlightFolder, ColmapModelHasThePhotosThatThereAre) {
  const Flight flight = FlightOfFour();
  WriteFlight(flight, survey_);
  const Reconstruction model = ReadColmapModel(survey_ / "truth/sparse");
  ASSERT_EQ(model.photos.size(), 2u);
  std::vector<std::string> names;
  for (const auto& [id, photo] : model.photos) names.push_back(photo.name);
  EXPECT_THAT(names, ::testing::ElementsAre("photo0.JPG", "photo2.JPG"));
  const RegisteredImage& first = model.photos.begin()->second;
  EXPECT_LT((first.cam_from_world.Center() - flight.photos[0].cam_from_world.Center()).norm(),
            1e-12);
  EXPECT_EQ(model.cameras.begin()->second.params, flight.photos[0].camera.params);
}

TEST_F(FlightFolder, TheFlightIsWrittenBeforeItsColmapModel) {
  WriteFile(survey_ / "truth/sparse", "in the way of the folder");
  EXPECT_THROW(WriteFlight(FlightOfFour(), survey_), Error);
  EXPECT_EQ(ReadFlight(survey_).made_from, "abc");
}

TEST_F(FlightFolder, DamageIsNamed) {
  EXPECT_THROW(ReadFlight(survey_), Error);  // missing
  WriteFlight(FlightOfFour(), survey_);
  const std::string whole = ReadFile(survey_ / kFlightFile);
  const auto fails_with = [&](const std::string& text, const char* reason) {
    WriteFile(survey_ / kFlightFile, text);
    try {
      ReadFlight(survey_);
      ADD_FAILURE() << reason;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      EXPECT_THAT(error.what(), ::testing::HasSubstr("flight.json"));
      EXPECT_THAT(error.what(), ::testing::HasSubstr(reason));
    }
  };
  fails_with(whole.substr(0, whole.size() / 2), "parse");
  std::string text = whole;
  text.replace(text.find("OPENCV"), 6, "FISHED");
  fails_with(text, "camera model");
  text = whole;
  text.replace(text.find("\"camera\": 0"), 11, "\"camera\": 7");
  fails_with(text, "range");
  text = whole;
  text.replace(text.find("\"version\": 1"), 12, "\"version\": 2");
  fails_with(text, "version");
}

TEST_F(FlightFolder, PhotosOutsideOfItsFoldersAreRefused) {
  const auto is_read = [&](const std::string& path, bool held_out) {
    Flight flight = FlightOfFour();
    flight.photos[0].path = path;
    flight.photos[0].held_out = held_out;
    WriteFlight(flight, survey_);
    try {
      ReadFlight(survey_);
      return true;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      EXPECT_THAT(error.what(), ::testing::HasSubstr("not in the folder"));
      return false;
    }
  };
  EXPECT_TRUE(is_read("a.JPG", false));
  EXPECT_TRUE(is_read("held_out/a.JPG", true));
  for (const char* path : {"", ".", "..", "../a.JPG", "/tmp/a.JPG", "sub/a.JPG", "..\\a.JPG"}) {
    EXPECT_FALSE(is_read(path, false)) << path;
    EXPECT_FALSE(is_read(std::string("held_out/") + path, true)) << path;
  }
  EXPECT_FALSE(is_read("held_out/a.JPG", false));
  EXPECT_FALSE(is_read("flight.json", true));
}

}  // namespace
}  // namespace stucco::simulate
