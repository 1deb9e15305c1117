// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "survey/files.h"
#include "survey/point_cloud.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

using test::ErrorOf;
using test::ExpectBadInput;
using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Optional;

PointCloud MakeCloud() {
  PointCloud cloud;
  for (int i = 0; i < 5; ++i) {
    cloud.positions.emplace_back(i + 1.0 / 3, -1e6 * i, 1e-9);
    cloud.normals.push_back(Eigen::Vector3f(1.0F + i, 2, -0.5F).normalized());
    cloud.colors.push_back({static_cast<uint8_t>(i), 128, 255});
    cloud.views.emplace_back();
    for (uint32_t k = 0; k < static_cast<uint32_t>(i); ++k) cloud.views.back().push_back(1000 * k);
  }
  return cloud;
}

void ExpectSame(const PointCloud& a, const PointCloud& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_EQ(a.views, b.views);
}

TEST(Ply, ReadsBackExactly) {
  const TemporaryFolder folder;
  PointCloud cloud = MakeCloud();
  WritePly(cloud, folder / "a.ply");
  ExpectSame(ReadPly(folder / "a.ply"), cloud);
  cloud.views.clear();
  cloud.normals.clear();
  WritePly(cloud, folder / "a.ply");
  ExpectSame(ReadPly(folder / "a.ply"), cloud);
  WritePly({}, folder / "a.ply");
  EXPECT_EQ(ReadPly(folder / "a.ply").size(), 0u);
}

TEST(Ply, VisitsThePointsThatItWouldRead) {
  const TemporaryFolder folder;
  const PointCloud cloud = MakeCloud();
  WritePly(cloud, folder / "a.ply");
  PointCloud visited;
  ForEachPoint(folder / "a.ply", [&](const CloudPoint& point) {
    visited.positions.push_back(point.position);
    visited.normals.push_back(point.normal);
    visited.colors.push_back(point.color);
    visited.views.emplace_back(point.views.begin(), point.views.end());
  });
  ExpectSame(visited, cloud);
  const PlyLayout layout = ReadPlyLayout(folder / "a.ply");
  EXPECT_EQ(layout.points, cloud.size());
  EXPECT_TRUE(layout.normals && layout.colors && layout.views);
  EXPECT_THROW(ForEachPoint(folder / "none.ply", [](const CloudPoint&) {}), Error);
}

TEST(Ply, GoesOnWhereItLeftOff) {
  const TemporaryFolder folder;
  const PointCloud cloud = MakeCloud();
  WritePly(cloud, folder / "a.ply");
  WriteFile(folder / "b.ply",
            "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int corners\n"
            "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
            "3 0 1 2\n1 2 3\n4 5 6\n7 8 9");
  for (const char* name : {"a.ply", "b.ply"}) {
    const PointCloud whole = ReadPly(folder / name);
    std::vector<PlyPlace> places = {{}};
    std::vector<Eigen::Vector3d> visited;
    std::vector<uint32_t> views;
    const auto visit = [&](const CloudPoint& point) {
      visited.push_back(point.position);
      views.insert(views.end(), point.views.begin(), point.views.end());
    };
    while (places.back().point < whole.size()) {
      places.push_back(ForSomePoints(folder / name, places.back(), 2, visit));
    }
    EXPECT_EQ(visited, whole.positions) << name;
    EXPECT_EQ(places.size(), 1 + (whole.size() + 1) / 2) << name;
    visited.clear();
    EXPECT_EQ(ForSomePoints(folder / name, places[1], 1, visit).point, 3u);
    EXPECT_EQ(visited, std::vector<Eigen::Vector3d>{whole.positions[2]}) << name;
    EXPECT_EQ(ForSomePoints(folder / name, places.back(), 9, visit).point, whole.size());
  }
}

TEST(Ply, ReadsAcrossTheEdgesOfItsBuffer) {
  // Words and blanks of changing length, several megabytes of them.
  const TemporaryFolder folder;
  constexpr int kPoints = 60000;
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 60000\nproperty double x\n"
      "property double y\nproperty double z\nend_header\n";
  for (int i = 0; i < kPoints; ++i) {
    text += std::to_string(i) + ".0000000000000000000000" + std::string(1 + i % 61, ' ') +
            std::to_string(-i) + "\n" + std::to_string(i % 7) + "\n";
  }
  text += std::string(20000, ' ');
  WriteFile(folder / "a.ply", text);
  const PointCloud cloud = ReadPly(folder / "a.ply");
  ASSERT_EQ(cloud.size(), static_cast<size_t>(kPoints));
  for (int i = 0; i < kPoints; ++i) {
    ASSERT_EQ(cloud.positions[i], Eigen::Vector3d(i, -i, i % 7)) << i;
  }
}

