// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "pipeline/engine/fingerprint.h"
#include "pipeline/verbs/export.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/georef.h"
#include "survey/proxy.h"
#include "survey/survey_folder.h"
#include "survey/texture_set.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kStageText[] = "what the stage proxy wrote";

// A survey of one wall, which has a picture.
class ExportCityTest : public testing::Test {
 protected:
  ExportCityTest() {
    for (const char* made : {"calib", "proxy", "texture/textures"}) {
      fs::create_directories(fake.survey / made);
    }
    georef.frame = "enu";
    georef.metric = true;
    georef.origin_latitude_deg = 47.4;
    georef.origin_longitude_deg = 8.5;
    WriteGeoref(georef, fake.survey / kGeorefFile);
    Facet wall;
    wall.id = "B1/W0";
    wall.normal = -Eigen::Vector3d::UnitY();
    wall.outer = {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}};
    Proxy proxy;
    proxy.metric = true;
    proxy.buildings = {
        {.id = "B1", .watertight = false, .source = "map", .detail = {}, .facets = {wall}}};
    WriteProxy(proxy, fake.survey / kFacetsFile);
    WriteFile(fake.survey / "proxy/proxy.city.json", kStageText);
    picture.id = wall.id;
    picture.image = "textures/B1_W0.png";
    picture.width_px = 40;
    picture.height_px = 30;
    picture.metres_per_texel = 0.1;
    picture.origin = {0, 0, 3};
    picture.v_axis = -Eigen::Vector3d::UnitZ();
    WriteFile(fake.survey / "texture/textures/B1_W0.png", "png");
    WriteFile(fake.survey / "texture/textures/B1_R0.png", "of no facet");
    Texture();
  }

  void Texture() {
    TextureSet textures;
    textures.facets = {picture};
    WriteTextureSet(textures, fake.survey / kTexturesFile);
  }
  ExportReport Export(const fs::path& to, bool overwrite = false, const std::string& crs = "") {
    return ExportSurvey(fake.survey, {"cityjson", to, overwrite, crs}, fake.table);
  }
  Error Refused(const fs::path& to) {
    try {
      Export(to);
    } catch (const Error& e) {
      return e;
    }
    return Error(ErrorKind::kInterrupted, "was not refused");
  }

  FakeSurvey fake;
  Georef georef;
  TexturedFacet picture;
  const fs::path folder = fake.root / "deep";
  const fs::path out = folder / "castle.city.json";
};

TEST_F(ExportCityTest, PicturesLieBesideTheFile) {
  const ExportReport report = Export(out);
  EXPECT_THAT(FilesBelow(folder), ElementsAre("castle.city.json", "castle_appearance/B1_W0.png"));
  EXPECT_EQ(report.pictures_folder, folder / "castle_appearance");
  EXPECT_EQ(report.pictures, 1);
  EXPECT_TRUE(report.notes.empty());
  const json city = json::parse(ReadFile(out));
  ASSERT_EQ(city["appearance"]["textures"].size(), 1u);
  const std::string image = city["appearance"]["textures"][0]["image"];
  EXPECT_EQ(ReadFile(folder / image), "png");
}

TEST_F(ExportCityTest, AFolderIsNoFileAndStaysEmpty) {
  fs::create_directories(folder / "castle");
  EXPECT_THAT(Refused(folder / "castle").what(), HasSubstr("is a folder"));
  EXPECT_THAT(FilesBelow(folder), ElementsAre());
}

TEST_F(ExportCityTest, EachFileHasAFolderOfItsOwn) {
  for (const auto& [name, pictures] : std::map<std::string, std::string>{
           {"a.json", "a_appearance"}, {"b", "b_appearance"}, {"c.v2.json", "c.v2_appearance"}}) {
    EXPECT_EQ(Export(folder / name).pictures_folder, folder / pictures);
  }
}

TEST_F(ExportCityTest, ReplacesNeitherFileNorPicturesUnasked) {
  fs::create_directories(folder / "castle_appearance");
  Export(out);  // an empty folder is free
  EXPECT_THAT(Refused(out).remedy(), HasSubstr("--overwrite"));
  WriteFile(fake.survey / "texture/textures/B1_W0.png", "another");
  EXPECT_THAT(Refused(folder / "castle.json").what(), HasSubstr("castle_appearance"));
  EXPECT_FALSE(fs::exists(folder / "castle.json"));
  EXPECT_EQ(ReadFile(folder / "castle_appearance/B1_W0.png"), "png");
  Export(out, true);
  EXPECT_EQ(ReadFile(folder / "castle_appearance/B1_W0.png"), "another");
}

TEST_F(ExportCityTest, WithoutPicturesTheFileIsTheStages) {
  picture.image.clear();
  Texture();
  EXPECT_EQ(Export(out).pictures_folder, fs::path());
  EXPECT_EQ(ReadFile(out), kStageText);
  fs::remove_all(fake.survey / "texture");
  Export(out, true);
  EXPECT_EQ(ReadFile(out), kStageText);
  EXPECT_THAT(FilesBelow(folder), ElementsAre("castle.city.json"));
}

TEST_F(ExportCityTest, AnotherSystemMovesCornersAndNoPicture) {
  Export(out);
  const json here = json::parse(ReadFile(out));
  Export(out, true, "EPSG:25832");
  const json there = json::parse(ReadFile(out));
  EXPECT_NE(there["vertices"], here["vertices"]);
  EXPECT_EQ(there["appearance"], here["appearance"]);
  EXPECT_TRUE(here["CityObjects"]["B1-1"]["geometry"][0].contains("texture"));
  EXPECT_EQ(there["CityObjects"], here["CityObjects"]);
}

TEST_F(ExportCityTest, SaysWhichPicturesAreOfAnEarlierModel) {
  picture.origin.x() += 2;
  Texture();
  const ExportReport report = Export(out);
  EXPECT_THAT(report.notes, ElementsAre(HasSubstr("of an earlier model left out: 1;")));
  EXPECT_THAT(report.notes.front(), HasSubstr("stucco texture "));
  EXPECT_EQ(ReadFile(out), kStageText);
}

TEST_F(ExportCityTest, RefusesWhatCannotBeNamed) {
  EXPECT_EQ(Refused(folder / "\xff.json").kind(), ErrorKind::kUsage);
  fs::remove(fake.survey / "texture/textures/B1_W0.png");
  EXPECT_THAT(Refused(out).what(), HasSubstr("B1_W0.png"));
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace stucco
