// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "simulate/render/renderer.h"
#include "survey/error.h"
#include "tests/simulate/scenes.h"

namespace stucco::simulate {
namespace {

using test::LookAt;

constexpr float kFar = 40;

Light SkyOnly() {
  Light light;
  light.sun.setZero();
  light.sky.setOnes();
  return light;
}

Light SunOnly(const Eigen::Vector3d& to_sun) {
  Light light;
  light.to_sun = to_sun.normalized();
  light.sun.setOnes();
  light.sky.setZero();
  return light;
}

Light Albedo() {
  Light light;
  light.lit = false;
  return light;
}

// Black surfaces: nothing but the sky and the sun lights, so that shares can be calculated; a white
// strip of 2 cm shows the light.
int AddBlack(Scene& scene) {
  Material material;
  material.colour.setZero();
  return test::AddMaterial(scene, material);
}

void AddGround(Scene& scene, int material, float z = 0) {
  test::AddQuad(scene, {{-kFar, kFar, z}, {2 * kFar, 0, 0}, {0, -2 * kFar, 0}}, material, "ground");
}

// What a view straight down at (x, y) has in its middle.
Eigen::Vector3f Down(const Renderer& renderer, double x, double y, double z, const Light& light) {
  const Pose pose = LookAt({x, y, z}, {x, y, z - 1}, Eigen::Vector3d::UnitY());
  const Radiance picture = renderer.Photograph(test::Pinhole(9, 9, 200), pose, light);
  return Eigen::Vector3f(&picture.rgb[3 * 40]);
}

TEST(RenderLight, OpenGroundGetsTheWholeSky) {
  Scene scene;
  AddGround(scene, test::AddTexture(scene, test::Plain(255)));
  const Renderer renderer(std::move(scene));
  EXPECT_NEAR(Down(renderer, 3, 4, 20, SkyOnly()).x(), 1, 1e-5);
}

TEST(RenderLight, GroundTurnedTheWrongWayGetsTheWholeSky) {
  Scene scene;
  test::AddQuad(scene, {{-kFar, -kFar, 0}, {2 * kFar, 0, 0}, {0, 2 * kFar, 0}},
                test::AddTexture(scene, test::Plain(255)), "ground");
  const Renderer renderer(std::move(scene));
  EXPECT_NEAR(Down(renderer, 3, 4, 20, SkyOnly()).x(), 1, 1e-5);
}

TEST(RenderLight, UndersidesOfSolidsGetNoSky) {
  Scene scene;
  const int white = test::AddTexture(scene, test::Plain(255));
  AddGround(scene, AddBlack(scene));
  test::AddBox(scene, {-2, -2, 5}, {2, 2, 6}, white, "box");
  const Renderer renderer(std::move(scene));
  const Pose up = LookAt({0, 0, 1}, {0, 0, 2}, Eigen::Vector3d::UnitY());
  const Radiance picture = renderer.Photograph(test::Pinhole(9, 9, 200), up, SkyOnly());
  EXPECT_NEAR(picture.rgb[3 * 40], 0, 0.02);
}

// A white quad 2 cm above the ground of a street between black walls, h high and w apart, sees the
// share cos(atan(2 h / w)) of the sky in its middle (Oke, "Boundary layer climates", 1987).
TEST(RenderLight, StreetGetsItsShareOfTheSky) {
  constexpr float kWidth = 10, kHeight = 8;
  Scene scene;
  const int black = AddBlack(scene);
  const int white = test::AddTexture(scene, test::Plain(255));
  AddGround(scene, black);
  test::AddQuad(scene, {{-kFar, kWidth / 2, kHeight}, {2 * kFar, 0, 0}, {0, 0, -kHeight}}, black);
  test::AddQuad(scene, {{kFar, -kWidth / 2, kHeight}, {-2 * kFar, 0, 0}, {0, 0, -kHeight}}, black);
  test::AddQuad(scene, {{-1, 1, 0.02f}, {2, 0, 0}, {0, -2, 0}}, white);
  const Renderer renderer(std::move(scene));
  const double expected = std::cos(std::atan(2 * kHeight / kWidth));
  EXPECT_NEAR(Down(renderer, 0, 0, 20, SkyOnly()).x(), expected, 0.03);
}

TEST(RenderLight, WallOverOpenGroundSeesHalfTheSky) {
  Scene scene;
  const int black = AddBlack(scene);
  AddGround(scene, black);
  test::AddQuad(scene, {{-4, 0, 8}, {8, 0, 0}, {0, 0, -8}},
                test::AddTexture(scene, test::Plain(255)), "wall");
  const Renderer renderer(std::move(scene));
  const Radiance picture =
      renderer.Photograph(test::Pinhole(9, 9, 200), LookAt({0, -10, 4}, {0, 0, 4}), SkyOnly());
  // The rest comes from the ground as bounced light: white on average by a vanishing area.
  EXPECT_NEAR(picture.rgb[3 * 40], 0.5, 0.02);
}

TEST(RenderLight, ShadowEndsWhereTheSunSays) {
  Scene scene;
  const int white = test::AddTexture(scene, test::Plain(255));
  AddGround(scene, white);
  // A wall along x, 6 m high; the sun stands in the south at tan = 0.75: shadow of 8 m northwards.
  test::AddQuad(scene, {{-50, 0, 6}, {100, 0, 0}, {0, 0, -6}}, white, "wall");
  const Renderer renderer(std::move(scene));
  const Light light = SunOnly({0, -0.8, 0.6});
  // Pixels of 5 mm. Where the sky is hidden there is bounced light, nowhere as much as in the sun.
  const float just_beyond = Down(renderer, 0, 8.02, 1, light).x();
  const float just_inside = Down(renderer, 0, 7.98, 1, light).x();
  EXPECT_NEAR(just_beyond - just_inside, 0.6, 5e-3);
  EXPECT_LT(just_inside, 0.15f);
  EXPECT_NEAR(Down(renderer, 0, -35, 20, light).x(), 0.6, 0.02);
}

TEST(RenderLight, SunBehindASurfaceDoesNotLightIt) {
  Scene scene;
  test::AddQuad(scene, {{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}},
                test::AddTexture(scene, test::Plain(255)));
  const Renderer renderer(std::move(scene));
  const auto seen_from = [&](double y) {
    const Radiance picture = renderer.Photograph(
        test::Pinhole(9, 9, 200), LookAt({0, y, 0}, {0, 0, 0}), SunOnly({0, -0.8, 0.6}));
    return picture.rgb[3 * 40];
  };
  EXPECT_GT(seen_from(-5), 0.79f);
  EXPECT_LT(seen_from(5), 0.3f);  // its back: both sides are drawn
}

TEST(RenderLight, FineCheckerFarAwayIsTheGreyOfLinearLight) {
  Scene scene;
  const int board = test::AddTexture(scene, test::Checkerboard(512, 512, 1));
  test::AddQuad(scene, {{-50, 50, 0}, {100, 0, 0}, {0, -100, 0}}, board, "ground", 10);
  const Renderer renderer(std::move(scene));
  // Squares of 2 cm from 30 m up and obliquely: 0.1 to 4 of them per pixel.
  const Radiance picture =
      renderer.Photograph(test::Pinhole(300, 200, 150), LookAt({0, -20, 30}, {0, 8, 0}), Albedo());
  double lowest = 1, highest = 0;
  for (int y = 60; y < 140; ++y) {
    for (int x = 90; x < 210; ++x) {
      const double value = picture.rgb[3 * (static_cast<size_t>(y) * 300 + x)];
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  EXPECT_GT(lowest, 0.49);  // half of the light, not half of the sRGB value (0.21)
  EXPECT_LT(highest, 0.51);
}

// Stripes along the direction of view stay sharp at a grazing angle where square filters blur them.
TEST(RenderLight, StripesStaySharpAtGrazingAngles) {
  Scene scene;
  Image stripes{64, 64, 3, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    stripes.data.insert(stripes.data.end(), 3, (i % 64) / 8 % 2 != 0 ? 255 : 0);
  }
  // Repeats every 3.2 m: stripes of 0.4 m.
  test::AddQuad(scene, {{-32, 64, 0}, {64, 0, 0}, {0, -64, 0}}, test::AddTexture(scene, stripes),
                "ground", 20);
  const Renderer renderer(std::move(scene));
  // 20 m away and 2 m up: a pixel covers 0.05 m across and 0.5 m along the ground.
  const Radiance picture =
      renderer.Photograph(test::Pinhole(200, 100, 400), LookAt({0, 0, 2}, {0, 20, 0}), Albedo());
  float lowest = 1, highest = 0;
  for (int x = 60; x < 140; ++x) {
    lowest = std::min(lowest, picture.rgb[3 * (static_cast<size_t>(50) * 200 + x)]);
    highest = std::max(highest, picture.rgb[3 * (static_cast<size_t>(50) * 200 + x)]);
  }
  EXPECT_LT(lowest, 0.1f);
  EXPECT_GT(highest, 0.9f);
}

TEST(RenderLight, EdgesAreAntiAliased) {
  Scene scene;
  const int white = test::AddTexture(scene, test::Plain(255));
  // Its right edge runs slantwise through the picture.
  test::AddQuad(scene, {{-5, 0, 5}, {5.5f, 0, 0}, {-1, 0, -10}}, white);
  const Renderer renderer(std::move(scene));
  const Radiance picture =
      renderer.Photograph(test::Pinhole(100, 100, 100), LookAt({0, -10, 0}, {0, 0, 0}), Albedo());
  double covered = 0;
  int between = 0;
  for (int y = 20; y < 80; ++y) {
    for (int x = 0; x < 100; ++x) {
      const float value = picture.rgb[3 * (static_cast<size_t>(y) * 100 + x)];
      covered += value;
      between += value > 0.1f && value < 0.9f;
    }
  }
  // The edge is at x = 0 in the middle row: half of the area, by symmetry of rows 20 to 79.
  EXPECT_NEAR(covered, 60 * 50, 8);
  EXPECT_GT(between, 40);
}

TEST(RenderLight, EdgesInAMirrorAreAntiAliased) {
  Scene scene;
  Material pane;
  pane.gloss = 1;
  pane.colour.setZero();
  test::AddQuad(scene, {{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, test::AddMaterial(scene, pane));
  // Behind the camera, black before the sky; its edge runs slantwise.
  test::AddQuad(scene, {{5, -20, 15}, {-5.5f, 0, 0}, {1, 0, -30}}, AddBlack(scene));
  const Renderer renderer(std::move(scene));
  const Radiance picture =
      renderer.Photograph(test::Pinhole(100, 100, 100), LookAt({0, -10, 0}, {0, 0, 0}), SkyOnly());
  int black = 0, between = 0;
  for (int y = 5; y < 40; ++y) {  // above the horizon
    const auto at = [&](int x) { return picture.rgb[3 * (static_cast<size_t>(y) * 100 + x)]; };
    const float sky = at(10);
    ASSERT_GT(sky, 0.02f);
    for (int x = 40; x < 60; ++x) {
      black += at(x) < 0.05f * sky;
      between += at(x) > 0.1f * sky && at(x) < 0.9f * sky;
    }
  }
  EXPECT_GT(black, 100);
  EXPECT_GT(between, 20);
}

TEST(RenderLight, CutOutLetsSightAndSunThrough) {
  Scene scene;
  const int white = test::AddTexture(scene, test::Plain(255));
  Image half{2, 1, 4, {255, 0, 0, 255, 0, 0, 0, 0}};
  const int leaf = test::AddTexture(scene, half);
  scene.materials[leaf].cut_out = true;
  AddGround(scene, white);
  test::AddQuad(scene, {{-10, 10, 5}, {20, 0, 0}, {0, -20, 0}}, leaf, "leaf");
  const Renderer renderer(std::move(scene));
  const Light noon = SunOnly({0, 0, 1});
  const Eigen::Vector3f on_leaf = Down(renderer, -5, 0, 20, noon);
  EXPECT_GT(on_leaf.x(), 0.3f);
  EXPECT_LT(on_leaf.y(), 0.2f);
  // Through the hole, in the sun; a little light bounces between ground and leaf.
  EXPECT_NEAR(Down(renderer, 5, 0, 20, noon).y(), 1.05, 0.06);
  const Eigen::Vector3f below = Down(renderer, -5, 0, 4, noon);
  EXPECT_LT(below.y(), 0.5f);  // in its shadow
}

TEST(RenderLight, LeavesAreLitThroughFromBehind) {
  Scene scene;
  const int leaf = test::AddTexture(scene, Image{1, 1, 4, {255, 255, 255, 255}});
  scene.materials[leaf].cut_out = true;
  test::AddQuad(scene, {{-10, 10, 5}, {20, 0, 0}, {0, -20, 0}}, leaf, "leaf");
  const Renderer renderer(std::move(scene));
  const Pose up = LookAt({0, 0, 1}, {0, 0, 2}, Eigen::Vector3d::UnitY());
  const Camera camera = test::Pinhole(9, 9, 200);
  EXPECT_GT(renderer.Photograph(camera, up, SunOnly({0.1, 0, 1})).rgb[3 * 40], 0.3f);
  EXPECT_GT(Down(renderer, 0, 0, 20, SunOnly({0.1, 0, 1})).x(), 0.6f);
}

TEST(RenderLight, LeavesOutWhatIsNotWanted) {
  Scene scene;
  const int white = test::AddTexture(scene, test::Plain(255));
  AddGround(scene, white);
  test::AddBox(scene, {-5, -5, 0}, {5, 5, 5}, AddBlack(scene), "house");
  const Renderer renderer(std::move(scene));
  const Pose pose = LookAt({0, 0, 30}, {0, 0, 0}, Eigen::Vector3d::UnitY());
  const Camera camera = test::Pinhole(9, 9, 200);
  EXPECT_EQ(renderer.Photograph(camera, pose, Albedo()).rgb[3 * 40], 0);
  RenderOptions options;
  options.left_out = {false, true};
  EXPECT_EQ(renderer.Photograph(camera, pose, Albedo(), options).rgb[3 * 40], 1);
  EXPECT_NEAR(renderer.Depth(camera, pose, options).depths[40], 30, 1e-4);
  // Its shade stays.
  const Light noon = SunOnly({0, 0, 1});
  EXPECT_LT(renderer.Photograph(camera, pose, noon, options).rgb[3 * 40], 0.8f);
}

Scene Village() {
  Scene scene;
  const int ground = test::AddTexture(scene, test::Checkerboard(8, 8, 16));
  const int wall = test::AddTexture(scene, test::Checkerboard(30, 20, 3));
  Material pane;
  pane.gloss = 1;
  pane.colour.setConstant(0.1f);
  const int glass = test::AddMaterial(scene, pane);
  AddGround(scene, ground);
  for (int i = 0; i < 6; ++i) {
    const auto x = static_cast<float>(i % 3) * 20, y = static_cast<float>(i / 3) * 25;
    test::AddBox(scene, {x, y, 0}, {x + 11, y + 9, 6 + static_cast<float>(i)},
                 i == 4 ? glass : wall, "house");
  }
  return scene;
}

TEST(RenderLight, SamePictureAtAnyNumberOfThreads) {
  const Renderer one(Village());
  const Renderer two(Village());
  const Camera camera = test::Pinhole(203, 151, 170);
  const Pose pose = LookAt({-20, -30, 25}, {25, 20, 2});
  Light light;
  light.haze_m = 400;
  RenderOptions options;
  options.threads = 1;
  const Radiance single = one.Photograph(camera, pose, light, options);
  options.threads = 0;
  two.PrepareLight();
  EXPECT_EQ(single.rgb, one.Photograph(camera, pose, light, options).rgb);
  EXPECT_EQ(single.rgb, two.Photograph(camera, pose, light, options).rgb);
}

TEST(RenderLight, PicturesAreFiniteAndNotNegative) {
  Scene scene = Village();
  // Triangles without area, by edge and by point, and one with the same uv everywhere.
  scene.triangles.insert(scene.triangles.end(), {{0, 1, 1}, {2, 2, 2}, {0, 1, 3}});
  scene.positions.insert(scene.positions.end(), {{5, -3, 1}, {6, -3, 1}, {5, -3, 3}});
  scene.uv.insert(scene.uv.end(), 3, Eigen::Vector2f(0.5f, 0.5f));
  const auto last = static_cast<int>(scene.positions.size());
  scene.triangles.emplace_back(last - 3, last - 2, last - 1);
  scene.materials_of.insert(scene.materials_of.end(), 4, 0);
  scene.elements_of.insert(scene.elements_of.end(), 4, 0);
  const Renderer renderer(std::move(scene));
  // Outside, inside a house, on a wall, straight up.
  for (const Pose& pose : {LookAt({-20, -30, 25}, {25, 20, 2}), LookAt({5, 4, 3}, {25, 20, 2}),
                           LookAt({0, 4, 3}, {25, 20, 2}),
                           LookAt({5, -20, 1}, {5, -20, 9}, Eigen::Vector3d::UnitY())}) {
    const Radiance picture = renderer.Photograph(test::Pinhole(80, 60, 50), pose, {});
    for (const float value : picture.rgb) {
      ASSERT_TRUE(std::isfinite(value));
      ASSERT_GE(value, 0);
    }
  }
}

TEST(RenderLight, EmptySceneIsSky) {
  const Renderer renderer{Scene{}};
  const Camera camera = test::Pinhole(8, 8, 10);
  const Pose pose = LookAt({0, 0, 0}, {0, 1, 0.5});
  EXPECT_GT(renderer.Photograph(camera, pose, {}).rgb[0], 0.1f);
  EXPECT_EQ(renderer.Photograph(camera, pose, Albedo()).rgb[0], 0);
  EXPECT_EQ(renderer.Depth(camera, pose).depths[0], 0);
  EXPECT_FALSE(renderer.Cast({0, 0, 0}, {0, 0, 1}));
}

TEST(RenderLight, RefusesWhatCannotBeDrawn) {
  const Renderer renderer(Village());
  Camera camera = test::Pinhole(8, 8, -1);
  EXPECT_THROW(renderer.Photograph(camera, {}, {}), Error);
  Pose lost;
  lost.translation.x() = std::nan("");
  EXPECT_THROW(renderer.Photograph(test::Pinhole(8, 8, 9), lost, {}), Error);
  Scene broken = Village();
  broken.triangles[0].x() = 1 << 20;
  EXPECT_THROW(Renderer{std::move(broken)}, Error);
  broken = Village();
  broken.textures[0].data.pop_back();
  EXPECT_THROW(Renderer{std::move(broken)}, Error);
}

TEST(RenderLight, OvercastSkyIsBrightestAboveAndClearSkyBelow) {
  const Renderer renderer{Scene{}};
  const Camera camera = test::Pinhole(9, 9, 500);
  const auto towards = [&](const Eigen::Vector3d& to, const Light& light) {
    const Radiance picture =
        renderer.Photograph(camera, LookAt({0, 0, 0}, to, {0.1, 0.9, 0.1}), light);
    return picture.rgb[3 * 40 + 1];
  };
  const Light overcast = SkyOnly();
  EXPECT_NEAR(towards({0, 0, 1}, overcast) / towards({1, 0, 1e-3}, overcast), 3, 0.05);
  Light clear;
  clear.to_sun = Eigen::Vector3d(-1, 0, 1).normalized();
  EXPECT_GT(towards({1, 0, 0.02}, clear), 1.5f * towards({0.3, 0, 1}, clear));
}

TEST(SunDirection, EquinoxesAreThoseOf2026) {
  const auto declination_deg = [](int day) {
    return std::asin(SunDirection(0, day, 12).y()) * 180 / std::numbers::pi;
  };
  // 20 March 14:46 and 23 September 00:05 UT, by 0.39 degrees a day.
  EXPECT_NEAR(declination_deg(79), -0.05, 0.02);
  EXPECT_NEAR(declination_deg(266), -0.19, 0.02);
}

TEST(SunDirection, StandsWhereTheAlmanacSays) {
  const auto height = [](const Eigen::Vector3d& to_sun) {
    return std::asin(to_sun.z()) * 180 / std::numbers::pi;
  };
  // Noon at the solstices: 90 - latitude +- 23.44.
  EXPECT_NEAR(height(SunDirection(50, 172, 12)), 63.44, 0.1);
  EXPECT_NEAR(height(SunDirection(50, 355, 12)), 16.56, 0.1);
  // At an equinox (20 March) it rises in the east, at any latitude.
  const Eigen::Vector3d rising = SunDirection(50, 79, 6);
  EXPECT_NEAR(rising.x(), 1, 0.01);
  EXPECT_NEAR(rising.z(), 0, 0.01);
  // South of the tropics it stands in the north at noon.
  EXPECT_GT(SunDirection(-34, 172, 12).y(), 0.7);
  for (int hour = 0; hour < 24; ++hour) {
    EXPECT_NEAR(SunDirection(48.1, 200, hour).norm(), 1, 1e-12);
  }
  EXPECT_LT(SunDirection(48, 172, 15).x(), -0.3);  // afternoon: in the west
}

}  // namespace
}  // namespace stucco::simulate
