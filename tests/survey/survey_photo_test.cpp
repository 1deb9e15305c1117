// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/survey_photo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "survey/colmap_io.h"
#include "survey/survey_folder.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

CapturedPhoto Captured(const std::string& path, double sharpness) {
  CapturedPhoto photo;
  photo.path = path;
  photo.hash = "hash of " + path;
  photo.usable = true;
  photo.camera = 0;
  photo.sharpness = sharpness;
  return photo;
}

// Of the reconstruction's three photos the first two, and one that was not registered.
Captures MakeCaptures() {
  Captures captures;
  CapturedCamera camera;
  camera.key = "k";
  camera.intrinsics = {CameraId{1}, CameraModel::kPinhole, 640, 480, {500, 510, 320, 240}};
  captures.cameras = {camera};
  captures.photos = {Captured("a.jpg", 30), Captured("flight 1/DJI_0001.JPG", 10),
                     Captured("flight 1/DJI_0002.JPG", 20)};
  captures.photos[2].view = "h0v1";
  return captures;
}

TEST(JoinPhotos, KnowsWhatCalibrationAndIngestSay) {
  const Reconstruction model = test::MakeReconstruction();
  const std::vector<SurveyPhoto> photos = JoinPhotos(model, MakeCaptures());
  ASSERT_EQ(photos.size(), 3u);
  for (uint32_t i = 0; i < 3; ++i) {
    const RegisteredImage& image = model.photos.at(PhotoId{i + 1});
    EXPECT_EQ(photos[i].id, image.id);
    EXPECT_EQ(photos[i].path(), image.name);
    EXPECT_EQ(photos[i].camera.id, image.camera);
    EXPECT_EQ(photos[i].cam_from_world.translation, image.cam_from_world.translation);
    EXPECT_EQ(photos[i].safe_radius_squared, SafeRadiusSquared(photos[i].camera));
  }
  EXPECT_EQ(photos[0].captured.hash, "hash of flight 1/DJI_0001.JPG");
  EXPECT_EQ(photos[0].relative_sharpness, 0.5);  // of the median of 10, 20 and 30
  EXPECT_EQ(photos[1].relative_sharpness, 1);
  EXPECT_EQ(photos[1].captured.view, "h0v1");
  EXPECT_EQ(photos[2].captured.hash, "");  // ingest does not know it
  EXPECT_EQ(photos[2].relative_sharpness, 1);
}

TEST(JoinPhotos, UnusablePhotosDoNotSayWhatIsSharp) {
  Captures captures = MakeCaptures();
  captures.photos[0].usable = false;
  captures.photos[2].sharpness = 0;  // not known
  const std::vector<SurveyPhoto> photos = JoinPhotos(test::MakeReconstruction(), captures);
  EXPECT_EQ(photos[0].relative_sharpness, 1);
  EXPECT_EQ(photos[1].relative_sharpness, 1);
}

TEST(ReadSurveyPhotos, DoesWithoutCaptures) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / kSparseFolder);
  WriteColmapBinary(test::MakeReconstruction(), folder / kSparseFolder);
  EXPECT_EQ(ReadSurveyPhotos(folder.path()).at(1).captured.hash, "");
  std::filesystem::create_directories((folder / kCapturesFile).parent_path());
  WriteCaptures(MakeCaptures(), folder / kCapturesFile);
  EXPECT_EQ(ReadSurveyPhotos(folder.path()).at(1).captured.hash, "hash of flight 1/DJI_0002.JPG");
  std::filesystem::remove_all(folder / kSparseFolder);
  test::ExpectBadInput([&] { ReadSurveyPhotos(folder.path()); }, "sparse");
}

PlannedView View(const std::string& id, const std::vector<std::string>& facades) {
  PlannedView view;
  view.id = id;
  for (const std::string& facade : facades) view.targets.push_back({facade, {0, 4}, {0, 3}});
  return view;
}

TEST(JoinPlan, PhotosKnowWhatTheyAreFor) {
  Plan plan;
  plan.views = {View("h0v0", {"B0007/F02"}), View("h0v1", {"B0007/F02", "B0007/F03"})};
  std::vector<SurveyPhoto> photos(4);
  photos[0].captured.view = "h0v0";
  photos[1].captured.view = "h0v1";
  photos[2].captured.view = "";         // extra
  photos[3].captured.view = "unknown";  // of another plan
  photos[3].planned_facades = {"B0001/F00"};
  JoinPlan(plan, photos);
  EXPECT_THAT(photos[0].planned_facades, ElementsAre("B0007/F02"));
  EXPECT_THAT(photos[1].planned_facades, ElementsAre("B0007/F02", "B0007/F03"));
  EXPECT_THAT(photos[2].planned_facades, IsEmpty());
  EXPECT_THAT(photos[3].planned_facades, IsEmpty());
}

// Looks along y from (0, -4, 0).
SurveyPhoto LookingNorth() {
  SurveyPhoto photo;
  photo.camera = {CameraId{1}, CameraModel::kRadial, 800, 600, {400, 400, 300, -0.3, 0}};
  photo.cam_from_world.rotation = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX());
  photo.cam_from_world.translation = {0, 0, 4};
  return photo;
}

TEST(ProjectIntoPhoto, RefusesPointsWhereTheLensFoldsBack) {
  SurveyPhoto photo = LookingNorth();
  EXPECT_TRUE(ProjectIntoPhoto(photo, {1, 0, 0}));
  EXPECT_FALSE(ProjectIntoPhoto(photo, {1, -8, 0}));  // behind
  EXPECT_FALSE(ProjectIntoPhoto(photo, {9, 0, 0}));   // far outside; r (1 - 0.3 r^2) is negative
  EXPECT_FALSE(ProjectIntoPhoto(photo, {6.5, 0, 0}));
  EXPECT_EQ(SafeRadiusSquared(photo.camera), 0);  // the corners are out of this lens's reach
  photo.camera.params = {400, 400, 300, -0.1, 0.01};
  photo.safe_radius_squared = SafeRadiusSquared(photo.camera);
  EXPECT_GT(photo.safe_radius_squared, 1.5);  // 500 px from the centre at 400 px focal length
  EXPECT_TRUE(ProjectIntoPhoto(photo, {1, 0, 0}));
  EXPECT_FALSE(ProjectIntoPhoto(photo, {40, 0, 0}));
}

}  // namespace
}  // namespace stucco
