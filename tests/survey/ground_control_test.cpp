// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/ground_control.h"

#include <gtest/gtest.h>

#include "tests/survey/support.h"

namespace stucco::test {
namespace {

GroundControlList Parse(const std::string& text) {
  return ParseGroundControl(text, "gcp_list.txt");
}

// Whether a problem holds all of the texts.
void ExpectProblem(const GroundControlList& list, size_t index,
                   const std::vector<std::string>& parts) {
  ASSERT_LT(index, list.problems.size());
  for (const std::string& part : parts) {
    EXPECT_NE(list.problems[index].find(part), std::string::npos)
        << "\"" << list.problems[index] << "\" does not hold \"" << part << "\"";
  }
}

TEST(GroundControl, ReadsWhatOpenDroneMapReads) {
  const GroundControlList list = Parse(
      "+proj=utm +zone=10 +ellps=WGS84 +datum=WGS84 +units=m +no_defs\n"
      "544256.7 5320919.9 5.25 3044 2622 IMG_0525.jpg gcp01\n"
      "544157.7 5320899.2 5 4193.5 1552 IMG_0585.jpg gcp02 0.02 0.03\n"
      "544256.7 5320919.9 5.25 3104 2021 IMG_0526.jpg gcp01\n");
  EXPECT_EQ(list.crs, "+proj=utm +zone=10 +ellps=WGS84 +datum=WGS84 +units=m +no_defs");
  EXPECT_TRUE(list.problems.empty());
  ASSERT_EQ(list.points.size(), 2u);
  EXPECT_EQ(list.points[0].name, "gcp01");
  EXPECT_EQ(list.points[0].coordinates, Eigen::Vector3d(544256.7, 5320919.9, 5.25));
  ASSERT_EQ(list.points[0].markings.size(), 2u);
  EXPECT_EQ(list.points[0].markings[1].photo, "IMG_0526.jpg");
  EXPECT_EQ(list.points[0].markings[1].pixel, Eigen::Vector2d(3104, 2021));
  EXPECT_EQ(list.points[0].markings[1].line, 4);
  EXPECT_EQ(list.points[1].role, PointRole::kControl);
}

TEST(GroundControl, KnowsRolesByColumnAndByName) {
  const GroundControlList list = Parse(
      "EPSG:25832\n"
      "1 2 3 4 5 a.jpg A\n"
      "2 2 3 4 5 a.jpg B check\n"
      "3 2 3 4 5 a.jpg C 0.02 Check\n"
      "4 2 3 4 5 a.jpg CHK-4\n"
      "5 2 3 4 5 a.jpg check5 control\n"
      "6 2 3 4 5 a.jpg check\n"
      "7 2 3 4 5 a.jpg checkers\n"
      "8 2 3 4 5 a.jpg D\n"
      "8 2 3 4 5 b.jpg D check\n");
  EXPECT_TRUE(list.problems.empty());
  const PointRole control = PointRole::kControl;
  const PointRole check = PointRole::kCheck;
  const PointRole expected[] = {control, check, check, check, control, check, check, check};
  ASSERT_EQ(list.points.size(), std::size(expected));
  for (size_t i = 0; i < std::size(expected); ++i) {
    EXPECT_EQ(list.points[i].role, expected[i]) << list.points[i].name;
  }
  EXPECT_EQ(list.points[5].name, "line-7");  // without a name
}

TEST(GroundControl, PointsWithoutNamesAreTheSameWhereTheirCoordinatesAre) {
  const GroundControlList list =
      Parse("EPSG:4326\n1 2 3 4 5 a.jpg\n1 2 3 4 5 b.jpg\n1 2 4 4 5 a.jpg\n");
  ASSERT_EQ(list.points.size(), 2u);
  EXPECT_EQ(list.points[0].markings.size(), 2u);
  EXPECT_NE(list.points[0].name, list.points[1].name);
}

TEST(GroundControl, TakesTextsAsProgramsWriteThem) {
  const GroundControlList list = Parse(
      "\xEF\xBB\xBF"
      "WGS84 UTM 32N  \r\n"
      "# a comment\r\n"
      "\r\n"
      "  +1.5\t2e3  -3 4.25 5.5\ta.jpg  A \t\r\n"
      "1\t2\t3\t4\t5\tmy photo.jpg\tNorth corner\tcheck");
  EXPECT_EQ(list.crs, "WGS84 UTM 32N");
  EXPECT_TRUE(list.problems.empty());
  ASSERT_EQ(list.points.size(), 2u);
  EXPECT_EQ(list.points[0].coordinates, Eigen::Vector3d(1.5, 2000, -3));
  EXPECT_EQ(list.points[1].markings[0].photo, "my photo.jpg");
  EXPECT_EQ(list.points[1].name, "North corner");
  EXPECT_EQ(list.points[1].role, PointRole::kCheck);
}

TEST(GroundControl, LeavesBadLinesOutAndNamesThem) {
  const GroundControlList list = Parse(
      "EPSG:25832\n"
      "1 2 3 4 5 a.jpg A\n"
      "1 2 3 4 5\n"
      "1 2,5 3 4 5 a.jpg B\n"
      "1 2 NaN 4 5 a.jpg C\n"
      "1 9 3 4 5 b.jpg A\n"
      "1 2 3 6 7 a.jpg A\n"
      "inf 2 3 4 5 a.jpg D\n"
      "1 2 3 4 5 b.jpg A\n");
  ASSERT_EQ(list.points.size(), 1u);
  EXPECT_EQ(list.points[0].markings.size(), 2u);
  ASSERT_EQ(list.problems.size(), 6u);
  ExpectProblem(list, 0, {"gcp_list.txt, line 3", "5 fields", "at least 6"});
  ExpectProblem(list, 1, {"line 4", "\"2,5\" is no number", "point"});
  ExpectProblem(list, 2, {"line 5", "no height"});
  ExpectProblem(list, 3, {"line 6", "point A", "other coordinates", "line 2"});
  ExpectProblem(list, 4, {"line 7", "point A", "a.jpg", "line 2"});
  ExpectProblem(list, 5, {"line 8", "\"inf\""});
}

TEST(GroundControl, RolesThatContradictMakeACheckPoint) {
  const GroundControlList list =
      Parse("EPSG:25832\n1 2 3 4 5 a.jpg A control\n1 2 3 4 5 b.jpg A check\n");
  ASSERT_EQ(list.points.size(), 1u);
  EXPECT_EQ(list.points[0].role, PointRole::kCheck);
  ExpectProblem(list, 0, {"line 3", "point A", "check point"});
}

TEST(GroundControl, RefusesAFileThatIsNone) {
  ExpectBadInput([] { Parse(""); }, "no points");
  ExpectBadInput([] { Parse("EPSG:25832\n\n"); }, "no points");
  ExpectBadInput([] { Parse("1 2 3 4 5 a.jpg A\n1 2 3 4 5 b.jpg A\n"); }, "coordinate system");
  ExpectBadInput([] { Parse("EPSG:25832\n1;2;3;4;5;a.jpg\n"); }, "line 2");
}

TEST(GroundControl, BytesThatAreNoTextDoNoHarm) {
  const GroundControlList list = Parse("EPSG:25832\n1 2 3 4 5 a.jpg P\xFCnkt\n1 2 3 4 5 \xFF\n");
  ASSERT_EQ(list.points.size(), 2u);
  EXPECT_EQ(list.points[0].name, "P\xEF\xBF\xBDnkt");
}

TEST(GroundControl, ReadsBackWhatItWrites) {
  GroundControlList list;
  list.crs = "EPSG:4326";
  list.points.push_back({"A", PointRole::kCheck, {14.402381234, 50.104191234, 271.125}, {}});
  list.points[0].markings = {{"a.jpg", {12.25, 700.5}, 2}, {"b.jpg", {1, 2}, 3}};
  list.points.push_back({"check", PointRole::kControl, {14.5, 50.5, 1}, {{"a.jpg", {3, 4}, 4}}});
  list.points[1].name = "chk-2";
  const GroundControlList read = Parse(GroundControlText(list));
  ASSERT_EQ(read.points.size(), 2u);
  EXPECT_TRUE(read.problems.empty());
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.points[i].name, list.points[i].name);
    EXPECT_EQ(read.points[i].role, list.points[i].role);
    EXPECT_EQ(read.points[i].coordinates, list.points[i].coordinates);
    ASSERT_EQ(read.points[i].markings.size(), list.points[i].markings.size());
    EXPECT_EQ(read.points[i].markings[0].pixel, list.points[i].markings[0].pixel);
    EXPECT_EQ(read.points[i].markings[0].line, list.points[i].markings[0].line);
  }
}

}  // namespace
}  // namespace stucco::test
