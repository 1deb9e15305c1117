// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/plan_prior.h"

#include <gtest/gtest.h>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

std::vector<TexturePhoto> Photos(const std::vector<std::string>& names) {
  std::vector<TexturePhoto> photos;
  for (const std::string& name : names) {
    photos.push_back(testing::LookFrom(name, {2, -5, 1}, {2, 0, 1}, 100, 100, 100));
  }
  return photos;
}

PlannedView View(const std::string& id, const std::vector<std::string>& facades) {
  PlannedView view;
  view.id = id;
  for (const std::string& facade : facades) view.targets.push_back({facade, {0, 4}, {0, 3}});
  return view;
}

TEST(PlanPrior, PhotosKnowWhatTheyAreFor) {
  Plan plan;
  plan.views = {View("h0v0", {"B0007/F02"}), View("h0v1", {"B0007/F02", "B0007/F03"}),
                View("h1v0", {"B0007/F03"})};
  std::map<std::string, CapturedPhoto> captures;
  captures["a.jpg"].view = "h0v0";
  captures["b.jpg"].view = "h0v1";
  captures["c.jpg"].view = "";         // extra
  captures["d.jpg"].view = "unknown";  // of another plan
  std::vector<TexturePhoto> photos = Photos({"a.jpg", "b.jpg", "c.jpg", "d.jpg", "new.jpg"});
  KnowPlan(plan, captures, photos);
  Facet wall = testing::MakeWall(4, 3);
  wall.facade = "B0007/F03";
  EXPECT_FALSE(IsPlannedFor(wall, photos[0]));
  EXPECT_TRUE(IsPlannedFor(wall, photos[1]));
  for (size_t i = 2; i < photos.size(); ++i) EXPECT_FALSE(IsPlannedFor(wall, photos[i]));

  const std::vector<int> all = {0, 1, 2, 3, 4};
  EXPECT_EQ(PriorCosts(wall, photos, all), (std::vector<float>{kUnplannedCost, 0, kUnplannedCost,
                                                               kUnplannedCost, kUnplannedCost}));
  // Where no planned photo takes part, nothing is preferred.
  const std::vector<int> others = {0, 2, 3};
  EXPECT_EQ(PriorCosts(wall, photos, others), (std::vector<float>{0, 0, 0}));
  EXPECT_TRUE(PriorCosts(wall, photos, {}).empty());
}

TEST(PlanPrior, PhotosOfEveryFacadeThatAWallSpansAreMeantForIt) {
  std::vector<TexturePhoto> photos = Photos({"a.jpg", "b.jpg"});
  photos[0].facades = {"B0007/F02"};
  photos[1].facades = {"B0008/F00"};
  Facet wall = testing::MakeWall(4, 3);
  wall.facade = "B0007/F02";
  EXPECT_FALSE(IsPlannedFor(wall, photos[1]));
  wall.other_facades = {"B0008/F00"};
  EXPECT_TRUE(IsPlannedFor(wall, photos[0]));
  EXPECT_TRUE(IsPlannedFor(wall, photos[1]));
}

TEST(PlanPrior, AWallThatIsNotInThePlanHasNoPlannedPhotos) {
  std::vector<TexturePhoto> photos = Photos({"a.jpg"});
  Facet wall = testing::MakeWall(4, 3);
  wall.facade = wall.id;
  photos[0].facades = {wall.id};  // a plan whose ids look like ours
  EXPECT_FALSE(IsPlannedFor(wall, photos[0]));
}

}  // namespace
}  // namespace stucco
