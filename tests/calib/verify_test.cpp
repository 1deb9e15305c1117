// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/two_view/verify.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "tests/calib/made_scene.h"
#include "tests/survey/support.h"

namespace stucco::test {
namespace {

struct PairCase {
  Scene scene;
  PhotoPair pair;
  std::set<Match> right;
};

PairCase MakePair(MadeOptions options, double wrong) {
  options.num_photos = 2;
  options.arc_rad = 0.35;
  options.seen_share = 1;
  options.model = CameraModel::kPinhole;
  PairCase result{MakeScene(options), {}, {}};
  const PhotoPair right = MatchesOf(result.scene, 0, 1).at(0);
  result.right.insert(right.matches.begin(), right.matches.end());
  result.pair = MatchesOf(result.scene, wrong, 5).at(0);
  return result;
}

std::optional<PairGeometry> Verify(const PairCase& c, const std::vector<Match>& matches) {
  return VerifyPair(c.scene.photos[0].keypoints, c.scene.photos[1].keypoints, matches, {});
}

int CountRight(const PairCase& c, const std::vector<Match>& matches) {
  int count = 0;
  for (const Match& m : matches) count += c.right.contains(m);
  return count;
}

TEST(VerifyPair, KeepsAllExactMatches) {
  const PairCase c = MakePair({.num_points = 200}, 0);
  const auto found = Verify(c, c.pair.matches);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->inliers, c.pair.matches);
  EXPECT_EQ(found->num_fundamental, static_cast<int>(c.pair.matches.size()));
  for (const Match& m : found->inliers) {
    const Eigen::Vector3d a = c.scene.photos[0].keypoints[m.first].homogeneous();
    const Eigen::Vector3d b = c.scene.photos[1].keypoints[m.second].homogeneous();
    const Eigen::Vector3d line = found->fundamental * a;
    EXPECT_LT(std::abs(b.dot(line)) / line.head<2>().norm(), 0.05);  // pixels
  }
}

TEST(VerifyPair, SeesThatTwoWallsAreNoPlane) {
  const PairCase c = MakePair({.num_points = 200}, 0);
  const auto found = Verify(c, c.pair.matches);
  ASSERT_TRUE(found);
  EXPECT_LT(found->num_homography, 0.7 * found->num_fundamental);
}

TEST(VerifyPair, SeesAPlane) {
  const PairCase c = MakePair({.num_points = 300, .num_planes = 1, .clutter_share = 0}, 0);
  const auto found = Verify(c, c.pair.matches);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->num_homography, static_cast<int>(c.pair.matches.size()));
}

TEST(VerifyPair, SurvivesNoise) {
  const PairCase c = MakePair({.num_points = 300, .noise_px = 1}, 0);
  const auto found = Verify(c, c.pair.matches);
  ASSERT_TRUE(found);
  EXPECT_GT(found->num_fundamental, 0.97 * c.pair.matches.size());
}

TEST(VerifyPair, SurvivesHalfWrongMatches) {
  const PairCase c = MakePair({.num_points = 400, .noise_px = 0.5}, 0.5);
  const auto found = Verify(c, c.pair.matches);
  ASSERT_TRUE(found);
  const int right = CountRight(c, found->inliers);
  EXPECT_GT(right, 0.95 * CountRight(c, c.pair.matches));
  // A wrong match may lie on the epipolar line by chance.
  EXPECT_GT(right, 0.9 * found->inliers.size());
  EXPECT_TRUE(std::is_sorted(found->inliers.begin(), found->inliers.end()));
}

TEST(VerifyPair, RefusesRandomMatches) {
  const PairCase c = MakePair({.num_points = 60}, 1);
  Scene scene = c.scene;
  Random random(3);
  std::vector<Eigen::Vector2d> first(40), second(40);
  std::vector<Match> matches;
  for (int i = 0; i < 40; ++i) {
    first[i] = {random.Uniform(0, 1200), random.Uniform(0, 900)};
    second[i] = {random.Uniform(0, 1200), random.Uniform(0, 900)};
    matches.push_back({i, i});
  }
  EXPECT_FALSE(VerifyPair(first, second, matches, {.max_error_px = 1, .min_inliers = 20}));
}

