// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "pipeline/verbs/import.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/proxy.h"
#include "survey/survey_folder.h"
#include "tests/pipeline/fake_survey.h"
#include "tests/pipeline/verbs/imported.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

// A survey with poses that look along z at a wall ten before them.
class ImportSurfacesTest : public testing::Test {
 protected:
  ImportSurfacesTest() {
    WriteFile(fake.root / "wall.obj", "v 2 -1 10\nv 6 -1 10\nv 6 1 10\nv 2 1 10\nf 4 3 2 1\n");
    request.file = fake.root / "wall.obj";
  }
  void GivePoses() {
    WriteModel(fake.root / "model", {"p1.jpg", "p2.jpg"}, 16, 8);
    ImportInto(fake, fake.root / "model");
  }
  SurfaceImportReport Import() {
    return ImportSurfaces(fake.survey, request, fake.table, fake.platform);
  }
  std::string Refusal() {
    try {
      Import();
    } catch (const Error& e) {
      EXPECT_FALSE(fs::exists(fake.survey / "proxy"));
      return std::string(e.what()) + " | " + e.remedy();
    }
    return "was not refused";
  }

  FakeSurvey fake;
  SurfaceImportRequest request;
};

TEST_F(ImportSurfacesTest, TakesThePlaceOfTheModel) {
  GivePoses();
  const SurfaceImportReport report = Import();
  EXPECT_EQ(report.format, "OBJ");
  EXPECT_EQ(report.buildings, 1u);
  EXPECT_EQ(report.closed, 0u);
  EXPECT_EQ(report.facets, 1u);
  EXPECT_THAT(report.notes, Contains(HasSubstr("there is no cloud yet")));
  const Proxy proxy = ReadProxy(fake.survey / kFacetsFile);
  EXPECT_NEAR(proxy.buildings.at(0).facets.at(0).area, 8, 1e-9);
  EXPECT_THAT(proxy.findings, Contains(HasSubstr("imported from")));
  EXPECT_TRUE(fs::exists(fake.survey / "proxy/proxy.obj"));
  EXPECT_TRUE(fs::exists(fake.survey / "proxy/proxy.city.json"));
}

TEST_F(ImportSurfacesTest, AddsWhatWasTakenOffItsCoordinates) {
  GivePoses();
  WriteFile(request.file, "v 1 -1 9\nv 5 -1 9\nv 5 1 9\nv 1 1 9\nf 4 3 2 1\n");
  request.offset = {1, 0, 1};
  Import();
  const Proxy proxy = ReadProxy(fake.survey / kFacetsFile);
  for (const Eigen::Vector3d& p : proxy.buildings.at(0).facets.at(0).outer) {
    EXPECT_NEAR(p.z(), 10, 1e-9);
    EXPECT_GE(p.x(), 2 - 1e-9);
  }
}

TEST_F(ImportSurfacesTest, RefusesWhatItCannotPlace) {
  EXPECT_THAT(Refusal(), HasSubstr("there are no camera poses yet"));
  GivePoses();
  request.crs = "EPSG:25833";
  EXPECT_THAT(Refusal(), HasSubstr("the survey does not lie on the earth"));
  request.crs = "no such system";
  EXPECT_THAT(Refusal(), HasSubstr("is no coordinate system on the earth"));
  request.crs.clear();
  request.offset = {0, 0, -100};
  EXPECT_THAT(Refusal(), HasSubstr("--offset X,Y,Z"));
}

}  // namespace
}  // namespace stucco
