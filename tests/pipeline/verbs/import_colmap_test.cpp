// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/verbs/import.h"
#include "survey/calibration.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/survey_folder.h"
#include "tests/pipeline/fake_survey.h"
#include "tests/pipeline/verbs/imported.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

class ImportColmapTest : public testing::Test {
 protected:
  ImportReport Import() { return ImportColmap(fake.survey, model, fake.table, fake.platform); }
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

  FakeSurvey fake;  // photos of 16 x 8
  const fs::path model = fake.root / "model";
};

TEST_F(ImportColmapTest, AModelOfReducedPhotosIsScaledToThem) {
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

TEST_F(ImportColmapTest, ARunGoesOnFromIt) {
  WriteModel(model, {"p1.jpg", "p2.jpg"}, 16, 8);
  Import();
  const SurveyStatus status = fake.Status();
  EXPECT_EQ(StateOf(status, "calib"), "done");
  EXPECT_EQ(status.stages[1].assessment.manifest->imported_from, model.string());
  EXPECT_FALSE(FakeSurvey::Ran(fake.Run()).contains("calib"));
}

TEST_F(ImportColmapTest, RefusesModelsOfOtherPhotos) {
  WriteModel(model, {"p1.jpg", "x.jpg"}, 16, 8);
  EXPECT_THAT(Refusal(), HasSubstr("1 of 2 photos of the model are not in"));
  WriteModel(model, {"p1.jpg", "elsewhere/p1.jpg"}, 16, 8);
  EXPECT_THAT(Refusal(), HasSubstr("p1.jpg more than once"));
  WriteModel(model, {"p1.jpg", "p2.jpg"}, 16, 4);
  EXPECT_THAT(Refusal(), HasSubstr("camera 1 of the model is of 16 x 4 pixels"));
}

TEST_F(ImportColmapTest, SaysWhereNothingKeepsASecondRunAway) {
  WriteModel(model, {"p1.jpg", "p2.jpg"}, 16, 8);
  fake.platform = WithoutLocks();
  EXPECT_THAT(Import().notes, Contains(HasSubstr("no locks")));
  const SurveyLock lock(fake.survey, "stucco run here", RealPlatform());
  fake.platform = RealPlatform();
  EXPECT_THROW(Import(), Error);
}

}  // namespace
}  // namespace stucco