// Matches of points anywhere in the pictures.
struct RandomCase {
  std::vector<Eigen::Vector2d> first;
  std::vector<Eigen::Vector2d> second;
  std::vector<Match> matches;

  void Add(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    matches.push_back({static_cast<int>(first.size()), static_cast<int>(second.size())});
    first.push_back(a);
    second.push_back(b);
  }
};

Eigen::Vector2d Anywhere(Random& random) {
  const double x = random.Uniform(0, 1000);
  return {x, random.Uniform(0, 750)};
}

TEST(VerifyPair, NeverTakesRandomMatches) {
  Random random(5);
  for (const auto& [count, times] : {std::pair(50, 60), {100, 40}, {200, 20}, {500, 4}}) {
    for (int time = 0; time < times; ++time) {
      RandomCase c;
      for (int i = 0; i < count; ++i) c.Add(Anywhere(random), Anywhere(random));
      EXPECT_FALSE(VerifyPair(c.first, c.second, c.matches, {})) << count << " " << time;
    }
  }
}

TEST(VerifyPair, NeverTakesRandomMatchesNearEachOther) {
  Random random(6);
  for (const auto& [count, times] : {std::pair(50, 40), {200, 10}}) {
    for (int time = 0; time < times; ++time) {
      RandomCase c;
      for (int i = 0; i < count; ++i) {
        const Eigen::Vector2d a = Anywhere(random);
        const double dx = random.Uniform(-200, 200);
        c.Add(a, a + Eigen::Vector2d(dx, random.Uniform(-200, 200)));
      }
      EXPECT_FALSE(VerifyPair(c.first, c.second, c.matches, {})) << count << " " << time;
    }
  }
}

TEST(VerifyPair, TakesTwentyRightMatchesOfThirty) {
  for (uint32_t seed = 1; seed <= 20; ++seed) {
    const PairCase c = MakePair({.num_points = 200, .noise_px = 0.5, .seed = seed}, 0);
    RandomCase mixed;
    Random random(seed);
    for (int i = 0; i < 20; ++i) {
      const Match& match = c.pair.matches[i * c.pair.matches.size() / 20];
      mixed.Add(c.scene.photos[0].keypoints[match.first],
                c.scene.photos[1].keypoints[match.second]);
    }
    for (int i = 0; i < 10; ++i) mixed.Add(Anywhere(random), Anywhere(random));
    EXPECT_TRUE(VerifyPair(mixed.first, mixed.second, mixed.matches, {})) << seed;
  }
}

// Level ground looks alike along rows of the picture.
TEST(VerifyPair, RefusesRowsThatMatchAnywhereAlongThem) {
  Random random(7);
  RandomCase c;
  for (int i = 0; i < 120; ++i) {
    const Eigen::Vector2d a = Anywhere(random);
    c.Add(a, {random.Uniform(0, 1000), a.y() + random.Gauss(1)});
  }
  EXPECT_FALSE(VerifyPair(c.first, c.second, c.matches, {}));
}

TEST(VerifyPair, RefusesABandThatOnlyMatchesItself) {
  Random random(8);
  RandomCase c;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector2d a(random.Uniform(0, 1000), random.Uniform(580, 600));
    c.Add(a, {random.Uniform(0, 1000), random.Uniform(580, 600)});
  }
  EXPECT_FALSE(VerifyPair(c.first, c.second, c.matches, {}));
}

// A plane in both pictures, and wrong matches.
PairCase PlaneAndWrong(double wrong) {
  return MakePair({.num_points = 300, .num_planes = 1, .clutter_share = 0, .noise_px = 0.3}, wrong);
}

TEST(VerifyPair, KeepsOnAPlaneWhatThePlaneExplains) {
  const PairCase c = PlaneAndWrong(0.4);
  const auto found = Verify(c, c.pair.matches);
  ASSERT_TRUE(found);
  EXPECT_EQ(CountRight(c, found->inliers), CountRight(c, c.pair.matches));
  EXPECT_GE(CountRight(c, found->inliers), static_cast<int>(found->inliers.size()) - 1);
}

