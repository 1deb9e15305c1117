// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/verbs/import.h"
#include "survey/calibration.h"
#include "survey/captures.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/georef.h"
#include "survey/survey_folder.h"
#include "tests/pipeline/fake_survey.h"
#include "tests/pipeline/verbs/imported.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

class ImportModelTest : public testing::Test {
 protected:
  ImportReport Import() { return ImportInto(fake, model); }
  std::string Refusal() {
    try {
      Import();
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
      EXPECT_FALSE(fs::exists(fake.survey / "calib"));
      return e.what();
    }
    return "was not refused";
  }

  // Ingest finds photos where the cameras of the model are, when a unit of it is ten metres, x is
  // east and y is down.
  void GivePositions(double error_m) {
    fake.during = [this, error_m](const std::string& stage, StageContext& context) {
      if (stage != "ingest") return;
      Captures captures;
      captures.cameras.emplace_back().intrinsics = {
          CameraId{1}, CameraModel::kPinhole, 16, 8, {16, 16, 8, 4}};
      for (const auto& [id, photo] : ReadColmapModel(model).photos) {
        const Eigen::Vector3d centre = photo.cam_from_world.Center();
        const double error = id.value % 2 == 0 ? error_m : -error_m;
        const Eigen::Vector3d geodetic = GeodeticFromEnu(
            place, {10 * centre.x(), 10 * centre.z() + error, -10 * centre.y() + error});
        CapturedPhoto capture;
        capture.path = photo.name;
        capture.usable = true;
        capture.camera = 0;
        capture.position = GeoPosition{.latitude_deg = geodetic[0],
                                       .longitude_deg = geodetic[1],
                                       .height_m = geodetic[2],
                                       .has_height = true,
                                       .sigma_horizontal_m = 0.1,
                                       .sigma_vertical_m = 0.1};
        captures.photos.push_back(capture);
      }
      captures.photos.emplace_back().path = "p9.jpg";
      captures.photos.back().usable = true;
      captures.photos.back().camera = 0;
      WriteCaptures(captures, context.out / "captures.json");
    };
  }
  // Cameras that are not on one line.
  void WriteCorner() {
    WriteModel(model, {"p0.jpg", "p1.jpg", "p2.jpg", "p3.jpg"}, 16, 8);
    Reconstruction read = ReadColmapModel(model);
    read.photos.at(PhotoId{2}).cam_from_world.translation += Eigen::Vector3d(0, 3, 0);
    read.photos.at(PhotoId{4}).cam_from_world.translation += Eigen::Vector3d(0, 0, 4);
    WriteColmapText(read, model);
  }
  Georef WrittenGeoref() const { return ReadGeoref(fake.survey / kGeorefFile); }

  static Georef MadePlace() {
    Georef georef;
    georef.frame = "enu";
    georef.metric = true;
    georef.origin_latitude_deg = 52;
    georef.origin_longitude_deg = 4;
    georef.origin_height_m = 7;
    return georef;
  }

  FakeSurvey fake;  // photos of 16 x 8
  const Georef place = MadePlace();
  const fs::path model = fake.root / "model";
};

TEST_F(ImportModelTest, AModelOfReducedPhotosIsScaledToThem) {
  WriteModel(model, {"elsewhere/p1.jpg", "p2.jpg"}, 8, 4);
  const ImportReport report = Import();
  EXPECT_EQ(report.photos, 2);
  EXPECT_EQ(report.points, 1);
  EXPECT_EQ(report.cameras, 1);
  EXPECT_THAT(report.notes, Contains("camera 1 was scaled from 8 x 4 to 16 x 8 pixels"));
  const Reconstruction read = ReadColmapModel(fake.survey / kSparseFolder);
  EXPECT_EQ(read.cameras.begin()->second.width_px, 16);
  EXPECT_EQ(read.photos.begin()->second.name, "p1.jpg");
  EXPECT_LT(MeanReprojectionError(read), 1e-9);
}

TEST_F(ImportModelTest, ARunGoesOnFromIt) {
  WriteModel(model, {"p1.jpg", "p2.jpg"}, 16, 8);
  Import();
  const SurveyStatus status = fake.Status();
  EXPECT_EQ(StateOf(status, "calib"), "done");
  EXPECT_EQ(status.stages[1].assessment.manifest->imported_from, model.string());
  EXPECT_FALSE(FakeSurvey::Ran(fake.Run()).contains("calib"));
}

TEST_F(ImportModelTest, RefusesModelsOfOtherPhotos) {
  WriteModel(model, {"p1.jpg", "x.jpg"}, 16, 8);
  EXPECT_THAT(Refusal(), HasSubstr("1 of 2 photos of the model are not in"));
  WriteModel(model, {"p1.jpg", "elsewhere/p1.jpg"}, 16, 8);
  EXPECT_THAT(Refusal(), HasSubstr("p1.jpg more than once"));
  WriteModel(model, {"p1.jpg", "p2.jpg"}, 16, 4);
  EXPECT_THAT(Refusal(), HasSubstr("camera 1 of the model is of 16 x 4 pixels"));
}

