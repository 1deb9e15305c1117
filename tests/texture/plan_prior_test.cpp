// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/plan_prior.h"

#include <gtest/gtest.h>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

std::vector<SurveyPhoto> Photos(const std::vector<std::string>& names) {
  std::vector<SurveyPhoto> photos;
  for (const std::string& name : names) {
    photos.push_back(test::LookFrom(name, {2, -5, 1}, {2, 0, 1}, {100, 100, 100}));
  }
  return photos;
}

TEST(PlanPrior, PrefersThePhotosThatAreMeantForTheFacade) {
  std::vector<SurveyPhoto> photos = Photos({"a.jpg", "b.jpg", "c.jpg", "d.jpg", "new.jpg"});
  photos[0].planned_facades = {"B0007/F02"};
  photos[1].planned_facades = {"B0007/F02", "B0007/F03"};
  Facet wall = test::MakeWall(4, 3);
  wall.planned_facades = {"B0007/F03"};
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
  std::vector<SurveyPhoto> photos = Photos({"a.jpg", "b.jpg"});
  photos[0].planned_facades = {"B0007/F02"};
  photos[1].planned_facades = {"B0008/F00"};
  Facet wall = test::MakeWall(4, 3);
  wall.planned_facades = {"B0007/F02"};
  EXPECT_FALSE(IsPlannedFor(wall, photos[1]));
  wall.planned_facades.push_back("B0008/F00");
  EXPECT_TRUE(IsPlannedFor(wall, photos[0]));
  EXPECT_TRUE(IsPlannedFor(wall, photos[1]));
}

TEST(PlanPrior, AWallThatIsNotInThePlanHasNoPlannedPhotos) {
  std::vector<SurveyPhoto> photos = Photos({"a.jpg"});
  Facet wall = test::MakeWall(4, 3);
  photos[0].planned_facades = {wall.id};  // a plan whose ids look like ours
  EXPECT_FALSE(IsPlannedFor(wall, photos[0]));
}

}  // namespace
}  // namespace stucco