TEST(Ply, ReadsBackManyPointsAndManyViews) {
  const TemporaryFolder folder;
  PointCloud cloud;
  for (int i = 0; i < 100000; ++i) cloud.positions.emplace_back(i, -i, 0.5);
  cloud.views.resize(cloud.size());
  for (uint32_t k = 0; k < 300; ++k) cloud.views[7].push_back(k * 3);  // more than a byte counts
  WritePly(cloud, folder / "a.ply");
  ExpectSame(ReadPly(folder / "a.ply"), cloud);
}

// Unknown elements and properties around the known ones.
constexpr char kAscii[] =
    "ply\r\n"
    "format ascii 1.0\r\n"
    "comment made by hand\r\n"
    "obj_info anything\r\n"
    "element camera 2\r\n"
    "property float fov\r\n"
    "property list uchar int flags\r\n"
    "element vertex 2\r\n"
    "property float quality\r\n"
    "property float x\r\n"
    "property float y\r\n"
    "property double z\r\n"
    "property list uchar uint view_indices\r\n"
    "property float nx\r\n"
    "property float ny\r\n"
    "property float nz\r\n"
    "property float red\r\n"
    "property uchar green\r\n"
    "property uchar blue\r\n"
    "element face 1\r\n"
    "property list uchar int vertex_indices\r\n"
    "end_header\r\n"
    "60 2 1 2\r\n"
    "61 0\r\n"
    "9 1.5 -2 1e3 3 7 5 7 0 0 2 1.0 20 30\r\n"
    "9 +1 2 3 0 0 1 0 0.5 300 255\r\n"
    "3 0 1 1\r\n";

TEST(Ply, ReadsForeignAscii) {
  const TemporaryFolder folder;
  WriteFile(folder / "a.ply", kAscii);
  const PointCloud cloud = ReadPly(folder / "a.ply");
  ASSERT_EQ(cloud.size(), 2u);
  EXPECT_EQ(cloud.positions[0], Eigen::Vector3d(1.5, -2, 1000));
  EXPECT_EQ(cloud.positions[1], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(cloud.normals[0], Eigen::Vector3f(0, 0, 1));  // made unit
  EXPECT_EQ(cloud.colors[0], (std::array<uint8_t, 3>{255, 20, 30}));
  EXPECT_EQ(cloud.colors[1], (std::array<uint8_t, 3>{128, 255, 255}));
  EXPECT_EQ(cloud.views[0], (std::vector<uint32_t>{5, 7}));  // ascending, each once
  EXPECT_TRUE(cloud.views[1].empty());
}

template <typename Number>
void AppendBigEndian(std::string& out, Number number) {
  char bytes[sizeof(Number)];
  std::memcpy(bytes, &number, sizeof(Number));
  std::reverse(bytes, bytes + sizeof(Number));
  out.append(bytes, sizeof(Number));
}

TEST(Ply, ReadsBigEndianAndEveryType) {
  const TemporaryFolder folder;
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty int16 a\nproperty uint16 b\n"
      "property char c\nproperty int32 x\nproperty float32 y\nproperty float64 z\n"
      "property list short uint32 view_indices\nend_header\n";
  AppendBigEndian(bytes, int16_t{-2});
  AppendBigEndian(bytes, uint16_t{65535});
  AppendBigEndian(bytes, int8_t{-1});
  AppendBigEndian(bytes, int32_t{-70000});
  AppendBigEndian(bytes, 0.25F);
  AppendBigEndian(bytes, 1.0 / 3);
  AppendBigEndian(bytes, int16_t{2});
  AppendBigEndian(bytes, uint32_t{1});
  AppendBigEndian(bytes, uint32_t{4000000000});
  WriteFile(folder / "a.ply", bytes);
  const PointCloud cloud = ReadPly(folder / "a.ply");
  ASSERT_EQ(cloud.size(), 1u);
  EXPECT_EQ(cloud.positions[0], Eigen::Vector3d(-70000, 0.25, 1.0 / 3));
  EXPECT_EQ(cloud.views[0], (std::vector<uint32_t>{1, 4000000000}));
  EXPECT_TRUE(cloud.normals.empty());
  EXPECT_TRUE(cloud.colors.empty());
}

TEST(Ply, RefusesDamage) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& text, const std::string& part) {
    WriteFile(folder / "a.ply", text);
    ExpectBadInput([&] { ReadPly(folder / "a.ply"); }, part);
  };
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string ascii = "ply\nformat ascii 1.0\n";
  const std::string binary = "ply\nformat binary_little_endian 1.0\n";
  expect("", "does not begin with \"ply\"");
  expect("plywood", "does not begin with \"ply\"");
  expect("ply\nformat ascii 1.0\n", "has no line \"end_header\"");
  expect("ply\nelement vertex 0\n" + xyz + "end_header\n", "has no line \"format\"");
  expect("ply\nformat utf8 1.0\nend_header\n", "unknown format \"utf8\"");
  expect(ascii + "end_header\n", "has no points");
  expect(ascii + "property float x\nend_header\n", "before the first element");
  expect(ascii + "element vertex\n" + xyz + "end_header\n", "\"vertex\" has no count");
  expect(ascii + "element vertex -1\n" + xyz + "end_header\n", "\"vertex\" has no count");
  expect(ascii + "element vertex 1\nproperty half x\nend_header\n", "unknown type \"half\"");
  expect(ascii + "element vertex 1\nproperty float x\nend_header\n1\n", "have no x, y and z");
  expect(ascii + "elephant 1\nend_header\n", "unknown line \"elephant\"");
  expect(ascii + "element vertex 1\n" + xyz + "end_header\n1 2", "cannot hold the 1 \"vertex\"");
  expect(ascii + "element vertex 2\n" + xyz + "end_header\n1.25 2.25 3.25 1.25\n",
         "ends too early");
  expect(ascii + "element vertex 1\n" + xyz + "end_header\n1 2 three\n",
         "\"three\" is not a number");
  expect(ascii + "element vertex 1\n" + xyz + "end_header\n1 2 nan\n", "point 0 is not finite");
  expect(binary + "element vertex 18446744073709551615\n" + xyz + "end_header\n",
         "cannot hold the 18446744073709551615 \"vertex\"");
  expect(binary + "element nothing 18446744073709551615\nelement vertex 0\n" + xyz + "end_header\n",
         "element \"nothing\" has no properties");
  expect(binary + "element face 1\nproperty list uint int i\nelement vertex 0\n" + xyz +
             "end_header\n\xff\xff\xff\xff",
         "list \"i\" is of length 4294967295");
  expect(ascii + "element vertex 1\n" + xyz + "property list uchar int view_indices\n" +
             "end_header\n1 2 3 1 -5\n",
         "-5 in \"view_indices\" is no photo number");
  expect(ascii + "element vertex 1\n" + xyz + "property list uchar int view_indices\n" +
             "end_header\n1 2 3 -1 5\n",
         "list \"view_indices\" is of length -1");
  expect(ascii + "element vertex 1\n" + xyz +
             "property float nx\nproperty float ny\nproperty float nz\nend_header\n1 2 3 0 0 0\n",
         "the normal of point 0 is not of unit length");
  ExpectBadInput([&] { ReadPly(folder / "none.ply"); }, "none.ply: cannot be read");
}

