// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>

#include "simulate/flight/photo_store.h"
#include "simulate/flight/prepare.h"
#include "simulate/flight/take_photos.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/image.h"
#include "survey/photo_files.h"
#include "tests/simulate/made_flight.h"

namespace stucco::simulate {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

FlightOptions SmallPhotos() {
  FlightOptions options;
  options.scale = 0.02;  // 106 x 79
  return options;
}

class TakePhotosTest : public ::testing::Test {
 protected:
  TakePhotosTest() { fs::remove_all(survey_); }
  ~TakePhotosTest() override { fs::remove_all(survey_); }

  FlySummary Take(const FlightOptions& options, int threads = 1, const std::string& key = "a",
                  const std::function<void(size_t, size_t)>& progress = {}) {
    PreparedFlight prepared = PrepareFlight(MadePlan(20), MadeSceneInfo(), MadeScene(), options);
    prepared.flight.made_from = key;
    MeterFlight(MadePhotographer(), options, threads, prepared);
    FlyRequest request;
    request.survey = survey_;
    request.threads = threads;
    return TakePhotos(prepared, MadePhotographer(), options, request, progress);
  }

  std::vector<std::string> Hashes() const {
    std::vector<std::string> hashes;
    for (const PhotoFile& file : FindPhotoFiles(survey_ / "photos")) {
      hashes.push_back(file.path + " " + HashFile(survey_ / "photos" / file.file));
    }
    return hashes;
  }

