// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/import_scan.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/captures.h"
#include "survey/colmap_io.h"
#include "survey/coordinate_system.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/georef.h"
#include "survey/plan_frame.h"
#include "survey/plan_io.h"
#include "survey/point_cloud.h"
#include "survey/survey_folder.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::SizeIs;

constexpr char kCrs[] = "EPSG:25832";
constexpr double kEast = 500000, kNorth = 5400000, kHeight = 431;

// Two houses of 10 x 8 m, 30 m apart, and a point every 2 m over them, in UTM.
class ImportScanTest : public testing::Test {
 protected:
  ImportScanTest() {
    std::string features;
    for (const double x : {0.0, 40.0}) {
      features += fmt::format(
          R"({}{{"type":"Feature","properties":{{"id":{}}},"geometry":{{"type":"Polygon",)"
          R"("coordinates":[[[{},{}],[{},{}],[{},{}],[{},{}],[{},{}]]]}}}})",
          features.empty() ? "" : ",", features.empty() ? 1 : 2, kEast + x, kNorth, kEast + x + 10,
          kNorth, kEast + x + 10, kNorth + 8, kEast + x, kNorth + 8, kEast + x, kNorth);
    }
    request.map = fake.root / "map.geojson";
    WriteFile(request.map, R"({"type":"FeatureCollection","features":[)" + features + "]}");
    for (int x = -10; x <= 60; x += 2) {
      for (int y = -10; y <= 18; y += 2) {
        cloud.positions.emplace_back(kEast + x, kNorth + y, kHeight + 0.01 * x);
      }
    }
    cloud.normals.assign(cloud.size(), Eigen::Vector3f::UnitX());
    request.cloud = fake.root / "scan.ply";
    request.crs = kCrs;
  }

  ScanImportReport Import() {
    WritePly(cloud, request.cloud);
    return ImportScan(town, request, fake.table, fake.platform);
  }
  Error Refusal() {
    try {
      Import();
    } catch (const Error& e) {
      EXPECT_FALSE(fs::exists(town / kPlanFile));
      EXPECT_FALSE(fs::exists(town / "dense"));
      return e;
    }
    return Error(ErrorKind::kInterrupted, "was not refused");
  }

  FakeSurvey fake;
  PointCloud cloud;
  ScanRequest request;
  fs::path town = fake.root / "town";
};

TEST_F(ImportScanTest, MakesASurveyThatProxyCanGoOnFrom) {
  const ScanImportReport report = Import();
  EXPECT_EQ(report.points, cloud.size());
  EXPECT_EQ(report.buildings, 2u);
  EXPECT_EQ(report.reached, 2u);
  const SurveyStatus status = GetStatus(town, fake.table, fake.platform);
  for (const char* stage : {"ingest", "calib", "dense"}) {
    EXPECT_EQ(StateOf(status, stage), "done") << stage;
  }
  EXPECT_THAT(ReadCaptures(town / kCapturesFile).photos, SizeIs(0));
  EXPECT_TRUE(ReadColmapModel(town / kSparseFolder).photos.empty());
  const Plan plan = ReadPlan(town / kPlanFile);
  EXPECT_THAT(plan.footprints, SizeIs(2));
  EXPECT_THAT(plan.facades, SizeIs(8));
  EXPECT_TRUE(plan.views.empty());
  // Heights are not known: two storeys, and not the highest altitude that may be flown.
  for (const PlannedFootprint& footprint : plan.footprints) EXPECT_EQ(footprint.z_m.to_m, 6);
}

TEST_F(ImportScanTest, MapAndCloudLieInOneFrame) {
  Import();
  const Georef georef = ReadGeoref(town / kGeorefFile);
  EXPECT_EQ(georef.frame, "enu");
  EXPECT_TRUE(georef.metric);
  const PointCloud moved = ReadPly(town / kCloudFile);
  ASSERT_EQ(moved.size(), cloud.size());
  EXPECT_TRUE(moved.normals.empty());  // they were in the directions of the grid
  for (size_t i = 0; i < cloud.size(); i += 50) {
    const Eigen::Vector3d place = GeodeticFromEnu(georef, moved.positions[i]);
    const std::vector<Geodetic> places = {{place.x(), place.y()}};
    const Eigen::Vector2d back = CrsFromGeodetic(kCrs, places, "test").front();
    EXPECT_LT((back - cloud.positions[i].head<2>()).norm(), 1e-4);
    EXPECT_NEAR(place.z(), cloud.positions[i].z(), 1e-6);
  }
  // The first corner of a house is where the cloud has the point over it.
  const Plan plan = ReadPlan(town / kPlanFile);
  double nearest = 1e9;
  for (const Eigen::Vector2d& corner : plan.footprints[0].rings_m[0]) {
    const Eigen::Vector2d in_survey = EnuFromPlan(plan.origin, georef, corner);
    for (const Eigen::Vector3d& p : moved.positions) {
      nearest = std::min(nearest, (p.head<2>() - in_survey).norm());
    }
  }
  EXPECT_LT(nearest, 0.01);
}

TEST_F(ImportScanTest, WantsACoordinateSystem) {
  request.crs.clear();
  EXPECT_EQ(Refusal().kind(), ErrorKind::kUsage);
  request.map_crs = kCrs;  // enough for both
  EXPECT_EQ(Import().reached, 2u);
}

TEST_F(ImportScanTest, RefusesACloudOfAnotherPlace) {
  for (Eigen::Vector3d& point : cloud.positions) point.x() += 5000;
  EXPECT_THAT(Refusal().what(), HasSubstr("none of the 2 footprints"));
  request.map_crs = kCrs;
  request.crs = "EPSG:4326";
  EXPECT_THAT(Refusal().what(), HasSubstr("has no place in EPSG:4326"));
  cloud = {};
  EXPECT_THAT(Refusal().what(), HasSubstr("scan.ply"));
}

TEST_F(ImportScanTest, SaysWhatTheCloudDoesNotReach) {
  std::erase_if(cloud.positions, [](const auto& p) { return p.x() > kEast + 20; });
  cloud.normals.clear();
  EXPECT_THAT(Import().notes, Contains(HasSubstr("1 of 2 footprints")));
}

TEST_F(ImportScanTest, ACloudInsideOfAFootprintReachesIt) {
  std::erase_if(cloud.positions, [](const auto& p) {
    return p.x() < kEast + 1 || p.x() > kEast + 9 || p.y() < kNorth + 1 || p.y() > kNorth + 7;
  });
  cloud.normals.clear();
  EXPECT_EQ(Import().reached, 1u);
}

TEST_F(ImportScanTest, ReplacesNoPosesOfPhotos) {
  town = fake.survey;
  EXPECT_THAT(Refusal().what(), HasSubstr("has photos"));
}

}  // namespace
}  // namespace stucco
