// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pipeline/default_stages.h"
#include "pipeline/engine/fingerprint.h"
#include "survey/colmap_io.h"
#include "survey/coordinate_system.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/georef.h"
#include "survey/image.h"
#include "survey/proxy.h"
#include "survey/survey_folder.h"
#include "survey/texture_set.h"
#include "tests/pipeline/fake_survey.h"
#include "tests/pipeline/verbs/imported.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class ExportTest : public testing::Test {
 protected:
  void Write(const std::string& file, const std::string& text) {
    fs::create_directories((fake.survey / file).parent_path());
    WriteFile(fake.survey / file, text);
  }
  void Export(const std::string& format, bool overwrite = false) {
    ExportSurvey(fake.survey, {format, out, overwrite}, fake.table);
  }
  Error Refused(const std::string& format) {
    try {
      Export(format);
    } catch (const Error& e) {
      return e;
    }
    return Error(ErrorKind::kInterrupted, "was not refused");
  }

  FakeSurvey fake;
  const fs::path out = fake.root / "deep/out";
};

TEST_F(ExportTest, EveryFormatSaysWhatHasToRunFirst) {
  for (const ExportFormat& format : ExportFormats()) {
    const Error error = Refused(format.name);
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput) << format.name;
    EXPECT_THAT(error.remedy(), HasSubstr("stucco " + format.stage + " ")) << format.name;
    EXPECT_FALSE(fs::exists(out)) << format.name;
  }
}

TEST_F(ExportTest, FilesAreCopiedAndNeverReplacedUnasked) {
  Write("texture/model.glb", "first");
  Export("glb");
  EXPECT_EQ(ReadFile(out), "first");
  Write("texture/model.glb", "second");
  EXPECT_THAT(Refused("glb").remedy(), HasSubstr("--overwrite"));
  EXPECT_EQ(ReadFile(out), "first");
  Export("glb", true);
  EXPECT_EQ(ReadFile(out), "second");
}

TEST_F(ExportTest, AnObjComesWithItsMaterialsAndPicturesAlone) {
  Write("texture/model.obj", "mtllib model.mtl");
  Write("texture/model.mtl", "map_Kd textures/a.png");
  Write("texture/textures/a.png", "png");
  Write("texture/orthophotos/a.png", "another");
  fs::create_directories(out);  // an empty folder is free
  Export("obj");
  EXPECT_THAT(FilesBelow(out), ElementsAre("model.mtl", "model.obj", "textures/a.png"));
  EXPECT_THAT(Refused("obj").what(), HasSubstr("exists already"));
}

TEST_F(ExportTest, PosesComeBackAsTheyWere) {
  WriteModel(fake.root / "model", {"p1.jpg", "p2.jpg"}, 16, 8);
  Georef georef;
  georef.frame = "enu";
  georef.metric = true;
  georef.origin_latitude_deg = 52;
  georef.origin_longitude_deg = 4;
  WriteGeoref(georef, fake.root / "model/georef.json");
  ImportInto(fake, fake.root / "model");
  const Reconstruction before = ReadColmapModel(fake.survey / kSparseFolder);
  for (const char* format : {"blocksexchange", "colmap-txt", "colmap-bin"}) {
    Export(format, true);
    EXPECT_EQ(ImportInto(fake, out).frame, "enu") << format;
    EXPECT_EQ(ReadGeoref(fake.survey / kGeorefFile).origin_latitude_deg, 52) << format;
    const Reconstruction after = ReadColmapModel(fake.survey / kSparseFolder);
    EXPECT_LT(
        (before.points.begin()->second.position - after.points.begin()->second.position).norm(),
        1e-9)
        << format;
    for (const auto& [id, photo] : before.photos) {
      EXPECT_EQ(photo.name, after.photos.at(id).name);
      EXPECT_LT(
          (photo.cam_from_world.Center() - after.photos.at(id).cam_from_world.Center()).norm(),
          1e-9)
          << format;
    }
    fs::remove_all(out);
  }
  Export("nerfstudio");
  EXPECT_THAT(FilesBelow(out), ElementsAre("georef.json", "sparse_pc.ply", "transforms.json"));
  EXPECT_THAT(ReadFile(out / "transforms.json"), HasSubstr("\"../../photos/p1.jpg\""));
}

