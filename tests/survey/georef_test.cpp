// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/georef.h"

#include <gtest/gtest.h>

#include <cmath>

#include "survey/files.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

using test::ExpectBadInput;
using test::TemporaryFolder;

constexpr double kSemiMajor_m = 6378137.0;
constexpr double kSemiMinor_m = 6356752.314245179;

Georef At(double latitude_deg, double longitude_deg, double height_m) {
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = latitude_deg;
  georef.origin_longitude_deg = longitude_deg;
  georef.origin_height_m = height_m;
  georef.metric = true;
  return georef;
}

void ExpectNear(const Eigen::Vector3d& actual, const Eigen::Vector3d& expected, double tolerance) {
  EXPECT_LT((actual - expected).norm(), tolerance) << actual.transpose();
}

TEST(Georef, AgreesWithTheGeometryOfTheEllipsoid) {
  const Georef origin = At(0, 0, 0);
  ExpectNear(EnuFromGeodetic(origin, 0, 0, 0), {0, 0, 0}, 1e-9);
  ExpectNear(EnuFromGeodetic(origin, 0, 0, 100), {0, 0, 100}, 1e-9);
  ExpectNear(EnuFromGeodetic(origin, 0, 90, 0), {kSemiMajor_m, 0, -kSemiMajor_m}, 1e-8);
  ExpectNear(EnuFromGeodetic(origin, 90, 0, 0), {0, kSemiMinor_m, -kSemiMajor_m}, 1e-8);
}

TEST(Georef, AgreesWithThePublishedExample) {
  // IOGP guidance note 7-2, geographic to topocentric (method 9837), angles given to 0.001".
  const Georef origin = At(55, 5, 200);
  const double latitude = 53 + 48 / 60.0 + 33.820 / 3600;
  const double longitude = 2 + 7 / 60.0 + 46.380 / 3600;
  ExpectNear(EnuFromGeodetic(origin, latitude, longitude, 73),
             {-189013.869, -128642.040, -4220.171}, 0.04);
}

TEST(Georef, ComesBackFromEverywhere) {
  for (const double latitude : {-90.0, -89.9, -35.0, 0.0, 47.4, 89.99, 90.0}) {
    const Georef origin = At(latitude, 8.5, 430);
    for (const Eigen::Vector3d& enu : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(100, -250, 30),
                                       Eigen::Vector3d(-9000, 7, -50)}) {
      const Eigen::Vector3d geodetic = GeodeticFromEnu(origin, enu);
      ExpectNear(EnuFromGeodetic(origin, geodetic.x(), geodetic.y(), geodetic.z()), enu, 1e-8);
    }
  }
  const Eigen::Vector3d home = GeodeticFromEnu(At(47.4, -170, 430), {0, 0, 12.5});
  EXPECT_NEAR(home.x(), 47.4, 1e-13);
  EXPECT_NEAR(home.y(), -170, 1e-13);
  EXPECT_NEAR(home.z(), 442.5, 1e-8);
}

TEST(Georef, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  Georef written = At(47.3977419, 8.545594, 430.1);
  written.up = Eigen::Vector3d(0, 0.6, 0.8);
  written.source = "rtk";
  WriteGeoref(written, folder / "georef.json");
  const Georef read = ReadGeoref(folder / "georef.json");
  EXPECT_EQ(read.frame, "enu");
  EXPECT_EQ(read.origin_latitude_deg, 47.3977419);
  EXPECT_EQ(read.origin_longitude_deg, 8.545594);
  EXPECT_EQ(read.origin_height_m, 430.1);
  EXPECT_EQ(read.up, written.up);
  EXPECT_TRUE(read.metric);
  EXPECT_EQ(read.source, "rtk");

  WriteGeoref(Georef(), folder / "georef.json");
  EXPECT_EQ(ReadGeoref(folder / "georef.json").frame, "arbitrary");
  EXPECT_FALSE(ReadGeoref(folder / "georef.json").up);
}

TEST(Georef, RefusesNonsense) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& fields, const std::string& part) {
    WriteFile(folder / "g.json", "{\"version\": 1, \"metric\": true, " + fields + "}");
    ExpectBadInput([&] { ReadGeoref(folder / "g.json"); }, part);
  };
  expect("\"frame\": \"utm\"", "frame \"utm\" is not");
  expect("\"frame\": \"enu\", \"origin_latitude_deg\": 90.5", "beyond a pole");
  expect("\"frame\": \"enu\", \"origin_longitude_deg\": 361", "over 360");
  expect("\"frame\": \"enu\", \"up\": [0, 0, 2]", "not a unit vector");
  expect("\"frame\": \"enu\", \"up\": [0, 1]", "\"up\" must be a list of 3 numbers");
  expect("\"source\": \"gps\"", "\"frame\" is missing");
}

}  // namespace
}  // namespace stucco
