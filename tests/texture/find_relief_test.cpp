// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/find_relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "tests/texture/wall_survey.h"
#include "texture/grid/relief_file.h"

namespace stucco::test {
namespace {

const Balcony kBalcony = {{1.3, 1.2}, {2.7, 2.0}, 0.6};

// Five photos, none of them straight before the balcony.
void AddPhotosOfBalcony(WallSurvey& survey,
                        const Scene& scene = BalconyScene(kBalcony, WallScene(4, 3))) {
  survey.Add("a.jpg", {4.6, -4.0, 1.7}, {2, 0, 1.5}, 1, scene);
  survey.Add("b.jpg", {-0.6, -4.0, 1.6}, {2, 0, 1.5}, 1, scene);
  survey.Add("c.jpg", {2.8, -4.0, 3.9}, {2, 0, 1.5}, 1, scene);
  survey.Add("d.jpg", {1.2, -4.0, 3.2}, {2, 0, 1.5}, 1, scene);
  survey.Add("e.jpg", {3.4, -4.2, 0.4}, {2, 0, 1.5}, 1, scene);
}

std::shared_ptr<const Relief> ReliefOf(const WallSurvey& survey, double texel_size) {
  TextureOptions options;
  options.texel_size = texel_size;
  survey.Run(options);
  return ReadRelief(survey.Out(), "B0001_W01");
}

TEST(RunTexture, PaintsABalconyWhereItIs) {
  WallSurvey survey;
  AddPhotosOfBalcony(survey);
  TextureOptions options;
  options.texel_size = 0.01;
  const auto psnr = [&](const std::string& out) {
    const TexturedFacet facet = survey.Run(options, out).facets.at(0);
    std::vector<uint8_t> seen;
    const Image labels = survey.Labels(facet, out);
    for (const uint8_t label : labels.data) seen.push_back(label != 0 && label != 255);
    return Psnr(survey.Picture(facet, out), WallPicture(GridOf(facet), kBalcony), seen);
  };
  const double with = psnr("with");
  const auto relief = ReadRelief(survey.Out("with"), "B0001_W01");
  ASSERT_NE(relief, nullptr);
  EXPECT_NEAR(relief->HeightAt(2.0, 3 - 1.6), kBalcony.depth, 0.08);  // v points down
  EXPECT_NEAR(relief->HeightAt(0.5, 3 - 1.6), 0, 0.05);
  options.relief = false;
  const double without = psnr("without");
  EXPECT_EQ(ReadRelief(survey.Out("without"), "B0001_W01"), nullptr);
  EXPECT_GT(with, 22);
  EXPECT_GT(with, without + 4);
}

// Photos from above, which the balcony hides the wall below it from, show its lower edge there.
TEST(RunTexture, KeepsAWallBelowABalconyStraight) {
  WallSurvey survey;
  const auto plain_below = [wall = WallScene(4, 3)](const Eigen::Vector3d& from,
                                                    const Eigen::Vector3d& way) {
    const auto colour = wall(from, way);
    const double z = from.z() - from.y() / way.y() * way.z();
    return colour && z < kBalcony.low.y() ? Colour(Colour::Constant(140 + 20 * std::sin(2 * z)))
                                          : colour;
  };
  const auto scene = BalconyScene(kBalcony, plain_below);
  survey.Add("a.jpg", {4.4, -2.2, 5.6}, {2, 0, 1.5}, 1, scene);
  survey.Add("b.jpg", {3.2, -2.2, 5.6}, {2, 0, 1.5}, 1, scene);
  survey.Add("c.jpg", {2.0, -2.2, 5.6}, {2, 0, 1.5}, 1, scene);
  survey.Add("d.jpg", {0.8, -2.2, 5.6}, {2, 0, 1.5}, 1, scene);
  survey.Add("e.jpg", {-0.4, -2.2, 5.6}, {2, 0, 1.5}, 1, scene);
  survey.Add("f.jpg", {2.0, -4.5, 1.8}, {2, 0, 1.5}, 1, scene);
  const auto relief = ReliefOf(survey, 0.01);
  ASSERT_NE(relief, nullptr);
  EXPECT_NEAR(relief->HeightAt(2.0, 3 - 1.6), kBalcony.depth, 0.08);
  for (double u = 0.1; u < 4; u += 0.1) {
    for (double v = 3 - 1.1; v < 3; v += 0.1) EXPECT_NEAR(relief->HeightAt(u, v), 0, 0.03);
  }
}

// A plain front looks alike on any plane, and noise on some more: its rim says where it is.
TEST(RunTexture, ABalconyWithAPlainFrontHasNoHole) {
  const Balcony panel = {{0.7, 0.8}, {3.3, 2.2}, 0.6};
  const auto plain = [&, scene = BalconyScene(panel, WallScene(4, 3))](const Eigen::Vector3d& from,
                                                                       const Eigen::Vector3d& way) {
    const Eigen::Vector3d front = from + (-panel.depth - from.y()) / way.y() * way;
    const bool hit = front.x() > panel.low.x() && front.x() < panel.high.x() &&
                     front.z() > panel.low.y() && front.z() < panel.high.y();
    if (!hit) return scene(from, way);
    const double noise = 7 * std::sin(1e5 * way.x()) * std::sin(1e5 * way.z());
    return std::optional(Colour(Colour::Constant(25 + noise)));
  };
  WallSurvey survey;
  AddPhotosOfBalcony(survey, plain);
  const auto relief = ReliefOf(survey, 0.01);
  ASSERT_NE(relief, nullptr);
  for (double x = 0.85; x < 3.2; x += 0.1) {
    for (double z = 0.95; z < 2.1; z += 0.1) {
      EXPECT_NEAR(relief->HeightAt(x, 3 - z), panel.depth, 0.08) << x << " " << z;
    }
  }
}

// Most photos look from above, where the upper balcony hides the wall between from them.
TEST(RunTexture, TheWallBetweenTwoBalconiesStaysBack) {
  const Balcony lower = {{1.0, 0.8}, {3.0, 2.0}, 0.6};
  const Balcony upper = {{1.0, 2.8}, {3.0, 4.0}, 0.6};
  const Scene scene = BalconyScene(lower, BalconyScene(upper, WallScene(4, 5)));
  WallSurvey survey;
  survey.SetProxy(MakeProxy({MakeWall(4, 5)}));
  const Eigen::Vector3d middle(2, 0, 2.5);
  survey.Add("a.jpg", {4.0, -5.5, 2.5}, middle, 1, scene);
  survey.Add("b.jpg", {0.5, -5.5, 2.3}, middle, 1, scene);
  for (int i = 0; i < 4; ++i) {
    survey.Add(std::to_string(i) + ".jpg", {-1.0 + 2 * i, -4.5, 7.5}, middle, 1, scene);
  }
  const auto relief = ReliefOf(survey, 0.01);
  ASSERT_NE(relief, nullptr);
  for (double x = 1.2; x < 2.9; x += 0.2) {
    EXPECT_NEAR(relief->HeightAt(x, 5 - 1.4), 0.6, 0.08) << x;
    EXPECT_NEAR(relief->HeightAt(x, 5 - 3.4), 0.6, 0.08) << x;
    EXPECT_NEAR(relief->HeightAt(x, 5 - 2.4), 0, 0.05) << x;
  }
}

// No photo shows a quarter of this wall.
TEST(RunTexture, FindsTheBalconiesOfALongWallAtBothEnds) {
  constexpr double kLength = 18;
  const Balcony first = {{1.3, 1.2}, {2.7, 2.0}, 0.6};
  const Balcony last = {{15.3, 1.2}, {16.7, 2.0}, 0.6};
  const Scene scene = BalconyScene(first, BalconyScene(last, WallScene(kLength, 3)));
  WallSurvey survey;
  survey.SetProxy(MakeProxy({MakeWall(kLength, 3)}));
  for (int i = 0; i < 10; ++i) {
    const double x = 0.9 + 1.8 * i;
    survey.Add(std::to_string(i) + "a.jpg", {x, -4, 1.7}, {x, 0, 1.5}, 1, scene);
    survey.Add(std::to_string(i) + "b.jpg", {x + 0.4, -4, 3.6}, {x, 0, 1.5}, 1, scene);
  }
  const auto relief = ReliefOf(survey, 0.02);
  ASSERT_NE(relief, nullptr);
  for (const double x : {2.0, 16.0}) EXPECT_NEAR(relief->HeightAt(x, 3 - 1.6), 0.6, 0.08) << x;
  for (const double x : {5.0, 9.0, 13.0}) EXPECT_NEAR(relief->HeightAt(x, 3 - 1.6), 0, 0.05) << x;
}

struct Window {
  Eigen::Vector2d low;  // x and z
  Eigen::Vector2d high;
  double depth = 0;    // of the sash behind the wall
  double sash = 0.3;   // its width around the pane
  double room = 0.25;  // from there to what the pane shows
};

// A window in the wall of MakeWall; through its pane one sees what is farther off.
Scene WindowScene(const Window& window, const Scene& wall) {
  return [=](const Eigen::Vector3d& from, const Eigen::Vector3d& way) -> std::optional<Colour> {
    const auto at = [&](double y) -> Eigen::Vector2d {
      const Eigen::Vector3d point = from + (y - from.y()) / way.y() * way;
      return {point.x(), point.z()};
    };
    const auto within = [&](const Eigen::Vector2d& p, double margin) {
      return (p.array() > window.low.array() + margin).all() &&
             (p.array() < window.high.array() - margin).all();
    };
    if (way.y() <= 0 || !within(at(0), 0)) return wall(from, way);
    const Eigen::Vector2d on_sash = at(window.depth);
    if (!within(on_sash, 0)) return Colour::Constant(110);
    if (!within(on_sash, window.sash)) return BalconyColour(on_sash.x(), on_sash.y());
    const Eigen::Vector2d in_room = at(window.depth + window.room);
    return WallColour(in_room.x() + 2.3, in_room.y() + 0.9);
  };
}

// What a pane shows does not tell that the pane lies where its sash does.
TEST(RunTexture, AWindowLiesBackAsAWhole) {
  const Window window = {{1.2, 0.9}, {2.6, 2.3}, 0.3};
  WallSurvey survey;
  const Scene scene = WindowScene(window, WallScene(4, 3));
  survey.Add("a.jpg", {3.2, -4.0, 1.8}, {2, 0, 1.5}, 1, scene);
  survey.Add("b.jpg", {0.8, -4.0, 1.7}, {2, 0, 1.5}, 1, scene);
  survey.Add("c.jpg", {2.1, -4.0, 2.7}, {2, 0, 1.5}, 1, scene);
  survey.Add("d.jpg", {1.9, -4.0, 0.5}, {2, 0, 1.5}, 1, scene);
  const auto relief = ReliefOf(survey, 0.01);
  ASSERT_NE(relief, nullptr);
  for (double x = window.low.x() + 0.15; x < window.high.x() - 0.1; x += 0.1) {
    for (double z = window.low.y() + 0.15; z < window.high.y() - 0.1; z += 0.1) {
      EXPECT_NEAR(relief->HeightAt(x, 3 - z), -window.depth, 0.06) << x << " " << z;
    }
  }
  for (const double x : {0.5, 3.4}) EXPECT_NEAR(relief->HeightAt(x, 1.5), 0, 0.05);
}

// Plain plaster between rows of windows looks alike as far back as they lie.
TEST(RunTexture, PlainWallsStayBeforeTheirWindows) {
  constexpr double kLength = 6;
  constexpr double kHeight = 5;
  constexpr double kDepth = 0.3;
  constexpr double kSash = 0.5;  // all of it but a slit
  Scene scene = [wall = WallScene(kLength, kHeight)](const Eigen::Vector3d& from,
                                                     const Eigen::Vector3d& way) {
    const auto colour = wall(from, way);
    const double z = from.z() - from.y() / way.y() * way.z();
    return colour ? Colour(Colour::Constant(140 + 10 * std::sin(2 * z))) : colour;
  };
  for (const double x : {0.8, 2.5, 4.2}) {
    for (const double z : {0.7, 2.8}) {
      scene = WindowScene({{x, z}, {x + 1.1, z + 1.4}, kDepth, kSash}, scene);
    }
  }
  WallSurvey survey;
  survey.SetProxy(MakeProxy({MakeWall(kLength, kHeight)}));
  const Eigen::Vector3d middle(3, 0, 2.5);
  survey.Add("a.jpg", {5.0, -6.0, 2.8}, middle, 1, scene);
  survey.Add("b.jpg", {1.0, -6.0, 2.7}, middle, 1, scene);
  survey.Add("c.jpg", {3.1, -6.0, 4.5}, middle, 1, scene);
  survey.Add("d.jpg", {2.9, -6.0, 0.8}, middle, 1, scene);
  const auto relief = ReliefOf(survey, 0.02);
  ASSERT_NE(relief, nullptr);
  for (const double x : {1.35, 3.05, 4.75}) {
    for (const double z : {1.4, 3.5}) EXPECT_NEAR(relief->HeightAt(x, kHeight - z), -kDepth, 0.08);
    EXPECT_NEAR(relief->HeightAt(x, kHeight - 2.45), 0, 0.03) << x;
  }
  for (const double x : {0.3, 2.2, 3.9, 5.7}) {
    for (double z = 0.5; z < 4.5; z += 0.2) {
      EXPECT_NEAR(relief->HeightAt(x, kHeight - z), 0, 0.03) << x << " " << z;
    }
  }
}

TEST(RunTexture, FindsNoReliefOnAFlatWall) {
  WallSurvey survey;
  survey.Add("a.jpg", {4.6, -4.0, 1.7}, {2, 0, 1.5});
  survey.Add("b.jpg", {-0.6, -4.0, 1.6}, {2, 0, 1.5});
  survey.Add("c.jpg", {2.8, -4.0, 3.9}, {2, 0, 1.5});
  survey.Run();
  EXPECT_EQ(ReadRelief(survey.Out(), "B0001_W01"), nullptr);
}

}  // namespace
}  // namespace stucco::test
