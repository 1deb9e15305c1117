// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/run_proxy.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/proxy.h"
#include "survey/survey_folder.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// A survey folder with the inputs of the stage, removed at the end.
class RunProxyTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(::testing::TempDir()) / (std::string("stucco_proxy_") + info->name());
    fs::remove_all(root_);
    fs::create_directories(root_ / "dense");
    fs::create_directories(root_ / "calib");
    fs::create_directories(root_ / "out");
    context_.survey = root_;
    context_.out = root_ / "out";
    context_.progress = &SilentProgress();
    context_.units = &NoUnits();
  }
  void TearDown() override { fs::remove_all(root_); }

  void WriteSurvey(const test::Captured& captured) {
    WritePly(captured.cloud, root_ / kCloudFile);
    Georef georef;
    georef.frame = "enu";
    georef.metric = true;
    georef.up = Eigen::Vector3d::UnitZ();
    georef.source = "gps";
    WriteGeoref(georef, root_ / kGeorefFile);
    Reconstruction reconstruction;
    Camera camera{.id = {1}, .width_px = 100, .height_px = 80, .params = {90, 90, 50, 40}};
    reconstruction.cameras[camera.id] = camera;
    for (const SurveyPhoto& photo : captured.photos) {
      reconstruction.photos[photo.id] = {
          photo.id, camera.id, photo.path(), photo.cam_from_world, {}};
    }
    WriteColmapBinary(reconstruction, root_ / kSparseFolder);
  }

  fs::path root_;
  StageContext context_;
};

TEST_F(RunProxyTest, WritesTheModelInThreeFormats) {
  WriteSurvey(test::Capture({test::GableHouse()}, {test::GroundSquare(20)},
                            {.spacing = 0.15, .noise = 0.02}));
  RunProxy({}, context_);
  const Proxy proxy = ReadProxy(root_ / "out/facets.json");
  ASSERT_EQ(proxy.buildings.size(), 2u);
  EXPECT_TRUE(proxy.buildings[0].watertight);
  EXPECT_EQ(proxy.buildings[0].facets.size(), 7u);
  const auto city = nlohmann::json::parse(ReadFile(root_ / "out/proxy.city.json"));
  EXPECT_EQ(city["CityObjects"]["C0001-1"]["geometry"][0]["type"], "Solid");
  EXPECT_NE(ReadFile(root_ / "out/proxy.obj").find("g C0001_W00"), std::string::npos);
}

TEST_F(RunProxyTest, WritesTheSameBytesAgain) {
  WriteSurvey(test::Capture({test::GableHouse()}, {test::GroundSquare(20)},
                            {.spacing = 0.2, .noise = 0.03, .outliers = 0.1}));
  RunProxy({}, context_);
  StageContext again = context_;
  again.threads = 3;
  again.out = root_ / "again";
  fs::create_directories(again.out);
  RunProxy({}, again);
  for (const char* file : {"facets.json", "proxy.obj", "proxy.city.json"}) {
    EXPECT_EQ(ReadFile(context_.out / file), ReadFile(again.out / file)) << file;
  }
}

TEST_F(RunProxyTest, NamesAMissingCloud) {
  try {
    RunProxy({}, context_);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_NE(std::string(error.what()).find("cloud.ply"), std::string::npos);
  }
}

TEST(ProxyOptionsTable, ValuesAreCheckedAndNamesSuggested) {
  ProxyOptions options;
  OptionTable table("proxy");
  Describe(table, options);
  EXPECT_TRUE(SetOptionFromText(table, "level_of_detail", "0.5").empty());
  EXPECT_EQ(options.level_of_detail, 0.5);
  EXPECT_FALSE(SetOptionFromText(table, "level_of_detail", "-1").empty());
  EXPECT_FALSE(SetOptionFromText(table, "solid_support", "1.5").empty());
  EXPECT_EQ(table.Suggestion("max_plane"), "max_planes");
}

TEST(PointsWithin, HoldToTheMemoryLimit) {
  EXPECT_EQ(PointsWithin(uint64_t{4} << 30, 2000000), 2000000);
  EXPECT_EQ(PointsWithin(uint64_t{1} << 30, 2000000), 1342177);
  EXPECT_EQ(PointsWithin(1, 2000000), 100000);
  EXPECT_EQ(PointsWithin(uint64_t{1} << 40, 5000), 5000);
}

}  // namespace
}  // namespace stucco
