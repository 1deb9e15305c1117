// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/verbs/import.h"
#include "survey/error.h"
#include "survey/point_cloud.h"
#include "survey/survey_folder.h"
#include "tests/pipeline/fake_survey.h"
#include "tests/pipeline/verbs/imported.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

// A survey with poses, and a cloud of which the photos see every second point.
class ImportCloudTest : public testing::Test {
 protected:
  ImportCloudTest() {
    for (int i = 0; i < 40; ++i) {
      cloud.positions.emplace_back(i % 2 == 0 ? 4 : 1000, 0, 10 + 0.01 * i);
    }
  }

  void GivePoses() {
    WriteModel(fake.root / "model", {"p1.jpg", "p2.jpg"}, 16, 8);
    ImportInto(fake, fake.root / "model");
  }
  CloudImportReport Import() {
    WritePly(cloud, fake.root / "cloud.ply");
    return ImportCloud(fake.survey, fake.root / "cloud.ply", fake.table, fake.platform);
  }
  std::string Refusal() {
    try {
      Import();
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
      EXPECT_FALSE(fs::exists(fake.survey / "dense"));
      return e.what();
    }
    return "was not refused";
  }

  FakeSurvey fake;
  PointCloud cloud;
};

TEST_F(ImportCloudTest, TakesThePlaceOfTheDenseCloud) {
  GivePoses();
  const CloudImportReport report = Import();
  EXPECT_EQ(report.points, 40u);
  EXPECT_NEAR(report.seen_share, 0.5, 1e-12);
  EXPECT_THAT(report.notes, Contains(HasSubstr("no normals")));
  EXPECT_EQ(ReadPly(fake.survey / kCloudFile).positions, cloud.positions);
  EXPECT_EQ(StateOf(fake.Status(), "dense"), "done");
}

TEST_F(ImportCloudTest, IsKnownByItsBeginning) {
  WritePly(cloud, fake.root / "cloud.bin");
  EXPECT_TRUE(IsCloud(fake.root / "cloud.bin"));
  EXPECT_FALSE(IsCloud(fake.photos / "p1.jpg"));
  EXPECT_FALSE(IsCloud(fake.root / "gone.ply"));
}

TEST_F(ImportCloudTest, KeepsListsOfPhotosOnlyWhereAllAreKnown) {
  GivePoses();
  cloud.views.assign(cloud.size(), {1, 2});
  Import();
  EXPECT_EQ(ReadPly(fake.survey / kCloudFile).views, cloud.views);
  cloud.views.back() = {1, 3};
  EXPECT_THAT(Import().notes, Contains(HasSubstr("do not fit the poses")));
  EXPECT_THAT(ReadPly(fake.survey / kCloudFile).views, IsEmpty());
}

TEST_F(ImportCloudTest, RefusesACloudWithoutPosesOrOfAnotherFrame) {
  EXPECT_THAT(Refusal(), HasSubstr("no camera poses yet"));
  GivePoses();
  for (Eigen::Vector3d& point : cloud.positions) point.x() += 1e6;
  EXPECT_THAT(Refusal(), HasSubstr("not in the frame of the camera poses"));
  cloud.positions.clear();
  EXPECT_THAT(Refusal(), HasSubstr("cloud.ply"));
}

}  // namespace
}  // namespace stucco
