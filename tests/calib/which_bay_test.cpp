// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/which_bay.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "calib/features/descriptors.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using Eigen::Vector2d;

constexpr double kBay_m = 2.5;
constexpr int kOfBay = 40;

// Eight bays beside each other; in each of two storeys. Of the keypoints of a bay those from
// `alike` on differ from the ones in the other bays.
struct Facade {
  int alike = 20;
  double noise = 15;
  // From where a bay is seen shows in what it looks like: of each next one by so much.
  double per_bay = 0;
  int bays_beside = 0;  // as the bays so many farther look to the others

  // What one photo finds of the bays [from, to): descriptors with its own noise, places where
  // `posed` puts them.
  WallKeypoints See(int from, int to, const WallFromWall& posed, int photo) const {
    WallKeypoints seen;
    std::vector<float> rows;
    Random random(70 + photo);
    std::array<double, kDescriptorSize> turned;
    Random turn(60);
    for (double& value : turned) value = turn.Uniform(-per_bay, per_bay);
    for (int bay = from; bay < to; ++bay) {
      for (int i = 0; i < kOfBay; ++i) {
        Random place(100 + i);
        const double x = kBay_m * bay + place.Uniform(0, kBay_m);
        const Vector2d at = posed * Eigen::Vector3d(x, place.Uniform(0, 6), 1);
        seen.places.push_back({static_cast<float>(at.x()), static_cast<float>(at.y()), 0.05F});
        Random look(i < alike ? 500 + i : 5000 + i + kOfBay * bay);
        for (int k = 0; k < kDescriptorSize; ++k) {
          const double value = look.Uniform(0, 100) + (bay + bays_beside) * turned[k] +
                               random.Uniform(-noise, noise);
          rows.push_back(static_cast<float>(std::max(0.0, value)));
        }
      }
    }
    seen.descriptors = UnitRows(rows);
    return seen;
  }
};

WallFromWall Posed(const Vector2d& shift, double scale) {
  WallFromWall posed;
  posed << scale, 0, shift.x(), 0, scale, shift.y();
  return posed;
}

// Both photos show six of the eight bays.
std::optional<ToldBay> Tell(const Facade& facade, const WallFromWall& second_posed,
                            const Vector2d& sigma_m, int first_beside = 0) {
  Facade to_first = facade;
  to_first.bays_beside = first_beside;
  const WallKeypoints first = to_first.See(0, 6, Posed({0, 0}, 1), 1);
  const WallKeypoints second = facade.See(2, 8, second_posed, 2);
  const double left = 2 * kBay_m + second_posed(0, 2);
  return TellBay(
      {first, {&second}, sigma_m, [&](const Vector2d& place) { return place.x() > left; }});
}

TEST(TellBay, FindsTheBayThatDiffersFromTheOthersInHalfOfItsKeypoints) {
  // Nearer to the next bay than to the right one, and two hundredths too large.
  const WallFromWall posed = Posed({-1.7, 0.6}, 1.02);
  const auto told = Tell({20}, posed, {1, 1});
  ASSERT_TRUE(told);
  for (const Vector2d& at : {Vector2d(6, 1), Vector2d(10, 3), Vector2d(14, 5)}) {
    EXPECT_LT((told->from * at.homogeneous() - posed * at.homogeneous()).norm(), 0.05);
  }
}

TEST(TellBay, IsOfTwoMindsWhereBaysAreTheSame) {
  EXPECT_FALSE(Tell({kOfBay}, Posed({-1.7, 0.6}, 1.02), {1, 1}));
  EXPECT_FALSE(Tell({kOfBay}, Posed({0, 0}, 1), {1, 1}));
  EXPECT_FALSE(Tell({kOfBay - 1}, Posed({0, 0}, 1), {1, 1}));  // too few to tell
}

TEST(TellBay, IsNotFooledByWhereBaysThatAreTheSameAreSeenFrom) {
  // The first photo sees each bay as the second one sees the next: all keypoints side with that.
  Facade facade{kOfBay, 5, 20};
  EXPECT_FALSE(Tell(facade, Posed({0.4, 0.1}, 1), {1, 1}, 1));
  // Not so where the next bay is another.
  facade.alike = 0;
  EXPECT_TRUE(Tell(facade, Posed({0.4, 0.1}, 1), {1, 1}, 1));
}

