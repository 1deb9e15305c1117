// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/results/record_findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stucco {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A flight as good drones without RTK fly it.
CalibratedRecords GoodRecords() {
  CalibratedRecords records;
  records.attitude_sigma_deg = 0.3;
  records.mount_deg = 0.2;
  records.flights = {{60, {0.2, 0.1, 0.4}, 0.8, 1.1, 0.5}};
  return records;
}

std::vector<CalibratedPhoto> Photos(int good, int elsewhere) {
  std::vector<CalibratedPhoto> photos;
  for (int i = 0; i < good + elsewhere; ++i) {
    CalibratedPhoto photo;
    photo.path = "p" + std::to_string(i) + ".jpg";
    photo.prior_residual_m = i < good ? 0.9 : 20.0 + i;
    photo.prior_outlier = i >= good;
    photos.push_back(photo);
  }
  return photos;
}

TEST(RecordFindings, OfGoodRecordsAreNone) {
  EXPECT_THAT(RecordFindings(GoodRecords(), Photos(60, 0)), IsEmpty());
  EXPECT_THAT(RecordFindings({}, {}), IsEmpty());
}

TEST(RecordFindings, NamePositionsThatLieElsewhereTheWorstFirst) {
  EXPECT_THAT(RecordFindings(GoodRecords(), Photos(10, 2)),
              ElementsAre(AllOf(HasSubstr("2 of 12 recorded positions"), HasSubstr("up to 31 m"),
                                HasSubstr("(p11.jpg, p10.jpg)"))));
  EXPECT_THAT(RecordFindings(GoodRecords(), Photos(10, 6)),
              ElementsAre(HasSubstr("(p15.jpg, p14.jpg, p13.jpg, p12.jpg ...)")));
  std::vector<CalibratedPhoto> near = Photos(10, 2);
  for (CalibratedPhoto& photo : near) photo.prior_residual_m = 0.5;  // outliers of RTK
  EXPECT_THAT(RecordFindings(GoodRecords(), near), IsEmpty());
}

TEST(RecordFindings, NameWhatAFlightIsOffBy) {
  CalibratedRecords records = GoodRecords();
  records.flights.push_back({40, {3, 4, 0}, 3.1, 4, -25});
  EXPECT_THAT(RecordFindings(records, {}),
              ElementsAre(HasSubstr("flight 2: its recorded yaw is 25.0 degrees off"),
                          HasSubstr("flight 2: its positions are shifted by 5.0 m"),
                          HasSubstr("flight 2: its recorded positions scatter by 3.1 m")));
  records.flights[1] = {5, {0, 0, 0}, 5, 10, 0};  // too few to tell
  EXPECT_THAT(RecordFindings(records, {}), IsEmpty());
}

TEST(RecordFindings, NameGimbals) {
  CalibratedRecords records = GoodRecords();
  records.mount_deg = 3;
  records.attitude_sigma_deg = 2;
  EXPECT_THAT(RecordFindings(records, {}),
              ElementsAre(HasSubstr("3.0 degrees beside what the gimbal"),
                          HasSubstr("angles scatter by 2.0 degrees")));
}

TEST(MapFindings, SayHowFarMapAndPositionsAreApart) {
  CalibratedMap map;
  map.shift_m = {0.9, -1.2};
  map.sigma_m = 0.05;
  map.walls = 21;
  EXPECT_THAT(MapFindings(map), ElementsAre(AllOf(HasSubstr("1.50 m"), HasSubstr("-1.20 m north"),
                                                  HasSubstr("calib.georef"))));
  map.moved = true;
  EXPECT_THAT(MapFindings(map), ElementsAre(HasSubstr("was moved onto the map")));
  // What maps are off by themselves, or what was not measured surely, is not worth a word.
  map.moved = false;
  map.sigma_m = 0.6;
  EXPECT_THAT(MapFindings(map), IsEmpty());
  map.sigma_m = 0.05;
  map.shift_m = {0.1, 0.2};
  EXPECT_THAT(MapFindings(map), IsEmpty());
}

}  // namespace
}  // namespace stucco
