// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/city_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "survey/error.h"
#include "survey/files.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kVertices[] =
    R"("transform": {"scale": [0.5, 0.5, 0.5], "translate": [100, 200, 10]},
       "vertices": [[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])";

std::filesystem::path WriteCity(const std::string& objects, const std::string& more = "") {
  const auto path = std::filesystem::path(testing::TempDir()) / "city_model.city.json";
  WriteFile(path, R"({"type": "CityJSON", "version": "2.0", )" + more + std::string(kVertices) +
                      R"(, "CityObjects": {)" + objects + "}}");
  return path;
}

TEST(CityModel, MovesVerticesAndReadsTheCoordinateSystem) {
  const CityModel url = ReadCityModel(WriteCity(
      "", R"("metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/7415"}, )"));
  EXPECT_EQ(url.crs, "EPSG:7415");
  EXPECT_EQ(url.vertices[1], Eigen::Vector3d(102, 200, 10));
  EXPECT_EQ(url.vertices[3], Eigen::Vector3d(100, 200, 12));
  EXPECT_EQ(ReadCityModel(WriteCity("", R"("metadata": {"referenceSystem":
      "urn:ogc:def:crs:EPSG::2056"}, )"))
                .crs,
            "EPSG:2056");
  EXPECT_EQ(ReadCityModel(WriteCity("")).crs, "");
}

TEST(CityModel, TakesTheMostDetailedGeometryWithWhatItsSurfacesAre) {
  const CityModel city = ReadCityModel(WriteCity(R"(
    "part": {"type": "BuildingPart", "parents": ["house"], "geometry": [
      {"type": "MultiSurface", "lod": "1.2", "boundaries": [[[0, 1, 2]]]},
      {"type": "Solid", "lod": "2.2", "boundaries": [[[[0, 2, 1]], [[0, 1, 3]], [[1, 2, 3]]]],
       "semantics": {"surfaces": [{"type": "WallSurface", "id": "house/W00"},
                                  {"type": "GroundSurface"}], "values": [[1, 0, null]]}},
      {"type": "GeometryInstance", "template": 0}]},
    "house": {"type": "Building", "children": ["part"]})"));
  ASSERT_EQ(city.objects.size(), 2u);  // in the order of the file
  const CityObject& part = city.objects[0];
  EXPECT_EQ(part.id, "part");
  EXPECT_THAT(part.parents, ElementsAre("house"));
  EXPECT_EQ(part.lod, 2.2);
  ASSERT_EQ(part.surfaces.size(), 3u);
  EXPECT_EQ(part.surfaces[0].type, "GroundSurface");
  EXPECT_EQ(part.surfaces[1].id, "house/W00");
  EXPECT_THAT(part.surfaces[1].rings, ElementsAre(ElementsAre(0, 1, 3)));
  EXPECT_EQ(part.surfaces[2].type, "");
  EXPECT_TRUE(city.objects[1].surfaces.empty());
}

TEST(CityModel, RefusesWhatIsDamaged) {
  const auto refusal = [](const std::filesystem::path& path) -> std::string {
    try {
      ReadCityModel(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      return error.what();
    }
    return "was not refused";
  };
  EXPECT_THAT(refusal(WriteCity(R"("house": {"type": "Building", "geometry": [
      {"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, 4]]]}]})")),
              HasSubstr("house names vertex 4 of 4"));
  const auto cut = WriteCity("");
  WriteFile(cut, ReadFile(cut).substr(0, 60));
  EXPECT_THAT(refusal(cut), HasSubstr("is no CityJSON"));
}

}  // namespace
}  // namespace stucco