TEST(TellBay, BelievesNoShiftThatPosesRuleOut) {
  EXPECT_FALSE(Tell({20}, Posed({-1.7, 0.6}, 1.02), {0.3, 0.3}));
}

TEST(TellBay, TakesTogetherWhatOthersShow) {
  const Facade facade{30};  // of a bay's keypoints ten differ from the next one's
  const WallKeypoints first = facade.See(2, 6, Posed({-1.7, 0.6}, 1.02), 1);
  const WallKeypoints west = facade.See(0, 4, Posed({0, 0}, 1), 2);
  const WallKeypoints east = facade.See(4, 8, Posed({0, 0}, 1), 3);
  const auto tell = [&](std::vector<const WallKeypoints*> others, double from, double to) {
    return TellBay({first, std::move(others), {1, 1}, [&](const Vector2d& place) {
                      return place.x() > from && place.x() < to;
                    }});
  };
  EXPECT_FALSE(tell({&west}, 0, 4 * kBay_m));
  EXPECT_FALSE(tell({&east}, 4 * kBay_m, 8 * kBay_m));
  const auto told = tell({&west, &east}, 0, 8 * kBay_m);
  ASSERT_TRUE(told);
  const Vector2d back =
      told->from * (Posed({-1.7, 0.6}, 1.02) * Vector2d(10, 3).homogeneous()).homogeneous();
  EXPECT_LT((back - Vector2d(10, 3)).norm(), 0.05);
}

TEST(TellBay, IsNotToldTheBayOnTheOtherSideOfTheRightOne) {
  // Off by 3.7 standard deviations, so that the bay that lies 3.4 to the other side is the nearest.
  EXPECT_FALSE(Tell({20}, Posed({-1.3, 0}, 1), {0.35, 0.35}));
  EXPECT_FALSE(Tell({kOfBay}, Posed({-1.3, 0}, 1), {0.35, 0.35}));
}

TEST(TellBay, AsksLessOfKeypointsWherePosesSpeakToo) {
  // Of 160 keypoints that both photos show, 28 differ between bays.
  const Facade facade{33};
  EXPECT_FALSE(Tell(facade, Posed({-0.1, 0.1}, 1), {2, 2}));
  EXPECT_TRUE(Tell(facade, Posed({-0.1, 0.1}, 1), {0.8, 0.8}));
}

TEST(TellBay, NeedNotOutvoteWhatPosesRuleOut) {
  // The next bay looks the same, and lies six standard deviations off.
  const auto told = Tell({kOfBay}, Posed({-0.1, 0.1}, 1), {0.45, 0.45});
  ASSERT_TRUE(told);
  EXPECT_TRUE(std::isinf(told->sureness));
}

TEST(TellBay, IsSurerTheMoreSideWithIt) {
  const auto few = Tell({25}, Posed({-0.1, 0.1}, 1), {1, 1});
  const auto many = Tell({0}, Posed({-0.1, 0.1}, 1), {1, 1});
  ASSERT_TRUE(few && many);
  EXPECT_GE(few->sureness, 1);
  EXPECT_GT(many->sureness, few->sureness);
}

TEST(TellBay, KnowsAlongTheWallApartFromUp) {
  const WallFromWall posed = Posed({-0.1, 0.1}, 1);
  EXPECT_TRUE(Tell({kOfBay}, posed, {0.45, 2}));
  EXPECT_FALSE(Tell({kOfBay}, posed, {2, 0.45}));
}

TEST(TellBay, SaysNothingOfNothing) {
  const WallKeypoints none;
  const auto everywhere = [](const Vector2d&) { return true; };
  EXPECT_FALSE(TellBay({none, {&none}, {1, 1}, everywhere}));
  const WallKeypoints some = Facade{}.See(0, 2, Posed({0, 0}, 1), 1);
  EXPECT_FALSE(TellBay({some, {&none}, {1, 1}, everywhere}));
  EXPECT_FALSE(TellBay({none, {&some}, {1, 1}, everywhere}));
}

}  // namespace
}  // namespace stucco::test
