// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/results/photos_csv.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "calib/scene/resect.h"
#include "calib/scene/tracks.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

// The fields of each line by the names of the first.
std::vector<std::map<std::string, std::string>> Parsed(const std::string& csv) {
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(line.back(), '\r');
    line.back() = ',';
    std::istringstream fields(line);
    std::vector<std::string> row;
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
    if (names.empty()) {
      names = row;
      continue;
    }
    EXPECT_EQ(row.size(), names.size()) << line;
    rows.emplace_back();
    for (size_t i = 0; i < row.size(); ++i) rows.back()[names[i]] = row[i];
  }
  return rows;
}

TEST(PhotosCsv, SaysOfEachPhotoWhatItHadAndWhatBecameOfIt) {
  Scene scene = MakeScene({.num_photos = 3, .num_points = 60});
  scene.photos[2].pose.reset();
  IndexTracks(scene);
  Captures captures;
  for (const char* path : {"a.jpg", "broken.jpg", "b.jpg", "c.jpg"}) {
    captures.photos.emplace_back().path = path;
  }
  captures.photos[1].why = "cut off";
  const std::vector<int> capture_of_photo = {0, 2, 3};
  const std::map<int, std::string> unregistered = {{2, "it overlaps with no other photo"}};
  const PriorResiduals priors;
  const std::vector<KeypointCounts> keypoints = {{100, 10, 4}, {200, 0, 0}, {300, 30, 30}};
  const std::vector<TriedPair> tried = {{0, 1, 90, 50}, {0, 2, 20, 0}, {1, 2, 40, 25}};
  const std::vector<VerifiedPair> used = {{{0, 1, std::vector<Match>(50)}, {}, false}};
  const auto rows = Parsed(PhotosCsv({captures, capture_of_photo, scene, unregistered, priors, {}},
                                     {keypoints, tried, used}));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].at("path"), "a.jpg");
  EXPECT_EQ(rows[0].at("candidates"), "2");
  EXPECT_EQ(rows[0].at("raw_matches"), "110");
  EXPECT_EQ(rows[0].at("verified_pairs"), "1");
  EXPECT_EQ(rows[0].at("verified_matches"), "50");
  EXPECT_EQ(rows[0].at("used_pairs"), "1");
  EXPECT_EQ(rows[0].at("used_matches"), "50");
  EXPECT_EQ(rows[0].at("keypoints"), "100");
  EXPECT_EQ(rows[0].at("wall_keypoints"), "10");
  EXPECT_EQ(rows[0].at("coincident_keypoints"), "4");
  EXPECT_EQ(rows[0].at("points_seen"), std::to_string(NumVisiblePoints(scene, 0)));
  EXPECT_EQ(rows[0].at("observations"), std::to_string(NumUsedObservations(scene, 0)));
  EXPECT_EQ(rows[0].at("posed"), "yes");
  EXPECT_EQ(rows[0].at("why"), "");
  EXPECT_EQ(rows[1].at("path"), "broken.jpg");
  EXPECT_EQ(rows[1].at("candidates"), "");
  EXPECT_EQ(rows[1].at("posed"), "no");
  EXPECT_EQ(rows[1].at("why"), "cut off");
  EXPECT_EQ(rows[3].at("verified_pairs"), "1");
  EXPECT_EQ(rows[3].at("used_pairs"), "0");
  EXPECT_EQ(rows[3].at("observations"), "0");
  EXPECT_EQ(rows[3].at("posed"), "no");
  EXPECT_EQ(rows[3].at("why"), "it overlaps with no other photo");
}

TEST(CountKeypoints, TellsThoseOfWallsAndThoseThatCoincide) {
  DetectedFeatures detected;
  detected.plain.resize(2);
  detected.plain[0].keypoints.resize(3);
  const std::vector<std::vector<int32_t>> places = {{0, 1, 1, 1, 4, 4}, {}};
  const auto counts = CountKeypoints(detected, places);
  EXPECT_EQ(counts[0].plain, 3u);
  EXPECT_EQ(counts[0].on_walls, 3u);
  EXPECT_EQ(counts[0].coincident, 1u);
  EXPECT_EQ(counts[1].on_walls, 0u);
}

}  // namespace
}  // namespace stucco::test