TEST_F(ExportTest, CityJsonLiesWhereItsSystemSays) {
  Georef georef;
  georef.frame = "enu";
  georef.metric = true;
  georef.origin_latitude_deg = 47.4;
  georef.origin_longitude_deg = 8.5;
  georef.origin_height_m = 400;
  Proxy proxy;
  proxy.up = -Eigen::Vector3d::UnitY();  // the file is turned so that this is z
  fs::create_directories(fake.survey / "calib");
  fs::create_directories(fake.survey / "proxy");
  WriteGeoref(georef, fake.survey / kGeorefFile);
  WriteProxy(proxy, fake.survey / kFacetsFile);
  const std::string text =
      R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],)"
      R"("translate":[10,20,30]},"metadata":{"title":"local"},"CityObjects":{"B1":)"
      R"({"type":"Building","attributes":{"detail":"full"}}},"vertices":[[0,0,0],[1500,-2500,1]]})";
  Write("proxy/proxy.city.json", text);
  Export("cityjson");
  EXPECT_EQ(ReadFile(out), text);
  ExportSurvey(fake.survey, {"cityjson", out, true, "EPSG:25832"}, fake.table);
  const auto city = nlohmann::json::parse(ReadFile(out));
  EXPECT_EQ(city["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/25832");
  EXPECT_EQ(city["CityObjects"]["B1"]["attributes"]["detail"], "full");
  // (11.5, 17.5, 30.001) of the file is (11.5, -30.001, 17.5) of the survey.
  Eigen::Vector3d corner;
  for (int i = 0; i < 3; ++i) {
    corner[i] = city["vertices"][1][i].get<double>() * city["transform"]["scale"][i].get<double>() +
                city["transform"]["translate"][i].get<double>();
  }
  const std::vector<Eigen::Vector2d> in_map = {corner.head<2>()};
  const Geodetic place = GeodeticFromCrs("EPSG:25832", in_map, "test").front();
  const Eigen::Vector3d back =
      EnuFromGeodetic(georef, place.latitude_deg, place.longitude_deg, corner.z());
  EXPECT_LT((back - Eigen::Vector3d(11.5, -30.001, 17.5)).norm(), 2e-4);
}

TEST_F(ExportTest, RefusesSystemsThatNoModelIsWrittenIn) {
  const auto refusal = [&](const std::string& format, const std::string& crs) {
    try {
      ExportSurvey(fake.survey, {format, out, false, crs}, fake.table);
    } catch (const Error& e) {
      EXPECT_FALSE(fs::exists(out));
      return e;
    }
    return Error(ErrorKind::kInterrupted, "was not refused");
  };
  fs::create_directories(fake.survey / "calib");
  Write("proxy/proxy.city.json", "{}");
  WriteGeoref({}, fake.survey / kGeorefFile);
  WriteProxy({}, fake.survey / kFacetsFile);
  EXPECT_EQ(refusal("cityjson", "EPSG:4326").kind(), ErrorKind::kUsage);
  EXPECT_EQ(refusal("cityjson", "/etc/passwd").kind(), ErrorKind::kUsage);
  EXPECT_THAT(refusal("cityjson", "EPSG:2056").what(), HasSubstr("no positions"));
  EXPECT_THAT(refusal("glb", "EPSG:2056").what(), HasSubstr("no choice for glb"));
}

