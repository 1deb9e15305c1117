// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/two_view/panorama.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class DescribePanoramasTest : public testing::Test {
 protected:
  // Photos 0 to 2 turn on the spot, 3 and 4 match with each other, 5 and 6 with none.
  DescribePanoramasTest() : captured_(7) {
    scene_.photos.resize(captured_.size());
    scene_.tracks_of_photo.resize(captured_.size());
    for (size_t i = 0; i < captured_.size(); ++i) {
      scene_.photos[i].name = "p" + std::to_string(i);
      captures_.push_back(&captured_[i]);
    }
    AddPair(0, 1, true);
    AddPair(1, 2, true);
    AddPair(3, 4, false);
  }

  void AddPair(int first, int second, bool rotation_only) {
    VerifiedPair pair;
    pair.pair = {first, second, {}};
    pair.rotation_only = rotation_only;
    pairs_.push_back(pair);
  }

  void Record(int photo, double metres_north, double metres_up = 0) {
    GeoPosition position;
    position.latitude_deg = 50 + metres_north / 111'000;
    position.longitude_deg = 14;
    position.height_m = 300 + metres_up;
    position.has_height = true;
    captured_[photo].position = position;
  }

  std::vector<std::string> Describe() const { return DescribePanoramas(scene_, pairs_, captures_); }

  Scene scene_;
  std::vector<CapturedPhoto> captured_;
  std::vector<const CapturedPhoto*> captures_;
  std::vector<VerifiedPair> pairs_;
};

TEST_F(DescribePanoramasTest, NamesTheGroup) {
  EXPECT_THAT(Describe(), ElementsAre(HasSubstr("3 of 7 photos were taken from one point")));
  EXPECT_THAT(Describe(), ElementsAre(HasSubstr(": p0, p1, p2")));
  EXPECT_THAT(Describe(), ElementsAre(Not(HasSubstr("recorded"))));
}

TEST_F(DescribePanoramasTest, NamesPhotosRecordedThereThatMatchNoOther) {
  for (int photo = 0; photo < 7; ++photo) Record(photo, photo == 6 ? 40 : 0);
  Record(5, 2);
  EXPECT_THAT(Describe(), ElementsAre(HasSubstr("overlapping with no other: p5 (2.0 m away)")));
  Record(5, 0, 30);  // far above
  EXPECT_THAT(Describe(), ElementsAre(Not(HasSubstr("recorded"))));
}

TEST_F(DescribePanoramasTest, SaysNothingWithoutRotations) {
  pairs_.resize(1);
  EXPECT_TRUE(Describe().empty());
  pairs_.clear();
  EXPECT_TRUE(Describe().empty());
}

}  // namespace
}  // namespace stucco
