// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/consensus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A flight around 45 N, 7 E at 300 m and a little more.
std::vector<PhotoRecord> Flight(int count) {
  std::vector<PhotoRecord> records(count);
  for (int i = 0; i < count; ++i) {
    records[i].photo.usable = true;
    GeoPosition position;
    position.latitude_deg = 45 + i * 1e-4;
    position.longitude_deg = 7 + i * 1e-4;
    position.height_m = 300 + i;
    position.has_height = true;
    records[i].photo.position = position;
  }
  return records;
}

TEST(QuarantineOutliers, LeavesAFlightAlone) {
  auto records = Flight(20);
  QuarantineOutliers(records);
  for (const auto& record : records) {
    EXPECT_TRUE(record.photo.position->has_height);
    EXPECT_TRUE(record.doubts.empty());
  }
}

TEST(QuarantineOutliers, OneWrongHeightCostsOnlyItself) {
  auto records = Flight(20);
  records[7].photo.position->height_m = 2900;
  QuarantineOutliers(records);
  ASSERT_TRUE(records[7].photo.position);
  EXPECT_FALSE(records[7].photo.position->has_height);
  EXPECT_THAT(records[7].doubts, ElementsAre(HasSubstr("2900")));
  EXPECT_TRUE(records[6].photo.position->has_height);
}

TEST(QuarantineOutliers, OneFarPositionCostsOnlyItself) {
  auto records = Flight(20);
  records[3].photo.position->latitude_deg = -45;
  QuarantineOutliers(records);
  EXPECT_FALSE(records[3].photo.position);
  EXPECT_THAT(records[3].doubts, ElementsAre(HasSubstr("far")));
  EXPECT_TRUE(records[4].photo.position);
}

TEST(QuarantineOutliers, NoMajorityNoVerdict) {
  auto few = Flight(4);
  few[0].photo.position->height_m = 5000;
  QuarantineOutliers(few);
  EXPECT_TRUE(few[0].photo.position->has_height);
  auto two_places = Flight(20);
  for (int i = 0; i < 10; ++i) two_places[i].photo.position->latitude_deg = 20;
  QuarantineOutliers(two_places);
  for (const auto& record : two_places) EXPECT_TRUE(record.photo.position);
}

TEST(QuarantineOutliers, AcrossTheDateLineIsNear) {
  auto records = Flight(10);
  for (size_t i = 0; i < records.size(); ++i) {
    records[i].photo.position->longitude_deg = i % 2 == 0 ? 179.9999 : -179.9999;
  }
  QuarantineOutliers(records);
  for (const auto& record : records) EXPECT_TRUE(record.photo.position);
}

TEST(UseHeightAboveTakeoff, OnlyWhenNothingElseIsThere) {
  auto records = Flight(3);
  for (auto& record : records) record.photo.height_above_takeoff_m = 40;
  EXPECT_FALSE(UseHeightAboveTakeoff(records));
  EXPECT_EQ(records[0].photo.position->height_m, 300);
  for (auto& record : records) record.photo.position->has_height = false;
  EXPECT_TRUE(UseHeightAboveTakeoff(records));
  EXPECT_EQ(records[0].photo.position->height_m, 40);
  EXPECT_TRUE(records[0].photo.position->has_height);
}

}  // namespace
}  // namespace stucco
