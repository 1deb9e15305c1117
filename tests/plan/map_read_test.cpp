// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "plan/map/internal/attributes.h"
#include "plan/map/read_map.h"
#include "plan/map/read_site.h"
#include "plan/map/repairs.h"
#include "survey/files.h"
#include "tests/plan/made_map.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;

TEST(ParseLength, UnderstandsWhatMapsSay) {
  using internal::ParseLength;
  EXPECT_THAT(ParseLength("12"), Optional(12.0));
  EXPECT_THAT(ParseLength(" 12.5 m "), Optional(12.5));
  EXPECT_THAT(ParseLength("12,5"), Optional(12.5));
  EXPECT_THAT(ParseLength("12.5m"), Optional(12.5));
  EXPECT_THAT(ParseLength("40 ft"), Optional(testing::DoubleNear(12.192, 1e-9)));
  EXPECT_THAT(ParseLength("40'"), Optional(testing::DoubleNear(12.192, 1e-9)));
  EXPECT_THAT(ParseLength("39'4\""), Optional(testing::DoubleNear(39 * 0.3048 + 4 * 0.0254, 1e-9)));
  EXPECT_THAT(ParseLength("-3"), Optional(-3.0));
  for (const char* text :
       {"", "tall", "12 km", "12;13", "1.2.3", "12-14", "nan", "inf", "'", "5'x"}) {
    EXPECT_FALSE(ParseLength(text)) << text;
  }
}

TEST(BuildingIds, ComeFromTheMapAndAreUnique) {
  internal::BuildingIds ids;
  EXPECT_EQ(ids.Next("12", 1), "B0012");
  EXPECT_EQ(ids.Next("0007", 2), "B0007");
  EXPECT_EQ(ids.Next("0503100000012345678", 3), "B0503100000012345678");
  EXPECT_EQ(ids.Next("way/12 a", 4), "Bway_12_a");
  EXPECT_EQ(ids.Next("", 5), "B0005");
  EXPECT_EQ(ids.Next("12", 6), "B0012-2");
  EXPECT_EQ(ids.Next("12", 7), "B0012-3");
  EXPECT_EQ(ids.Next("Dům 5", 8), "BD__m_5");  // two bytes of UTF-8
}

TEST(RepairLog, CountsWhatManyBuildingsShare) {
  RepairLog log;
  log.Add("", "layer read");
  for (int i = 0; i < 20; ++i) log.Add(fmt::format("B{}", i), "closed");
  for (int i = 0; i < 21; ++i) log.Add(fmt::format("B{}", i), "repaired");
  const std::vector<std::string> lines = log.Lines();
  ASSERT_EQ(lines.size(), 22u);
  EXPECT_EQ(lines[0], "layer read");
  EXPECT_EQ(lines[20], "B19: closed");
  EXPECT_EQ(lines[21], "21 buildings (B0, B1, B2, ...): repaired");
}

// A house, one with a courtyard, and a neighbour wall to wall with the house.
std::vector<MadeBuilding> Hamlet() {
  const Ring yard = Reversed(Rectangle(60, 10, 80, 30));
  return {
      {{{Rectangle(0, 0, 20, 12)}}, {{"id", "1"}, {"height", "9.5"}, {"building", "yes"}}},
      {{{Rectangle(40, -10, 100, 50), yard}}, {{"id", "2"}, {"height", "15"}, {"building", "yes"}}},
      {{{{{20, 2}, {31, 2}, {31, 12}, {20, 12}}}},
       {{"id", "3"}, {"height", "12"}, {"building", "yes"}}}};
}