TEST(VerifyPair, TakesMatchesOffAPlaneThatCamerasConfirm) {
  const PairCase c =
      MakePair({.num_points = 400, .num_planes = 1, .clutter_share = 0.08, .noise_px = 0.3}, 0.4);
  const PairCameras cameras{c.scene.CameraOf(0), c.scene.CameraOf(1), 0.02};
  const auto found = VerifyPair(c.scene.photos[0].keypoints, c.scene.photos[1].keypoints,
                                c.pair.matches, {.cameras = cameras});
  const auto without = Verify(c, c.pair.matches);
  ASSERT_TRUE(found && without);
  EXPECT_GT(CountRight(c, found->inliers), 0.97 * CountRight(c, c.pair.matches));
  const auto wrong = [&](const PairGeometry& pair) {
    return static_cast<int>(pair.inliers.size()) - CountRight(c, pair.inliers);
  };
  EXPECT_LE(wrong(*found), wrong(*without));
  EXPECT_LT(wrong(*found), 5);
}

TEST(VerifyPair, KeepsWhatWrongCamerasDoNotExplain) {
  const PairCase c = MakePair({.num_points = 300, .noise_px = 0.3}, 0.2);
  Camera wrong = c.scene.CameraOf(0);
  wrong.params[0] *= 6;
  wrong.params[1] *= 6;
  const auto found = VerifyPair(c.scene.photos[0].keypoints, c.scene.photos[1].keypoints,
                                c.pair.matches, {.cameras = PairCameras{wrong, wrong, 0}});
  ASSERT_TRUE(found);
  EXPECT_GT(CountRight(c, found->inliers), 0.9 * CountRight(c, c.pair.matches));
}

TEST(VerifyPair, RefusesTooFewMatches) {
  const PairCase c = MakePair({.num_points = 100}, 0);
  EXPECT_FALSE(Verify(c, {}));
  EXPECT_FALSE(Verify(c, {c.pair.matches.begin(), c.pair.matches.begin() + 14}));
  EXPECT_TRUE(Verify(c, {c.pair.matches.begin(), c.pair.matches.begin() + 25}));
}

TEST(VerifyPair, SurvivesDegenerateMatches) {
  const std::vector<Eigen::Vector2d> same(30, Eigen::Vector2d(100, 100));
  std::vector<Match> matches;
  for (int i = 0; i < 30; ++i) matches.push_back({i, i});
  EXPECT_NO_THROW(VerifyPair(same, same, matches, {}));
  std::vector<Eigen::Vector2d> line;
  for (int i = 0; i < 30; ++i) line.emplace_back(10.0 * i, 20.0 * i);
  EXPECT_NO_THROW(VerifyPair(line, line, matches, {}));
}

TEST(VerifyPair, IsRepeatable) {
  const PairCase c = MakePair({.num_points = 300, .noise_px = 0.5}, 0.4);
  EXPECT_EQ(Serialize(Verify(c, c.pair.matches)), Serialize(Verify(c, c.pair.matches)));
}

TEST(SerializePair, ReadsBack) {
  const PairCase c = MakePair({.num_points = 100}, 0.2);
  const auto pair = Verify(c, c.pair.matches);
  const auto back = DeserializePair(Serialize(pair));
  ASSERT_TRUE(pair && back);
  EXPECT_EQ(back->inliers, pair->inliers);
  EXPECT_EQ(back->fundamental, pair->fundamental);
  EXPECT_EQ(back->num_fundamental, pair->num_fundamental);
  EXPECT_EQ(back->num_homography, pair->num_homography);
  EXPECT_FALSE(DeserializePair(Serialize(std::nullopt)));
}

TEST(SerializePair, RefusesCutBytes) {
  const PairCase c = MakePair({.num_points = 100}, 0);
  const std::string bytes = Serialize(Verify(c, c.pair.matches));
  for (const size_t length : {size_t{1}, size_t{79}, bytes.size() - 1, bytes.size() - 7}) {
    ExpectBadInput([&] { DeserializePair(std::string_view(bytes).substr(0, length)); }, "damaged");
  }
}