TEST(Ply, RefusesAFileCutAtAnyByte) {
  const TemporaryFolder folder;
  WritePly(MakeCloud(), folder / "a.ply");
  const std::string bytes = ReadFile(folder / "a.ply");
  for (size_t size = 0; size < bytes.size(); ++size) {
    WriteFile(folder / "a.ply", bytes.substr(0, size));
    EXPECT_FALSE(test::Accepts([&] { ReadPly(folder / "a.ply"); })) << size;
  }
}

TEST(Ply, SurvivesAnyByteBeingWrong) {
  const TemporaryFolder folder;
  WritePly(MakeCloud(), folder / "b.ply");
  for (const std::string& bytes : {ReadFile(folder / "b.ply"), std::string(kAscii)}) {
    for (size_t at = 0; at < bytes.size(); at += 2) {
      std::string wrong = bytes;
      wrong[at] = static_cast<char>(~wrong[at]);
      WriteFile(folder / "a.ply", wrong);
      test::Accepts([&] { ReadPly(folder / "a.ply"); });
    }
  }
}

TEST(PointCloud, FindsProblems) {
  EXPECT_FALSE(FindProblem(MakeCloud()));
  PointCloud cloud = MakeCloud();
  cloud.colors.pop_back();
  EXPECT_THAT(FindProblem(cloud), Optional(HasSubstr("5 points have 5 normals, 4 colours")));
  cloud = MakeCloud();
  cloud.positions[2].y() = INFINITY;
  EXPECT_THAT(FindProblem(cloud), Optional(HasSubstr("point 2 is not finite")));
  cloud = MakeCloud();
  cloud.normals[3] *= 1.01F;
  EXPECT_THAT(FindProblem(cloud), Optional(HasSubstr("normal of point 3 is not of unit length")));
  cloud = MakeCloud();
  cloud.views[4] = {1, 1};
  EXPECT_THAT(FindProblem(cloud), Optional(HasSubstr("views of point 4 are not ascending")));
  const TemporaryFolder folder;
  EXPECT_EQ(ErrorOf([&] { WritePly(cloud, folder / "a.ply"); }).kind(), ErrorKind::kStageFailed);
}

}  // namespace
}  // namespace stucco