// Facades as "length height direction", sorted, with their middle in the frame of kMadePlace.
std::vector<std::string> Described(const Site& site) {
  std::vector<std::string> lines;
  const PlanOrigin made = OriginNear(kMadePlace);
  const auto tenths = [](double x) { return std::round(x * 10) / 10 + 0.0; };
  for (const Facade& facade : site.facades) {
    const Eigen::Vector2d middle =
        PlanFromGeodetic(made, GeodeticFromPlan(site.origin, (facade.a + facade.b) / 2));
    lines.push_back(fmt::format("{:.1f} {:.1f} at {:.1f} {:.1f}", facade.length_m(),
                                facade.z_m.length_m(), tenths(middle.x()), tenths(middle.y())));
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

TEST(ReadMap, EveryFormatGivesTheSameSite) {
  const test::TemporaryFolder folder;
  WriteGeoJson(folder / "map.geojson", Hamlet());
  WriteWithOgr(folder / "map.gpkg", "GPKG", "EPSG:3857", Hamlet());
  WriteWithOgr(folder / "map.shp", "ESRI Shapefile", "EPSG:5514", Hamlet());
  WriteOsm(folder / "map.osm", Hamlet());
  WriteCityJson(folder / "map.city.json", Hamlet());
  const Site expected = ReadSite({.map = folder / "map.geojson"}, {});
  // The party wall is 10 of the house's 12 m; the neighbour rises 2.5 m above it.
  EXPECT_EQ(expected.facades.size(), 3u + 8u + 5u);
  EXPECT_EQ(expected.safe_altitude_m, 25);
  EXPECT_THAT(expected.repairs, ElementsAre());
  for (const char* name : {"map.gpkg", "map.shp", "map.osm", "map.city.json"}) {
    const Site site = ReadSite({.map = folder / name}, {});
    EXPECT_EQ(Described(site), Described(expected)) << name;
    EXPECT_EQ(site.safe_altitude_m, 25) << name;
  }
}

std::vector<std::string> Ids(const RawMap& map) {
  std::vector<std::string> ids;
  for (const MapFeature& feature : map.features) ids.push_back(feature.building);
  return ids;
}

TEST(ReadMap, OsmReadsBuildingsAndTheirPartsOnly) {
  const test::TemporaryFolder folder;
  WriteOsm(folder / "map.osm",
           {{{{Rectangle(0, 0, 20, 10)}}, {{"building", "house"}, {"building:levels", "3"}}},
            {{{Rectangle(0, 0, 10, 10)}},
             {{"building:part", "yes"}, {"height", "30 ft"}, {"min_height", "3"}}},
            {{{Rectangle(50, 0, 70, 10)}}, {{"landuse", "grass"}}},
            {{{Rectangle(80, 0, 90, 10)}}, {{"building", "no"}}},
            {{{Rectangle(0, 50, 40, 90), Reversed(Rectangle(10, 60, 30, 80))}},
             {{"building", "yes"}, {"height", "high"}}}});
  const RawMap map = ReadMap(folder / "map.osm", {});
  // GDAL gives relations first.
  EXPECT_THAT(Ids(map), ElementsAre("BR1", "B0001", "B0002"));
  EXPECT_FALSE(map.features[1].height_m);
  EXPECT_THAT(map.features[1].guessed_height_m, Optional(12.0));
  EXPECT_FALSE(map.features[1].is_part);
  EXPECT_TRUE(map.features[2].is_part);
  EXPECT_THAT(map.features[2].height_m, Optional(testing::DoubleNear(9.144, 1e-9)));
  EXPECT_EQ(map.features[2].min_height_m, 3);
  EXPECT_FALSE(map.features[0].height_m);
  EXPECT_EQ(map.features[0].polygons[0].rings.size(), 2u);
  EXPECT_THAT(map.repairs.Lines(), ElementsAre("BR1: height \"high\" is no length; ignored"));
}

TEST(ReadMap, OsmAsPbf) {
  const test::TemporaryFolder folder;
  std::vector<MadeBuilding> buildings = Hamlet();
  buildings[1].outline.rings.resize(1);
  WriteOsm(folder / "map.osm", buildings);
  WriteOsmPbf(folder / "map.osm.pbf", buildings);
  const Site expected = ReadSite({.map = folder / "map.osm"}, {});
  EXPECT_EQ(expected.facades.size(), 3u + 4u + 5u);
  EXPECT_EQ(Described(ReadSite({.map = folder / "map.osm.pbf"}, {})), Described(expected));
}

TEST(ReadMap, HeightAttributesInTheirOrder) {
  const test::TemporaryFolder folder;
  const Polygon square{{Rectangle(0, 0, 10, 10)}};
  WriteGeoJson(folder / "a.geojson", {{square, {{"hoehe", "7,5"}}},
                                      {square, {{"H", "8"}, {"Height", "9 m"}}},
                                      {square, {{"building:levels", "4"}}},
                                      {square, {{"height", "0"}}},
                                      {square, {{"height", "-4"}}},
                                      {square, {{"height", "0"}, {"building:levels", "2"}}},
                                      {square, {{"height", "20000"}}},
                                      {square, {{"height", "10"}, {"min_height", "12"}}},
                                      {square, {{"roof", "11"}}}});
  const RawMap map = ReadMap(folder / "a.geojson", {});
  EXPECT_THAT(map.features[0].height_m, Optional(7.5));
  EXPECT_THAT(map.features[1].height_m, Optional(9.0));
  EXPECT_FALSE(map.features[2].height_m);
  EXPECT_THAT(map.features[2].guessed_height_m, Optional(16.0));
  EXPECT_FALSE(map.features[3].height_m);
  EXPECT_FALSE(map.features[4].height_m);
  EXPECT_FALSE(map.features[5].height_m);
  EXPECT_THAT(map.features[5].guessed_height_m, Optional(8.0));
  EXPECT_FALSE(map.features[6].height_m);
  EXPECT_THAT(map.features[7].height_m, Optional(10.0));
  EXPECT_EQ(map.features[7].min_height_m, 0);
  EXPECT_FALSE(map.features[8].height_m);
  EXPECT_THAT(map.repairs.Lines(),
              ElementsAre(HasSubstr("-4 m is impossible"), HasSubstr("20000 m is impossible"),
                          HasSubstr("min_height 12 m is impossible")));
  PlanOptions options;
  options.height_field = "roof";
  EXPECT_THAT(ReadMap(folder / "a.geojson", options).features[8].height_m, Optional(11.0));
}

TEST(ReadMap, StoreysAndRoofsAreGuesses) {
  const test::TemporaryFolder folder;
  const Polygon square{{Rectangle(0, 0, 10, 10)}};
  WriteGeoJson(folder / "a.geojson",
               {{square, {{"building:levels", "5"}, {"roof:levels", "1"}}},
                {square, {{"building:levels", "5"}, {"roof:levels", "1"}, {"roof:height", "6 m"}}},
                {square, {{"height", "20"}, {"roof:height", "6"}, {"building:levels", "4"}}},
                {square, {{"height", "5"}, {"roof:height", "6"}}},
                {square, {{"height", "4"}, {"building:levels", "5"}}},
                {square, {{"building:levels", "five"}}},
                {square, {{"building:levels", "6"}, {"building:min_level", "2"}}},
                {square, {{"building:levels", "900"}}}});
  const RawMap map = ReadMap(folder / "a.geojson", {});
  const auto guess = [&](size_t i) { return map.features[i].guessed_height_m; };
  EXPECT_THAT(guess(0), Optional(24.0));  // up to 4 m each
  EXPECT_THAT(guess(1), Optional(26.0));
  EXPECT_THAT(map.features[2].height_m, Optional(20.0));  // the roof is a part of it
  EXPECT_THAT(map.features[3].height_m, Optional(11.0));  // the eaves, as it seems
  EXPECT_FALSE(map.features[4].height_m);
  EXPECT_THAT(guess(4), Optional(20.0));
  EXPECT_FALSE(guess(5));
  EXPECT_THAT(guess(6), Optional(24.0));
  EXPECT_EQ(map.features[6].min_height_m, 6);
  EXPECT_FALSE(guess(7));
  EXPECT_THAT(map.repairs.Lines(), ElementsAre(HasSubstr("4 m is impossible for its storeys")));
  PlanOptions options;
  options.height_field = "height";  // then nothing but it
  EXPECT_FALSE(ReadMap(folder / "a.geojson", options).features[0].guessed_height_m);
}

TEST(ReadMap, OsmHasRoofs) {
  const test::TemporaryFolder folder;
  WriteOsm(folder / "map.osm",
           {{{{Rectangle(0, 0, 20, 10)}},
             {{"building", "yes"}, {"building:levels", "3"}, {"roof:height", "5"}}}});
  EXPECT_THAT(ReadMap(folder / "map.osm", {}).features[0].guessed_height_m, Optional(17.0));
}

TEST(ReadObstacleMap, TakesPointsLinesAndPolygons) {
  const test::TemporaryFolder folder;
  WriteFile(folder / "a.geojson", R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{"height":"12"},"geometry":{"type":"Point","coordinates":[14,50]}},
    {"type":"Feature","properties":{"height":"8","diameter_crown":"10"},
     "geometry":{"type":"MultiPoint","coordinates":[[14,50],[14.001,50]]}},
    {"type":"Feature","properties":{"radius":"0.5"},
     "geometry":{"type":"LineString","coordinates":[[14,50],[14.001,50],[14.001,50.001]]}},
    {"type":"Feature","properties":{"radius":"2"},"geometry":{"type":"Polygon","coordinates":
     [[[14,50],[14.001,50],[14.001,50.001],[14,50]]]}}]})");
  const RawMap map = ReadObstacleMap(folder / "a.geojson");
  ASSERT_EQ(map.features.size(), 4u);
  EXPECT_EQ(map.features[0].radius_m, 3);
  EXPECT_EQ(map.features[0].polygons[0].rings[0].size(), 1u);
  EXPECT_THAT(map.features[0].height_m, Optional(12.0));
  EXPECT_EQ(map.features[1].radius_m, 5);
  EXPECT_EQ(map.features[1].polygons.size(), 2u);
  EXPECT_EQ(map.features[2].radius_m, 0.5);
  EXPECT_EQ(map.features[2].polygons[0].rings[0].size(), 3u);
  EXPECT_FALSE(map.features[2].height_m);
  EXPECT_EQ(map.features[3].radius_m, 0);
  WriteFile(folder / "none.geojson", R"({"type":"FeatureCollection","features":[]})");
  EXPECT_THAT(Complaint([&] { ReadObstacleMap(folder / "none.geojson"); }),
              HasSubstr("leave the option out"));
}