// A survey of one wall without a picture, and an epoch that shows it.
class ExportEpochTest : public ExportTest {
 protected:
  ExportEpochTest() {
    Facet wall;
    wall.id = "B1/W0";
    wall.normal = -Eigen::Vector3d::UnitY();
    wall.outer = {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}};
    Proxy proxy;
    proxy.buildings = {
        {.id = "B1", .watertight = false, .source = "map", .detail = {}, .facets = {wall}}};
    fs::create_directories(fake.survey / "proxy");
    WriteProxy(proxy, fake.survey / kFacetsFile);
    Write("proxy/proxy.city.json", "{}");
    TextureSet textures;
    TexturedFacet& facet = textures.facets.emplace_back();
    facet.id = wall.id;
    facet.width_px = 40;
    facet.height_px = 30;
    facet.metres_per_texel = 0.1;
    facet.origin = {0, 0, 3};
    facet.v_axis = -Eigen::Vector3d::UnitZ();
    for (const char* model : {"model.glb", "model.obj", "model.mtl"}) {
      Write(std::string("texture/") + model, "own");
      Write(std::string("epochs/later/") + model, "later");
    }
    WriteTextureSet(textures, fake.survey / kTexturesFile);
    facet.image = "textures/B1_W0.png";
    WriteTextureSet(textures, fake.survey / "epochs/later/textures.json");
    fs::create_directories(fake.survey / "epochs/later/textures");
    WriteImage({40, 30, 3, std::vector<uint8_t>(3600, 90)},
               fake.survey / "epochs/later/textures/B1_W0.png");
  }

  void ExportEpoch(const std::string& format, const std::string& epoch) {
    ExportSurvey(fake.survey, {format, out, true, "", epoch}, DefaultStages());
  }
};

TEST_F(ExportEpochTest, AGlbHasEpochsAsVariants) {
  ExportEpoch("glb", "");
  EXPECT_THAT(ReadFile(out),
              HasSubstr("\"variants\":[{\"name\":\"survey\"},{\"name\":\"later\"}]"));
  ExportEpoch("glb", "later");
  EXPECT_EQ(ReadFile(out), "later");
}

TEST_F(ExportEpochTest, ACityModelHasEpochsAsThemes) {
  Export("cityjson");
  auto texture = [&] {
    const auto city = nlohmann::json::parse(ReadFile(out));
    return city["CityObjects"]["B1-1"]["geometry"][0]["texture"];
  };
  EXPECT_TRUE(texture().contains("later"));
  EXPECT_FALSE(texture().contains("survey"));
  EXPECT_TRUE(fs::exists(fake.root / "deep/out_appearance/later/B1_W0.png"));
  ExportEpoch("cityjson", "later");
  EXPECT_TRUE(fs::exists(fake.root / "deep/out_appearance/B1_W0.png"));
}

TEST_F(ExportEpochTest, OneEpochAloneInOtherFormats) {
  ExportEpoch("obj", "later");
  EXPECT_EQ(ReadFile(out / "model.obj"), "later");
  fs::remove_all(out);
  ExportEpoch("3dtiles", "later");
  EXPECT_THAT(ReadFile(out / "tiles/r.glb"), HasSubstr("image/jpeg"));
}

TEST_F(ExportEpochTest, AnUnknownEpochOrAFormatWithoutIsRefused) {
  EXPECT_THROW(ExportEpoch("glb", "sooner"), Error);
  EXPECT_THROW(ExportEpoch("cityjson", "sooner"), Error);
  try {
    ExportEpoch("ply", "later");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
  }
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(ExportTest, AnUnknownFormatGetsASuggestion) {
  EXPECT_EQ(Refused("gltf").kind(), ErrorKind::kUsage);
  EXPECT_THAT(Refused("gltf").remedy(), HasSubstr("did you mean glb?"));
  EXPECT_THAT(Refused("collada").remedy(),
              HasSubstr("colmap-txt, colmap-bin, blocksexchange, nerfstudio, obj"));
}

}  // namespace
}  // namespace stucco
