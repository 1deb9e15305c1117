// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// KML and GeoJSON, read back by GDAL.
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <map>
#include <memory>

#include "plan/mission/kml.h"
#include "survey/files.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

using test::TemporaryFolder;

struct Read {
  std::string name;
  std::map<std::string, std::string> fields;
  std::string geometry;
  std::vector<Eigen::Vector3d> points;  // x, y in the frame of the plan, height
  int rings = 0;
};

void AddPoints(const Plan& plan, const OGRSimpleCurve& curve, std::vector<Eigen::Vector3d>& all) {
  for (int i = 0; i < curve.getNumPoints(); ++i) {
    const Eigen::Vector2d p = test::PlanFromLonLat(plan, curve.getX(i), curve.getY(i));
    all.emplace_back(p.x(), p.y(), curve.getZ(i));
  }
}

Read ReadFeature(const Plan& plan, OGRFeature& feature) {
  Read read;
  for (int i = 0; i < feature.GetFieldCount(); ++i) {
    if (!feature.IsFieldSetAndNotNull(i)) continue;
    read.fields[feature.GetFieldDefnRef(i)->GetNameRef()] = feature.GetFieldAsString(i);
  }
  read.name = read.fields.contains("Name") ? read.fields["Name"] : read.fields["id"];
  OGRGeometry* geometry = feature.GetGeometryRef();
  if (geometry == nullptr) return read;
  read.geometry = geometry->getGeometryName();
  if (read.geometry == "POINT") {
    const OGRPoint* point = geometry->toPoint();
    const Eigen::Vector2d p = test::PlanFromLonLat(plan, point->getX(), point->getY());
    read.points.emplace_back(p.x(), p.y(), point->getZ());
  } else if (read.geometry == "LINESTRING") {
    AddPoints(plan, *geometry->toLineString(), read.points);
  } else if (read.geometry == "POLYGON") {
    AddPoints(plan, *geometry->toPolygon()->getExteriorRing(), read.points);
    read.rings = 1 + geometry->toPolygon()->getNumInteriorRings();
  }
  return read;
}

std::vector<Read> ReadAll(const Plan& plan, const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  WriteFile(folder / name, text);
  GDALAllRegister();
  const std::unique_ptr<GDALDataset> data(
      GDALDataset::Open((folder / name).c_str(), GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR));
  std::vector<Read> features;
  EXPECT_TRUE(data);
  if (!data) return features;
  for (int i = 0; i < data->GetLayerCount(); ++i) {
    for (const auto& feature : data->GetLayer(i)) {
      features.push_back(ReadFeature(plan, *feature));
    }
  }
  return features;
}

const Read* Find(const std::vector<Read>& features, const std::string& name) {
  for (const Read& feature : features) {
    if (feature.name == name) return &feature;
  }
  ADD_FAILURE() << name << " is not in the file";
  return nullptr;
}

void ExpectPoint(const Eigen::Vector3d& read, const Eigen::Vector3d& wanted) {
  EXPECT_LT((read - wanted).norm(), 0.01) << read.transpose() << " is not " << wanted.transpose();
}

TEST(Kml, HoldsEveryView) {
  const Plan plan = test::MakePlan();
  const auto features = ReadAll(plan, "plan.kml", PlanKml(plan));
  for (const PlannedView& view : plan.views) {
    const Read* read = Find(features, view.id);
    ASSERT_NE(read, nullptr);
    ASSERT_EQ(read->geometry, "POINT");
    ExpectPoint(read->points[0], view.position_m);
    if (!read->fields.contains("heading")) continue;  // GDAL's smaller driver leaves them out
    EXPECT_NEAR(std::stod(read->fields.at("heading")), view.yaw_deg, 0.01);
    EXPECT_NEAR(std::stod(read->fields.at("pitch")), view.pitch_deg, 0.01);
  }
}