TEST(ReadMap, NamedAttributesAndLayersMustExist) {
  const test::TemporaryFolder folder;
  WriteWithOgr(folder / "a.gpkg", "GPKG", "EPSG:32633", Hamlet());
  PlanOptions options;
  options.id_field = "nummer";
  EXPECT_THAT(Complaint([&] { ReadMap(folder / "a.gpkg", options); }),
              testing::AllOf(HasSubstr("no attribute \"nummer\" (--id-field)"),
                             HasSubstr("give one of building, height, id")));
  options.id_field = "height";
  EXPECT_THAT(Ids(ReadMap(folder / "a.gpkg", options)), ElementsAre("B9_5", "B0015", "B0012"));
  options.map_layer = "houses";
  EXPECT_THAT(Complaint([&] { ReadMap(folder / "a.gpkg", options); }),
              testing::AllOf(HasSubstr("no layer \"houses\""), HasSubstr("give one of buildings")));
}

TEST(ReadMap, WithoutIdsCountsOrUsesTheRowNumbersOfTheFile) {
  const test::TemporaryFolder folder;
  const Polygon square{{Rectangle(0, 0, 10, 10)}};
  WriteGeoJson(folder / "a.geojson", {{square, {}}, {square, {}}});
  EXPECT_THAT(Ids(ReadMap(folder / "a.geojson", {})), ElementsAre("B0001", "B0002"));
  WriteFile(folder / "ids.geojson",
            R"({"type":"FeatureCollection","features":[
               {"type":"Feature","id":205,"properties":{},"geometry":{"type":"Polygon","coordinates":
                 [[[14,50],[14.001,50],[14.001,50.001],[14,50.001],[14,50]]]}},
               {"type":"Feature","id":7,"properties":{},"geometry":{"type":"Polygon","coordinates":
                 [[[14,50],[14.001,50],[14.001,50.001],[14,50.001],[14,50]]]}}]})");
  EXPECT_THAT(Ids(ReadMap(folder / "ids.geojson", {})), ElementsAre("B0205", "B0007"));
  WriteWithOgr(folder / "a.gpkg", "GPKG", "EPSG:32633", {{square, {}}, {square, {}}});
  EXPECT_THAT(Ids(ReadMap(folder / "a.gpkg", {})), ElementsAre("B0001", "B0002"));
}

