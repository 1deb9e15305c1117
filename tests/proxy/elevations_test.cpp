// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/output/elevations.h"

#include <gtest/gtest.h>

#include <array>

#include "survey/image.h"
#include "tests/survey/temporary_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Eigen::Vector3f;

// A wall of 8 by 4 m in the plane y = 0, which looks to the south.
Proxy OneWall() {
  Facet wall;
  wall.id = "B0001/F00.1";
  wall.normal = -Vector3d::UnitY();
  wall.outer = {{0, 0, 0}, {8, 0, 0}, {8, 0, 4}, {0, 0, 4}};
  wall.area = 32;
  Facet floor = wall;
  floor.id = "B0001/G0";
  floor.facet_class = FacetClass::kGround;
  Proxy proxy;
  proxy.metric = true;
  proxy.buildings = {{.id = "B0001", .source = "map", .detail = {}, .facets = {wall, floor}},
                     {.id = "G0", .source = "", .detail = {}, .facets = {floor}}};
  return proxy;
}

// Its left half stands out by `before_m`, of its right half nothing was seen.
PointCloud LeftHalf(double before_m, const Vector3f& normal) {
  PointCloud cloud;
  for (double x = 0.03; x < 4; x += 0.04) {
    for (double z = 0.03; z < 4; z += 0.04) {
      cloud.positions.emplace_back(x, -before_m, z);
      cloud.normals.push_back(normal);
      cloud.colors.push_back({});
    }
  }
  return cloud;
}

// Pixels of the sheet that are mostly red, mostly blue, and grey as nothing is seen there.
struct Counts {
  int red = 0, blue = 0, grey = 0;
};

Counts CountColours(const fs::path& path) {
  const Image image = ReadImage(path);
  Counts counts;
  for (int y = 56; y < image.height_px; ++y) {  // below the legend
    for (int x = 0; x < image.width_px; ++x) {
      const uint8_t* p = image.Pixel(x, y);
      counts.red += p[0] > p[2] + 60;
      counts.blue += p[2] > p[0] + 60;
      counts.grey += p[0] == 205 && p[1] == 209 && p[2] == 213;
    }
  }
  return counts;
}

class ElevationsTest : public testing::Test {
 protected:
  Counts Drawn(const PointCloud& cloud) {
    WriteElevations(StreamOf(cloud), OneWall(), folder_.path() / "elevations");
    return CountColours(folder_.path() / "elevations/B0001.png");
  }

  test::TemporaryFolder folder_;
};

TEST_F(ElevationsTest, ShowWhatStandsBeforeAndBehindAndWhatNobodySaw) {
  const Vector3f south(0, -1, 0);
  const Counts before = Drawn(LeftHalf(0.14, south));
  EXPECT_GT(before.red, 1000);
  EXPECT_EQ(before.blue, 0);
  EXPECT_NEAR(before.grey, before.red, 0.1 * before.red);
  const Counts behind = Drawn(LeftHalf(-0.14, south));
  EXPECT_EQ(behind.red, 0);
  EXPECT_EQ(behind.blue, before.red);
  const Counts on = Drawn(LeftHalf(0.005, south));
  EXPECT_EQ(on.red + on.blue, 0);
  EXPECT_EQ(on.grey, before.grey);
}

TEST_F(ElevationsTest, LeaveOutWhatIsOfAnotherSurface) {
  const Counts far = Drawn(LeftHalf(0.9, {0, -1, 0}));
  EXPECT_EQ(far.red, 0);
  const Counts turned = Drawn(LeftHalf(0.14, {-1, 0, 0}));  // the wall around the corner
  EXPECT_EQ(turned.red, 0);
  EXPECT_EQ(turned.grey, far.grey);
  const Counts unknown = Drawn(LeftHalf(0.14, {0, 0, 0}));
  EXPECT_GT(unknown.red, 1000);
}

TEST_F(ElevationsTest, OfBuildingsOnly) {
  WriteElevations(StreamOf(PointCloud{}), OneWall(), folder_.path() / "elevations");
  EXPECT_TRUE(fs::exists(folder_.path() / "elevations/B0001.png"));
  EXPECT_FALSE(fs::exists(folder_.path() / "elevations/G0.png"));
}

}  // namespace
}  // namespace stucco