struct RayCase {
  std::vector<Eigen::Vector2d> first;
  std::vector<Eigen::Vector2d> second;
  Pose second_from_first;
};

RayCase RaysOf(const PairCase& c) {
  RayCase rays;
  const Camera& camera = c.scene.CameraOf(0);
  for (const Match& m : c.pair.matches) {
    rays.first.push_back(*camera.Unproject(c.scene.photos[0].keypoints[m.first]));
    rays.second.push_back(*camera.Unproject(c.scene.photos[1].keypoints[m.second]));
  }
  rays.second_from_first = *c.scene.photos[1].pose * c.scene.photos[0].pose->Inverse();
  rays.second_from_first.translation.normalize();
  return rays;
}

TEST(EstimateRelativePose, RecoversExactMotion) {
  const PairCase c = MakePair({.num_points = 200}, 0);
  const RayCase rays = RaysOf(c);
  const auto found = EstimateRelativePose(rays.first, rays.second, 0.004);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->num_inliers, static_cast<int>(rays.first.size()));
  EXPECT_LT(found->second_from_first.rotation.angularDistance(rays.second_from_first.rotation),
            1e-4);
  EXPECT_LT((found->second_from_first.translation - rays.second_from_first.translation).norm(),
            1e-3);
  EXPECT_NEAR(found->median_angle_rad, 0.35, 0.15);
}

TEST(EstimateRelativePose, SurvivesNoiseAndWrongMatches) {
  const PairCase c = MakePair({.num_points = 400, .noise_px = 0.5}, 0.4);
  const RayCase rays = RaysOf(c);
  const auto found = EstimateRelativePose(rays.first, rays.second, 0.004);
  ASSERT_TRUE(found);
  // Turning and moving sideways look much alike: the adjustment that follows tells them apart.
  EXPECT_LT(found->second_from_first.rotation.angularDistance(rays.second_from_first.rotation),
            0.04);
  EXPECT_LT((found->second_from_first.translation - rays.second_from_first.translation).norm(),
            0.1);
}

TEST(EstimateRelativePose, RefusesTooFewRays) {
  const PairCase c = MakePair({.num_points = 200}, 0);
  RayCase rays = RaysOf(c);
  rays.first.resize(7);
  rays.second.resize(7);
  EXPECT_FALSE(EstimateRelativePose(rays.first, rays.second, 0.004));
  EXPECT_FALSE(EstimateRelativePose({}, {}, 0.004));
}

TEST(CountRotationInliers, CountsRaysThatTurnTogether) {
  Random random(2);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.2, 1, 0.1).normalized()));
  std::vector<Eigen::Vector2d> first, second;
  for (int i = 0; i < 100; ++i) {
    first.emplace_back(random.Uniform(-0.5, 0.5), random.Uniform(-0.4, 0.4));
    second.push_back((turn * first.back().homogeneous()).hnormalized());
    if (i >= 60) second.back() += Eigen::Vector2d(0.1, i % 2 == 0 ? 0.1 : -0.1);
  }
  EXPECT_EQ(CountRotationInliers(first, second, 0.002, 1), 60);
  EXPECT_EQ(CountRotationInliers(first, second, 0.002, 2), 60);
}

TEST(CountRotationInliers, FewWhereTheCameraMoved) {
  const PairCase c = MakePair({.num_points = 200}, 0);
  const RayCase rays = RaysOf(c);
  EXPECT_LT(CountRotationInliers(rays.first, rays.second, 0.004, 1), 0.5 * rays.first.size());
}

TEST(CountRotationInliers, NeedsTwoRays) {
  EXPECT_EQ(CountRotationInliers({}, {}, 0.01, 1), 0);
  EXPECT_EQ(CountRotationInliers({{0, 0}}, {{0, 0}}, 0.01, 1), 0);
}

}  // namespace
}  // namespace stucco::test