TEST(ReadMap, SaysWhatIsNoMapOfAreas) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(Complaint([&] { ReadMap(folder / "none.geojson", {}); }),
              HasSubstr("there is no such file"));
  WriteFile(folder / "text.geojson", "hello");
  EXPECT_THAT(Complaint([&] { ReadMap(folder / "text.geojson", {}); }),
              HasSubstr("cannot be read as a map"));
  WriteFile(folder / "empty.geojson", R"({"type":"FeatureCollection","features":[]})");
  EXPECT_THAT(Complaint([&] { ReadMap(folder / "empty.geojson", {}); }), HasSubstr("no polygons"));
  WriteFile(folder / "points.geojson",
            R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},
               "geometry":{"type":"Point","coordinates":[14,50]}}]})");
  EXPECT_THAT(Complaint([&] { ReadMap(folder / "points.geojson", {}); }),
              testing::AllOf(HasSubstr("no polygons"), HasSubstr("not as points or lines")));
  WriteFile(folder / "mixed.geojson",
            R"({"type":"FeatureCollection","features":[
               {"type":"Feature","properties":{},"geometry":null},
               {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[14,50],[14.001,50]]}},
               {"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":
                 [[[14,50,7],[14.001,50,7],[14.001,50.001,7],[14,50.001,8]]]}}]})");
  const RawMap mixed = ReadMap(folder / "mixed.geojson", {});
  ASSERT_EQ(mixed.features.size(), 1u);
  EXPECT_TRUE(mixed.features[0].has_open_ring);
  EXPECT_EQ(mixed.features[0].polygons[0].rings[0].size(), 4u);
  EXPECT_THAT(mixed.repairs.Lines(), ElementsAre("2 features without an area left out"));
}