TEST(Kml, HoldsPathsWallsAndBuildings) {
  const Plan plan = test::MakePlan();
  const auto features = ReadAll(plan, "plan.kml", PlanKml(plan));
  const Read* path = Find(features, "Path of flight 1");
  ASSERT_NE(path, nullptr);
  ASSERT_EQ(path->points.size(), plan.flights[0].waypoints.size());
  for (size_t i = 0; i < path->points.size(); ++i) {
    ExpectPoint(path->points[i], plan.flights[0].waypoints[i].position_m);
  }
  const Read* wall = Find(features, "B0001/F00");
  ASSERT_NE(wall, nullptr);
  ASSERT_EQ(wall->points.size(), 5u);
  ExpectPoint(wall->points[0], {0, 0, 0});
  ExpectPoint(wall->points[2], {40, 0, 12});
  const Read* building = Find(features, "B0001");
  ASSERT_NE(building, nullptr);
  EXPECT_EQ(building->rings, 2);
  EXPECT_NE(Find(features, "B<2>&"), nullptr);  // escaped
  EXPECT_NE(Find(features, "No-fly area 1"), nullptr);
  ExpectPoint(Find(features, "Home")->points.at(0), plan.home_m);
}

TEST(Kml, NumbersTheTakeOffPoints) {
  Plan plan = test::MakePlan();
  plan.flights[1].home_m = Eigen::Vector3d(100, -40, 1);
  const auto features = ReadAll(plan, "plan.kml", PlanKml(plan));
  ExpectPoint(Find(features, "Home 1")->points.at(0), plan.home_m);
  ExpectPoint(Find(features, "Home 2")->points.at(0), *plan.flights[1].home_m);
}

TEST(Kml, HeightsAreAbsoluteWhereTheTerrainIsKnown) {
  Plan plan = test::MakePlan();
  EXPECT_NE(PlanKml(plan).find("relativeToGround"), std::string::npos);
  plan.origin.height_m = 200;
  const std::string text = PlanKml(plan);
  EXPECT_EQ(text.find("relativeToGround"), std::string::npos);
  const auto features = ReadAll(plan, "plan.kml", text);
  ExpectPoint(Find(features, "Home")->points.at(0), plan.home_m + Eigen::Vector3d(0, 0, 200));
}

TEST(GeoJson, HoldsEveryLayer) {
  const Plan plan = test::MakePlan();
  const auto features = ReadAll(plan, "plan.geojson", PlanGeoJson(plan));
  std::map<std::string, int> layers;
  for (const Read& feature : features) ++layers[feature.fields.at("layer")];
  const std::map<std::string, int> wanted = {{"facade", 8}, {"footprint", 2}, {"home", 1},
                                             {"hover", 3},  {"no_fly", 1},    {"path", 2},
                                             {"view", 9}};
  EXPECT_EQ(layers, wanted);
}

TEST(GeoJson, HoldsEveryViewAndFacade) {
  const Plan plan = test::MakePlan();
  const auto features = ReadAll(plan, "plan.geojson", PlanGeoJson(plan));
  for (const PlannedView& view : plan.views) {
    const Read* read = Find(features, view.id);
    ASSERT_NE(read, nullptr);
    ExpectPoint(read->points.at(0), view.position_m);
    EXPECT_NEAR(std::stod(read->fields.at("yaw_deg")), view.yaw_deg, 1e-3);
    EXPECT_NEAR(std::stod(read->fields.at("pitch_deg")), view.pitch_deg, 1e-3);
    EXPECT_EQ(read->fields.at("kind"), Name(view.kind));
  }
  for (const PlannedFacade& facade : plan.facades) {
    const Read* read = Find(features, facade.id);
    ASSERT_NE(read, nullptr);
    ExpectPoint(read->points.at(1), {facade.b_m.x(), facade.b_m.y(), 0});
    EXPECT_NEAR(std::stod(read->fields.at("q")), facade.predicted.sum(), 1e-3);
  }
}

TEST(GeoJson, OfAnEmptyPlanIsAHome) {
  Plan plan;
  plan.origin = {52, 4, 0};
  plan.crs = "+proj=tmerc +lat_0=52 +lon_0=4 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m";
  EXPECT_EQ(ReadAll(plan, "plan.geojson", PlanGeoJson(plan)).size(), 1u);
  EXPECT_EQ(ReadAll(plan, "plan.kml", PlanKml(plan)).size(), 1u);
}

}  // namespace
}  // namespace stucco::plan
