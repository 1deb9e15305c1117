// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/internal/map_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "survey/coordinate_system.h"
#include "survey/error.h"

namespace stucco {
namespace {

constexpr double kLatitude_deg = 52, kLongitude_deg = 4;

// Two cameras at places on the earth, 30 above zero, looking along the second axis of the map with
// its third one up; and a point 100 ahead of the first.
Reconstruction OnMap(const std::string& crs, double metre) {
  Reconstruction model;
  const std::vector<Geodetic> places = {{kLatitude_deg, kLongitude_deg},
                                        {kLatitude_deg + 0.001, kLongitude_deg + 0.002}};
  const auto at = CrsFromGeodetic(crs, places, "test");
  Eigen::Matrix3d rotation;
  rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  for (uint32_t i = 0; i < 2; ++i) {
    RegisteredImage& photo = model.photos[PhotoId{i + 1}];
    photo.id = PhotoId{i + 1};
    photo.cam_from_world.rotation = Eigen::Quaterniond(rotation);
    photo.cam_from_world.translation = -(rotation * Eigen::Vector3d(at[i].x(), at[i].y(), 30));
  }
  TrackPoint& point = model.points[PointId{1}];
  point.id = PointId{1};
  point.position = {at[0].x(), at[0].y() + 100 * metre, 30};
  return model;
}

Eigen::Vector3d PlaceOf(const Georef& georef, const RegisteredImage& photo) {
  return GeodeticFromEnu(georef, photo.cam_from_world.Center());
}

TEST(MapFrame, CamerasKeepTheirPlacesOnTheEarth) {
  for (const char* crs :
       {"EPSG:32631", "EPSG:4326", "EPSG:28992", "EPSG:4326+5773", "EPSG:32631+5773"}) {
    Reconstruction model = OnMap(crs, 0);
    const Georef georef = MoveFromMap(crs, "block.xml", model);
    EXPECT_EQ(georef.frame, "enu") << crs;
    EXPECT_EQ(georef.source, "file");
    EXPECT_NEAR(georef.origin_latitude_deg, kLatitude_deg + 0.0005, 1e-8) << crs;
    EXPECT_NEAR(georef.origin_height_m, 30, 1e-9);
    const Eigen::Vector3d second = PlaceOf(georef, model.photos.at(PhotoId{2}));
    EXPECT_NEAR(second[0], kLatitude_deg + 0.001, 1e-8) << crs;  // a millimetre
    EXPECT_NEAR(second[1], kLongitude_deg + 0.002, 1e-8) << crs;
    EXPECT_NEAR(second[2], 30, 1e-3) << crs;
  }
}

// The azimuth of a transverse Mercator map's north is its convergence, atan(tan(longitude from the
// central meridian) sin(latitude)); its scale there is close to k0 (1 + e^2 / 2).
TEST(MapFrame, ConvergenceAndScaleOfTheMapLeaveNothingBehind) {
  Reconstruction model = OnMap("EPSG:32631", 1);
  const Georef georef = MoveFromMap("EPSG:32631", "block.xml", model);
  const double from_meridian = (kLongitude_deg - 3) * std::numbers::pi / 180;
  const double convergence =
      std::atan(std::tan(from_meridian) * std::sin(kLatitude_deg * std::numbers::pi / 180));
  const Pose& pose = model.photos.at(PhotoId{1}).cam_from_world;
  const Eigen::Vector3d looks = pose.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::atan2(looks.x(), looks.y()), convergence, 1e-4);
  const Eigen::Vector3d ahead = pose * model.points.at(PointId{1}).position;
  const double offset = 6.38e6 * from_meridian * std::cos(kLatitude_deg * std::numbers::pi / 180);
  const double scale = 0.9996 * (1 + std::pow(offset / 6.38e6, 2) / 2);
  EXPECT_NEAR(ahead.z(), 100 / scale, 2e-3);
  EXPECT_NEAR(ahead.x(), 0, 2e-3);  // what the camera sees stays where it was
  EXPECT_NEAR(ahead.y(), 0, 2e-3);
}

TEST(MapFrame, DirectionsOfLongitudeAndLatitudeAreEastAndNorth) {
  Reconstruction model = OnMap("EPSG:4326", 1e-5);
  MoveFromMap("EPSG:4326", "block.xml", model);
  const Pose& pose = model.photos.at(PhotoId{1}).cam_from_world;
  const Eigen::Vector3d looks = pose.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  // The meridians meet: 0.001 degrees west of the middle, by sin(latitude) of that.
  EXPECT_NEAR(std::atan2(looks.x(), looks.y()), 0.001 * std::numbers::pi / 180 * std::sin(0.9076),
              1e-7);
  EXPECT_NEAR((pose * model.points.at(PointId{1}).position).z(), 111.26, 0.01);
}

TEST(MapFrame, RefusesMapsThatPointNowhere) {
  Reconstruction model = OnMap("EPSG:32631", 0);
  const auto refusal = [&](const std::string& crs) {
    try {
      MoveFromMap(crs, "block.xml", model);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
      EXPECT_THAT(e.remedy(), testing::HasSubstr("export it in"));
      return std::string(e.what());
    }
    return std::string("was not refused");
  };
  EXPECT_THAT(refusal("EPSG:99999999"), testing::HasSubstr("block.xml: its coordinate system"));
  EXPECT_THAT(refusal("EPSG:4326"), testing::HasSubstr("has no place in its coordinate system"));
}

}  // namespace
}  // namespace stucco