TEST(ReadMap, DamagedFilesAreRefused) {
  const test::TemporaryFolder folder;
  WriteOsm(folder / "a.osm", Hamlet());
  const std::string text = ReadFile(folder / "a.osm");
  WriteFile(folder / "cut.osm", text.substr(0, text.size() / 2));
  EXPECT_THAT(Complaint([&] { ReadMap(folder / "cut.osm", {}); }), testing::Not(""));
}

// A tower beside a low wing, with an overhang; a bridge is no building.
constexpr char kParts[] = R"({"type":"CityJSON","version":"1.0",
  "metadata":{"referenceSystem":"urn:ogc:def:crs:EPSG::32633"},
  "CityObjects":{
    "house":{"type":"Building","children":["tower","wing","bay"]},
    "tower":{"type":"BuildingPart","parents":["house"],"geometry":[{"type":"MultiSurface","lod":2,
      "boundaries":[[[0,1,2,3]],[[4,5,6,7]]],
      "semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"RoofSurface"}],"values":[0,1]}}]},
    "wing":{"type":"BuildingPart","parents":["house"],"geometry":[{"type":"MultiSurface","lod":1,
      "boundaries":[[[1,8,9,2]],[[10,11,12,13]]]}]},
    "bay":{"type":"BuildingPart","parents":["house"],"geometry":[{"type":"MultiSurface","lod":1,
      "boundaries":[[[14,15,16,17]],[[18,19,20,21]]]}]},
    "over":{"type":"Bridge","geometry":[{"type":"MultiSurface","lod":1,"boundaries":[[[0,1,2,3]]]}]}},
  "vertices":[[457000,5550000,200],[457010,5550000,200],[457010,5550010,200],[457000,5550010,200],
    [457000,5550000,230],[457010,5550000,230],[457010,5550010,230],[457000,5550010,230],
    [457020,5550000,200],[457020,5550010,200],
    [457010,5550000,208],[457020,5550000,208],[457020,5550010,208],[457010,5550010,208],
    [457000,5550010,206],[457010,5550010,206],[457010,5550012,206],[457000,5550012,206],
    [457000,5550010,210],[457010,5550010,210],[457010,5550012,210],[457000,5550012,210]]})";

TEST(ReadCityJson, PartsMakeOneBuilding) {
  const test::TemporaryFolder folder;
  WriteFile(folder / "a.json", kParts);
  const RawMap map = ReadMap(folder / "a.json", {});
  EXPECT_EQ(map.crs, "EPSG:32633");
  EXPECT_THAT(Ids(map), ElementsAre("Bhouse", "Bhouse", "Bhouse"));
  EXPECT_THAT(map.features[0].height_m, Optional(30.0));
  EXPECT_THAT(map.features[1].height_m, Optional(8.0));
  EXPECT_THAT(map.features[2].height_m, Optional(10.0));
  EXPECT_EQ(map.features[0].min_height_m, 0);
  EXPECT_EQ(map.features[2].min_height_m, 6);
  const Site site = ReadSite({.map = folder / "a.json"}, {});
  EXPECT_EQ(site.footprints.size(), 3u);
  bool upper_wall = false;
  for (const Facade& facade : site.facades) {
    upper_wall = upper_wall || facade.z_m == Interval{8, 30};
  }
  EXPECT_TRUE(upper_wall);
}

TEST(ReadCityJson, MeasuredHeightUnlessItIsAnElevation) {
  const test::TemporaryFolder folder;
  const auto with = [&](const std::string& height) {
    std::string text = kParts;
    const std::string parts = "\"children\":[\"tower\",\"wing\",\"bay\"]";
    text.replace(
        text.find(parts), parts.size(),
        fmt::format("\"children\":[\"tower\"],\"attributes\":{{\"measuredHeight\":{}}}", height));
    WriteFile(folder / "b.json", text);
    return ReadMap(folder / "b.json", {});
  };
  EXPECT_THAT(with("31.5").features[0].height_m, Optional(31.5));
  EXPECT_THAT(with("\"31.5\"").features[0].height_m, Optional(31.5));
  EXPECT_THAT(with("28.5").features[0].height_m, Optional(30.0));  // the geometry is higher
  EXPECT_THAT(with("230").features[0].height_m, Optional(30.0));
  EXPECT_THAT(with("230").repairs.Lines(), ElementsAre(HasSubstr("elevation of the roof")));
  EXPECT_THAT(with("null").features[0].height_m, Optional(30.0));
}

// As in 3D BAG: elevations, of the ground and of shares of the points on the roof.
TEST(ReadCityJson, TakesTheHighestOfTheHeights) {
  const test::TemporaryFolder folder;
  const auto heights = [&](const std::string& attributes) {
    std::string text = kParts;
    const std::string house = "\"house\":{";
    text.replace(text.find(house), house.size(), house + "\"attributes\":{" + attributes + "},");
    WriteFile(folder / "b.json", text);
    const RawMap map = ReadMap(folder / "b.json", {});
    return std::vector{*map.features[0].height_m, *map.features[1].height_m};
  };
  EXPECT_THAT(heights(R"("b3_h_dak_max":233.5,"b3_h_dak_70p":231,"b3_h_maaiveld":199)"),
              ElementsAre(34.5, 8));  // the tower is what is highest
  EXPECT_THAT(heights(R"("b3_h_roof_70p":232,"b3_h_ground":200)"), ElementsAre(32, 8));
  EXPECT_THAT(heights(R"("b3_h_max":231.5)"), ElementsAre(31.5, 8));
  EXPECT_THAT(heights(R"("b3_h_70p":212,"b3_h_dak_max":null)"), ElementsAre(30, 8));
}

TEST(ReadCityJson, RefusesWhatIsNone) {
  const test::TemporaryFolder folder;
  const auto complaint = [&](const std::string& text) {
    WriteFile(folder / "c.json", text);
    return Complaint([&] { ReadMap(folder / "c.json", {}); });
  };
  EXPECT_THAT(complaint(R"({"type":"CityJSON")"), HasSubstr("is no CityJSON"));
  EXPECT_THAT(complaint(R"({"type":"CityJSON"})"), HasSubstr("is no CityJSON"));
  EXPECT_THAT(complaint(R"({"type":"CityJSON","CityObjects":{},"vertices":[]})"),
              HasSubstr("has no buildings"));
  EXPECT_THAT(complaint(R"({"type":"CityJSON","CityObjects":{"a":{"type":"Building","geometry":[
                  {"type":"MultiSurface","lod":"1","boundaries":[[[0,1,9]]]}]}},
                  "vertices":[[0,0,0],[1,0,0]]})"),
              HasSubstr("names vertex 9 of 2"));
}

}  // namespace
}  // namespace stucco::plan
