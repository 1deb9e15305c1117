// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/planned_views.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

Plan PlanOf(const std::vector<std::string>& ids) {
  Plan plan;
  for (const std::string& id : ids) plan.views.emplace_back().id = id;
  return plan;
}

CapturedPhoto Photo(const std::string& path, bool usable = true, const std::string& time = "") {
  CapturedPhoto photo;
  photo.path = path;
  photo.usable = usable;
  photo.capture_time = time;
  return photo;
}

TEST(MatchToPlan, FindsIdsAtTheEndOfNames) {
  std::vector<CapturedPhoto> photos = {Photo("a/DJI_20260301120000_0007_D_h0003v1.JPG"),
                                       Photo("h0001v1/DJI_0008.JPG"), Photo("h0004v1.jpeg")};
  const auto views = MatchToPlan(PlanOf({"h0001v1", "h0003v1", "h0004v1"}), photos);
  ASSERT_EQ(views.size(), 3u);
  EXPECT_EQ(views[0].status, "missing");  // the folder's name is none of the photo's
  EXPECT_EQ(views[1].status, "captured");
  EXPECT_EQ(views[1].photo, photos[0].path);
  EXPECT_EQ(photos[0].view, "h0003v1");
  EXPECT_EQ(photos[1].view, "");
  EXPECT_EQ(photos[2].view, "h0004v1");
}

TEST(MatchToPlan, APartOfAWordIsNoId) {
  std::vector<CapturedPhoto> photos = {Photo("xh0001v1.jpg"), Photo("h0001v12.jpg")};
  EXPECT_EQ(MatchToPlan(PlanOf({"h0001v1"}), photos)[0].status, "missing");
}

TEST(MatchToPlan, OfTwoPhotosTheFirstUsableOneIsTheView) {
  std::vector<CapturedPhoto> photos = {Photo("1_v1.jpg", false, "2026:03:01 12:00:00"),
                                       Photo("2_v1.jpg", true, "2026:03:01 12:00:09"),
                                       Photo("3_v1.jpg", true, "2026:03:01 12:00:05")};
  const auto views = MatchToPlan(PlanOf({"v1"}), photos);
  EXPECT_EQ(views[0].photo, "3_v1.jpg");
  EXPECT_EQ(photos[0].view + photos[1].view, "");
}

TEST(MatchToPlan, AnUnusablePhotoIsNamed) {
  std::vector<CapturedPhoto> photos = {Photo("v1.jpg", false)};
  const auto views = MatchToPlan(PlanOf({"v1"}), photos);
  EXPECT_EQ(views[0].status, "unusable");
  EXPECT_EQ(views[0].photo, "v1.jpg");
}

}  // namespace
}  // namespace stucco