TEST_F(ImportModelTest, IsBroughtToThePositionsOfItsPhotos) {
  WriteCorner();
  GivePositions(0);
  const ImportReport report = Import();
  EXPECT_EQ(report.format, "COLMAP");
  EXPECT_EQ(report.frame, "enu");
  EXPECT_THAT(report.notes, Contains(HasSubstr("brought to the positions")));
  EXPECT_THAT(report.notes, Contains("1 usable photos are not in the model"));
  const Georef georef = WrittenGeoref();
  EXPECT_TRUE(georef.metric);
  EXPECT_EQ(georef.source, "gps");
  const Reconstruction read = ReadColmapModel(fake.survey / kSparseFolder);
  const Eigen::Vector3d base = read.photos.at(PhotoId{3}).cam_from_world.Center() -
                               read.photos.at(PhotoId{1}).cam_from_world.Center();
  EXPECT_LT((base - Eigen::Vector3d(20, 0, 0)).norm(), 1e-3);  // metres to the east
  // What every photo sees, 10 ahead of it, is 100 metres to the north.
  const Eigen::Vector3d ahead =
      read.points.begin()->second.position - read.photos.at(PhotoId{1}).cam_from_world.Center();
  EXPECT_NEAR(ahead.y(), 100, 1e-3);
  const Calibration calibration = ReadCalibration(fake.survey / kCalibrationFile);
  EXPECT_LT(calibration.prior_rms_horizontal_m, 1e-3);
  EXPECT_GE(calibration.photos[0].prior_residual_m, 0);
  EXPECT_EQ(StateOf(fake.Status(), "ingest"), "done");
}

TEST_F(ImportModelTest, KeepsItsOwnFrameWhereThePositionsDoNotFit) {
  WriteCorner();
  GivePositions(500);
  const ImportReport report = Import();
  EXPECT_EQ(report.frame, "arbitrary");
  EXPECT_THAT(report.notes, Contains(HasSubstr("it keeps directions and a scale of its own")));
  const Reconstruction written = ReadColmapModel(fake.survey / kSparseFolder);
  EXPECT_EQ(written.photos.at(PhotoId{4}).cam_from_world.translation,
            ReadColmapModel(model).photos.at(PhotoId{4}).cam_from_world.translation);
}

TEST_F(ImportModelTest, AFrameThatTheFileNamesIsBelievedAndCompared) {
  WriteCorner();
  GivePositions(0);
  Georef elsewhere = place;
  elsewhere.origin_latitude_deg += 0.01;  // 1113 m to the north
  WriteGeoref(elsewhere, model / "georef.json");
  const ImportReport report = Import();
  EXPECT_EQ(report.frame, "enu");
  EXPECT_EQ(WrittenGeoref().origin_latitude_deg, elsewhere.origin_latitude_deg);
  EXPECT_THAT(report.notes, Contains(HasSubstr("m from the positions that the photos recorded")));
}

TEST_F(ImportModelTest, AFrameWithAFarOriginIsMadeLevelHere) {
  WriteCorner();
  Reconstruction far = ReadColmapModel(model);
  Similarity shift;
  shift.translation = {100'000, 0, 0};
  Transform(shift, far);
  WriteColmapText(far, model);
  WriteGeoref(place, model / "georef.json");
  Import();
  const Georef georef = WrittenGeoref();
  EXPECT_GT(georef.origin_longitude_deg, 5);
  const Reconstruction read = ReadColmapModel(fake.survey / kSparseFolder);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& [id, photo] : read.photos) mean += photo.cam_from_world.Center() / 4;
  EXPECT_LT(mean.norm(), 1e-6);
  for (const auto& [id, photo] : read.photos) {
    const Eigen::Vector3d geodetic = GeodeticFromEnu(georef, photo.cam_from_world.Center());
    const Eigen::Vector3d in_file = EnuFromGeodetic(place, geodetic[0], geodetic[1], geodetic[2]);
    EXPECT_LT((in_file - far.photos.at(id).cam_from_world.Center()).norm(), 1e-6);
  }
  EXPECT_NEAR(MeanReprojectionError(read), MeanReprojectionError(far), 1e-6);
}

TEST_F(ImportModelTest, SaysWhatLaterStagesWillMiss) {
  WriteModel(model, {"p1.jpg", "p2.jpg"}, 16, 8);
  Reconstruction bare = ReadColmapModel(model);
  bare.points.clear();
  for (auto& [id, photo] : bare.photos) photo.observations.clear();
  WriteColmapText(bare, model);
  EXPECT_THAT(Import().notes, Contains(HasSubstr("no points that photos share")));
}

TEST_F(ImportModelTest, AFailedIngestIsItsFailure) {
  WriteModel(model, {"p1.jpg", "p2.jpg"}, 16, 8);
  fake.during = [](const std::string& stage, StageContext&) {
    if (stage == "ingest") throw Error(ErrorKind::kBadInput, "no photo can be used", "add some");
  };
  EXPECT_EQ(Refusal(), "no photo can be used");
}

TEST_F(ImportModelTest, SaysWhereNothingKeepsASecondRunAway) {
  WriteModel(model, {"p1.jpg", "p2.jpg"}, 16, 8);
  fake.platform = WithoutLocks();
  EXPECT_THAT(Import().notes, Contains(HasSubstr("no locks")));
  const SurveyLock lock(fake.survey, "stucco run here", RealPlatform());
  fake.platform = RealPlatform();
  EXPECT_THROW(Import(), Error);
}

}  // namespace
}  // namespace stucco
