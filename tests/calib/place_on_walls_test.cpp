// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/place_on_walls.h"

#include <algorithm>
#include <vector>

#include "tests/calib/expect/made_site.h"
#include "tests/calib/made_bays.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;
using Poses = std::vector<std::optional<KnownPose>>;

// One sure photo of the wall's west end; the next one, and that after it, are known by records
// that are nearer to the next bay.
class PlaceOnWallsTest : public BaysTest {
 protected:
  Poses Place(bool alike) {
    for (const Pose& pose : truth_) Take(pose, alike);
    const Poses known = {KnownPose{truth_[0], {0.05, 0.05}, 1e-3},
                         KnownPose{Moved(truth_[1], kOff), {0.7, 0.7}, 1e-3, true},
                         KnownPose{Moved(truth_[2], -kOff), {0.7, 0.7}, 1e-3, true}};
    const PhotoSet set = Photos();
    return PlaceOnWalls({options_, set, features_, repeating_, known, context_});
  }

  // The second photo shows some more of the bays where one beside it would: a wall at its edge, if
  // walls stood so.
  Poses PlaceBesideAnEdge() {
    for (const Pose& pose : {truth_[0], truth_[1]}) Take(pose, false);
    guidance_.facades[1] = guidance_.facades[0];
    repeating_.period_m[1] = 3;
    for (std::vector<int>& walls : repeating_.wall_of) std::ranges::fill(walls, 1);
    Append(0, SeeBays(truth_[0], false));
    Features edge = SeeBays(Moved(truth_[1], {3, 0, 0}), false);
    edge.keypoints.resize(55);
    Append(1, edge);
    const Poses known = {KnownPose{truth_[0], {0.05, 0.05}, 1e-3},
                         KnownPose{Moved(truth_[1], kOff), {0.7, 0.7}, 1e-3, true}};
    const PhotoSet set = Photos();
    return PlaceOnWalls({options_, set, features_, repeating_, known, context_});
  }

  // Some keypoints of a bay with looks of another.
  static void See(const Pose& pose, int bay, int of_bay, int count, Features& features) {
    for (int i = 0; i < count; ++i) SeeKeypoint(pose, bay, i, 1000 * of_bay + i, features);
  }

  // From the right a bay looks as the one left of it does from the left. The first photo is sure
  // and looks from the left; the second shows both looks and has a good record; the third looks
  // from the right, and its record is nearer to the bay that the first would take it for.
  Poses PlaceFromTheRight() {
    Features left, middle, right;
    for (const int bay : {0, 1, 2}) See(truth_[0], bay, bay, 80, left);
    for (const int bay : {1, 2, 4}) See(truth_[1], bay, bay, 80, middle);
    for (const int bay : {2, 3}) See(truth_[1], bay, bay - 1, 80, middle);
    See(from_right_, 1, 1, 32, right);
    for (const int bay : {2, 3}) See(from_right_, bay, bay - 1, 80, right);
    See(from_right_, 4, 4, 80, right);
    for (const Features* seen : {&left, &middle, &right}) Take(*seen);
    const Poses known = {KnownPose{truth_[0], {0.05, 0.05}, 1e-3},
                         KnownPose{Moved(truth_[1], {0.2, 0, 0}), {0.3, 0.3}, 1e-3, true},
                         KnownPose{Moved(from_right_, {-2, 0, 0}), {0.9, 0.9}, 1e-3, true}};
    const PhotoSet set = Photos();
    return PlaceOnWalls({options_, set, features_, repeating_, known, context_});
  }

  // As of the first wall.
  void Append(size_t photo, const Features& more) {
    Features& all = features_.plain[photo];
    for (size_t i = 0; i < more.keypoints.size(); ++i) {
      all.keypoints.push_back(more.keypoints[i]);
      all.colors.push_back(more.colors[i]);
      all.descriptors.push_back(more.descriptors[i]);
      repeating_.wall_of[photo].push_back(0);
    }
  }

  inline static const Vector3d kOff{1.8, 0.4, -0.3};
  // Of bays 0 to 2, 1 to 4 and 3 to 5.
  const std::vector<Pose> truth_ = {SitePose({5.5, -9, 6}, 0, 0), SitePose({9.5, -9, 6}, 0, 0),
                                    SitePose({14, -9, 6}, 0, 0)};
  const Pose from_right_ = SitePose({10, -9, 6}, 0, 0);
};

TEST_F(PlaceOnWallsTest, GoesAlongTheWallFromWhatIsSure) {
  const Poses placed = Place(false);
  for (const size_t i : {1, 2}) {
    ASSERT_TRUE(placed[i]);
    EXPECT_FALSE(placed[i]->is_recorded) << i;
    EXPECT_LT(placed[i]->sigma_m.maxCoeff(), 0.3);
    EXPECT_LT((placed[i]->cam_from_plan.Center() - truth_[i].Center()).norm(), 0.05) << i;
  }
  EXPECT_EQ(placed[0]->sigma_m[0], 0.05);
}

// Asked of the first photo alone, the third would be told the bay on the left of its own.
TEST_F(PlaceOnWallsTest, TheMostSurelyToldTellTheOthers) {
  const Poses placed = PlaceFromTheRight();
  ASSERT_FALSE(placed[1]->is_recorded);
  EXPECT_LT((placed[1]->cam_from_plan.Center() - truth_[1].Center()).norm(), 0.05);
  ASSERT_FALSE(placed[2]->is_recorded);
  EXPECT_LT((placed[2]->cam_from_plan.Center() - from_right_.Center()).norm(), 0.05);
}

TEST_F(PlaceOnWallsTest, LeavesAsRecordedWhereBaysAreTheSame) {
  const Poses placed = Place(true);
  for (const size_t i : {1, 2}) {
    EXPECT_TRUE(placed[i]->is_recorded);
    EXPECT_EQ(placed[i]->sigma_m[0], 0.7);
  }
}

TEST_F(PlaceOnWallsTest, GoesByTheWallThatFillsThePhoto) {
  const Poses placed = PlaceBesideAnEdge();
  ASSERT_FALSE(placed[1]->is_recorded);
  EXPECT_LT((placed[1]->cam_from_plan.Center() - truth_[1].Center()).norm(), 0.05);
}

}  // namespace
}  // namespace stucco::test