  const fs::path survey_ =
      fs::path(::testing::TempDir()) / ("flight_photos_" + std::to_string(getpid()));
};

TEST_F(TakePhotosTest, TakesWhatIsNotLost) {
  FlightOptions options = SmallPhotos();
  options.lost_share = 0.2;
  options.duplicate_share = 0.25;
  options.held_out = 3;
  options.write_depth = true;
  const FlySummary summary = Take(options);
  EXPECT_EQ(summary.lost, 4);
  EXPECT_EQ(summary.photos, 16 + 4);
  EXPECT_EQ(summary.held_out, 3);
  EXPECT_EQ(summary.rendered, 23);
  EXPECT_NEAR(summary.megapixels, 23 * 106 * 79e-6, 1e-9);
  EXPECT_EQ(Hashes().size(), 20u);
  const Flight flight = ReadFlight(survey_);
  EXPECT_EQ(flight.photos.size(), 20u + 4 + 3);
  for (const FlownPhoto& photo : flight.photos) {
    EXPECT_EQ(fs::exists(survey_ / (photo.held_out ? "truth" : "photos") / photo.path),
              !photo.lost);
    EXPECT_EQ(fs::exists(PathOfDepth(survey_, photo)), !photo.lost);
  }
  // A photo taken twice is not the same file twice.
  for (const FlownPhoto& photo : flight.photos) {
    if (photo.duplicate_of.empty()) continue;
    const Image one = ReadJpeg(survey_ / "photos" / photo.path);
    const Image two = ReadJpeg(survey_ / "photos" / photo.duplicate_of);
    EXPECT_NE(one.data, two.data);
  }
}

TEST_F(TakePhotosTest, SameBytesAtAnyNumberOfThreads) {
  Take(SmallPhotos(), 1);
  const auto one = Hashes();
  const std::string truth = ReadFile(survey_ / kFlightFile);
  fs::remove_all(survey_);
  Take(SmallPhotos(), 3);
  EXPECT_EQ(Hashes(), one);
  EXPECT_EQ(ReadFile(survey_ / kFlightFile), truth);
  fs::remove_all(survey_);
  FlightOptions other = SmallPhotos();
  other.seed = 2;
  Take(other);
  EXPECT_NE(Hashes(), one);
}

TEST_F(TakePhotosTest, SharpeningIsAnOption) {
  Take(SmallPhotos());
  const auto sharpened = Hashes();
  fs::remove_all(survey_);
  FlightOptions soft = SmallPhotos();
  soft.sharpening = 0;
  Take(soft);
  const auto plain = Hashes();
  ASSERT_EQ(plain.size(), sharpened.size());
  for (size_t i = 0; i < plain.size(); ++i) EXPECT_NE(plain[i], sharpened[i]);
}

TEST_F(TakePhotosTest, GoesOnAfterAnInterruption) {
  const auto stop = [](size_t done, size_t /*total*/) {
    if (done == 7) throw Error(ErrorKind::kInterrupted, "interrupted");
  };
  EXPECT_THROW(Take(SmallPhotos(), 1, "a", stop), Error);
  const auto some = Hashes();
  EXPECT_GE(some.size(), 7u);
  EXPECT_LT(some.size(), 20u);
  const FlySummary rest = Take(SmallPhotos());
  EXPECT_EQ(rest.rendered, 20 - static_cast<int>(some.size()));
  const auto all = Hashes();
  EXPECT_THAT(all, ::testing::IsSupersetOf(some));
  EXPECT_EQ(Take(SmallPhotos()).rendered, 0);
  fs::remove_all(survey_);
  Take(SmallPhotos());
  EXPECT_EQ(Hashes(), all);
}

TEST_F(TakePhotosTest, AnotherFlightReplacesThePhotosOfThisOne) {
  Take(SmallPhotos());
  FlightOptions other = SmallPhotos();
  other.start_hour = 14;
  const FlySummary summary = Take(other, 1, "b");
  EXPECT_EQ(summary.rendered, 20);
  EXPECT_EQ(Hashes().size(), 20u);
  EXPECT_THAT(summary.notes, ::testing::Contains(HasSubstr("20 photos")));
}

TEST_F(TakePhotosTest, APhotoThatCannotBeRemovedIsAnError) {
  Take(SmallPhotos());
  const fs::path stuck = PathOfPhoto(survey_, ReadFlight(survey_).photos[3]);
  fs::remove(stuck);
  fs::create_directories(stuck / "folder");
  try {
    Take(SmallPhotos(), 1, "b");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(error.what(), HasSubstr(stuck.filename().string()));
  }
  EXPECT_EQ(ReadFlight(survey_).made_from, "a");
}

TEST_F(TakePhotosTest, RealPhotosAreLeftAlone) {
  fs::create_directories(survey_ / "photos");
  WriteImage(Image{8, 8, 3, std::vector<uint8_t>(192, 9)}, survey_ / "photos/DJI_0001.JPG");
  const auto before = Hashes();
  try {
    Take(SmallPhotos());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(error.what(), HasSubstr("DJI_0001.JPG"));
  }
  EXPECT_EQ(Hashes(), before);
  EXPECT_FALSE(fs::exists(survey_ / "truth"));
}

TEST_F(TakePhotosTest, ATruthOfSomebodyElseIsLeftAlone) {
  EXPECT_NO_THROW(RequireFreeStore(survey_));
  fs::create_directories(survey_ / "truth/held_out");  // as far as a call came that was killed
  WriteFile(survey_ / "truth/.flight.json.1.0.partial", "{");
  EXPECT_NO_THROW(RequireFreeStore(survey_));
  fs::create_directories(survey_ / "truth/scans");
  WriteFile(survey_ / "truth/scans/house.ply", "ply");
  try {
    Take(SmallPhotos());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(error.what(), HasSubstr("house.ply"));
  }
  EXPECT_FALSE(fs::exists(survey_ / "photos"));
  EXPECT_FALSE(fs::exists(survey_ / kFlightFile));
}

TEST_F(TakePhotosTest, DepthMapsAreInTheFormatOfTheDenseStage) {
  FlightOptions options = SmallPhotos();
  options.write_depth = true;
  Take(options);
  const FlownPhoto photo = ReadFlight(survey_).photos[1];  // looks down by 20 degrees
  const std::string bytes = ReadFile(PathOfDepth(survey_, photo));
  ASSERT_EQ(bytes.size(), 12u + 8u * 106 * 79);
  const DepthMap map = DeserializeDepthMap(bytes);
  const float depth = map.depths[map.Index(53, 78)];
  const auto ray = photo.camera.Unproject({53.5, 78.5});
  const Eigen::Vector3d point =
      photo.cam_from_world.Inverse() * (depth * Eigen::Vector3d(ray->x(), ray->y(), 1));
  EXPECT_NEAR(point.z(), 0, 1e-4);
}

TEST(PrepareFlight, PosesAreThePlansWithoutNoise) {
  FlightOptions options = SmallPhotos();
  options.position_sigma_m = 0;
  options.gimbal_sigma_deg = 0;
  const Plan plan = MadePlan(20);
  const PreparedFlight prepared = PrepareFlight(plan, MadeSceneInfo(), MadeScene(3), options);
  for (size_t i = 0; i < 20; ++i) {
    const Pose& pose = prepared.flight.photos[i].cam_from_world;
    const Eigen::Vector3d expected = plan.views[i].position_m + Eigen::Vector3d(0, 0, 3);
    // 250 m above the ellipsoid the map's metre is longer by 4e-5.
    EXPECT_LT((pose.Center() - expected).norm(), 2e-3);
    const double yaw = plan.views[i].yaw_deg / 57.29577951308232;
    const Eigen::Vector3d ahead = pose.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    EXPECT_NEAR(std::remainder(std::atan2(ahead.x(), ahead.y()) - yaw, 6.283185307), 0, 1e-5);
    EXPECT_NEAR(std::asin(ahead.z()) * 57.29577951308232, plan.views[i].pitch_deg, 1e-3);
  }
}

TEST(PrepareFlight, SingleBlockedViewsAreSkippedAndManyAreAnError) {
  Plan plan = MadePlan(40);
  plan.views[4].position_m = {6, 4, 3};  // in the house
  plan.views[5].position_m = {6, 4, 3};
  plan.views[5].hover = plan.views[4].hover;
  FlightOptions options = SmallPhotos();
  const PreparedFlight prepared = PrepareFlight(plan, MadeSceneInfo(), MadeScene(), options);
  EXPECT_TRUE(prepared.flight.photos[4].lost);
  EXPECT_TRUE(prepared.flight.photos[5].lost);
  EXPECT_FALSE(prepared.flight.photos[6].lost);
  ASSERT_EQ(prepared.notes.size(), 2u);
  EXPECT_EQ(prepared.notes[0], "view h0002v0 stands inside B0001: no photo");
  plan.views[6].position_m = {3, 4, -2};
  try {
    PrepareFlight(plan, MadeSceneInfo(), MadeScene(), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(error.what(), HasSubstr("3 of 40 views"));
    EXPECT_THAT(error.what(), HasSubstr("h0002v0 stands inside"));
  }
}

TEST(MeterFlight, WhatIsNotTakenHasNoSayInTheExposure) {
  FlightOptions options = SmallPhotos();
  options.lost_share = 0.3;
  options.position_sigma_m = options.gimbal_sigma_deg = 0;
  PreparedFlight prepared = PrepareFlight(MadePlan(20), MadeSceneInfo(), MadeScene(), options);
  Photographer photographer = MadePhotographer();
  std::atomic<int> metered = 0;
  photographer.photograph = [&metered, photograph = photographer.photograph](
                                const Camera& camera, const Pose& pose, const Light& light,
                                int threads) {
    ++metered;
    return photograph(camera, pose, light, threads);
  };
  MeterFlight(photographer, options, 2, prepared);
  EXPECT_EQ(metered, 14);
  for (const FlownPhoto& photo : prepared.flight.photos) {
    EXPECT_EQ(photo.exposure == 1, photo.lost) << photo.path;
  }
}

TEST(PrepareFlight, RecordedPositionsHaveOneBiasAndTheirNoise) {
  const auto errors = [](FlightOptions options) {
    const PreparedFlight prepared =
        PrepareFlight(MadePlan(400), MadeSceneInfo(), MadeScene(), options);
    std::vector<Eigen::Vector3d> result;
    for (size_t i = 0; i < prepared.shots.size(); ++i) {
      const PhotoMetadata m = MetadataOf(prepared, i, options);
      result.push_back(
          EnuFromGeodetic(prepared.placed.world, m.latitude_deg, m.longitude_deg, m.height_m) -
          prepared.flight.photos[i].cam_from_world.Center());
    }
    return result;
  };
  const auto mean_of = [](const std::vector<Eigen::Vector3d>& all) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& one : all) sum += one;
    return Eigen::Vector3d(sum / static_cast<double>(all.size()));
  };
  FlightOptions options = SmallPhotos();
  options.gps_bias_m = 2;
  options.gps_sigma_m = 0;
  const auto biased = errors(options);
  for (const auto& error : biased) {
    EXPECT_NEAR(error.norm(), 2, 1e-6);
    EXPECT_LT((error - biased[0]).norm(), 1e-6);
  }
  options.gps_bias_m = 0;
  options.gps_sigma_m = 0.5;
  const auto noisy = errors(options);
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  for (const auto& error : noisy) square += error.cwiseProduct(error) / 400;
  EXPECT_NEAR(std::sqrt(square.x()), 0.5, 0.05);
  EXPECT_NEAR(std::sqrt(square.z()), 0.75, 0.08);
  options.gps_bias_m = 2;
  options.rtk = true;
  const auto exact = errors(options);
  EXPECT_LT(mean_of(exact).norm(), 0.004);
  EXPECT_LT(exact[7].norm(), 0.1);
  options.rtk = false;
  options.gps_bias_m = 0;
  options.gps_sigma_m = 0;
  options.geoid_m = 45;
  EXPECT_NEAR(errors(options)[3].z(), -45, 1e-6);
}

TEST(PrepareFlight, MotionHasItsTypicalLength) {
  FlightOptions options = SmallPhotos();
  options.motion_blur_px = 0.8;
  const PreparedFlight prepared =
      PrepareFlight(MadePlan(400), MadeSceneInfo(), MadeScene(), options);
  double sum = 0;
  for (size_t i = 0; i < 400; ++i) {
    const Eigen::Vector3d turn = EffectsOf(prepared, i, options).turn_rad;
    sum += turn.head<2>().norm() * prepared.flight.photos[i].camera.FocalX();
  }
  EXPECT_NEAR(sum / 400, 0.8, 0.06);
}

}  // namespace
}  // namespace stucco::simulate
