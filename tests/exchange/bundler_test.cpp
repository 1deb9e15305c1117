// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/bundler.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/exchange/row_of_photos.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// The camera's x is to the right, y up and z backwards: it looks along +x with +z up.
constexpr char kPose[] = "0 -1 0\n0 0 1\n-1 0 0\n2 -3 1\n";
// The point is at (10, 20) from the middle of the photo, y up.
constexpr char kPoint[] = "11 1 5\n200 100 50\n2 0 17 10 20 2 4 10 20\n";

class BundlerTest : public testing::Test {
 protected:
  // Three cameras, of which the second has no pose.
  static std::string Bundle(const std::string& lens, const std::string& points) {
    const std::string none = "0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n";
    return "# Bundle file v0.3\n3 1\n" + lens + kPose + none + lens + kPose + points;
  }
  ExchangedModel Read(const std::string& text) {
    return ReadBundler(photos.Write("model/bundle.out", text), photos.Index());
  }
  std::string Refusal(const std::string& text) {
    const Error error = RefusalOf([&] { Read(text); });
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }

  RowOfPhotos photos;
  const std::filesystem::path list =
      photos.Write("model/list.txt", "./a.jpg 0 100\nb.jpg\nD:\\flight\\sub\\c.jpg\n");
};

TEST_F(BundlerTest, APointIsWhereTheDocumentSays) {
  const ExchangedModel read = Read(Bundle("100 0 0\n", kPoint));
  EXPECT_EQ(read.format, "Bundler v0.3");
  ASSERT_EQ(read.model.photos.size(), 2u);
  EXPECT_LT((PixelIn(read.model, "a.jpg", kSeen) - kSeenAt).norm(), 1e-12);
  const RegisteredImage& photo = read.model.photos.begin()->second;
  EXPECT_LT((photo.cam_from_world.Center() - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
  ASSERT_EQ(photo.observations.size(), 1u);
  EXPECT_LT((photo.observations[0].pixel - kSeenAt).norm(), 1e-12);
  ASSERT_EQ(read.model.points.size(), 1u);
  EXPECT_THAT(read.model.points.begin()->second.rgb, ElementsAre(200, 100, 50));
  EXPECT_EQ(read.model.cameras.size(), 1u);  // equal lenses are one
  EXPECT_THAT(read.notes, ElementsAre("1 photos of its list have no pose in it"));
}

// r(p) = 1 + k1 |p|^2 + k2 |p|^4 with |p|^2 = 0.05.
TEST_F(BundlerTest, DistortionIsThatOfTheDocument) {
  const ExchangedModel read = Read(Bundle("100 0.5 0.25\n", kPoint));
  const double r = 1 + 0.5 * 0.05 + 0.25 * 0.05 * 0.05;
  const Eigen::Vector2d seen(100 + 10 * r, 50 - 20 * r);
  EXPECT_LT((PixelIn(read.model, "sub/c.jpg", kSeen) - seen).norm(), 1e-12);
}

TEST_F(BundlerTest, ThePicturesOfItsListSayHowLargeTheyWere) {
  photos.AddPhoto("model/a.jpg", 100, 50);
  const ExchangedModel read = Read(Bundle("100 0 0\n", kPoint));
  EXPECT_EQ(read.model.cameras.size(), 2u);
  EXPECT_EQ(read.model.cameras.at(CameraId{1}).width_px, 100);
  EXPECT_EQ(read.model.cameras.at(CameraId{2}).width_px, 200);
}

TEST_F(BundlerTest, RefusesAModelOfOtherPictures) {
  EXPECT_THAT(Refusal(Bundle("100 0 0\n", "11 1 5\n0 0 0\n2 0 1 300 20 2 1 300 20\n")),
              HasSubstr("made from larger pictures"));
  std::string text = "# Bundle file v0.3\n3 100\n";
  const std::string one = Bundle("100 0 0\n", "");
  text += one.substr(one.find("100 0 0"));
  for (int i = 0; i < 100; ++i) text += kPoint;
  EXPECT_THAT(Refusal(text), HasSubstr("made from smaller pictures"));
}

TEST_F(BundlerTest, RefusesDamagedFilesWithTheirLine) {
  const std::string whole = Bundle("100 0 0\n", kPoint);
  EXPECT_THAT(Refusal(whole.substr(0, whole.size() - 8)),
              HasSubstr("bundle.out:20: the file ends where key of a view should be"));
  EXPECT_THAT(Refusal(whole.substr(0, 40)), HasSubstr("the file ends"));
  EXPECT_THAT(Refusal(Bundle("nan 0 0\n", kPoint)), HasSubstr("focal length \"nan\" is not"));
  EXPECT_THAT(Refusal(Bundle("-1 0 0\n", kPoint)), HasSubstr("focal length is not positive"));
  EXPECT_THAT(Refusal(Bundle("100 0 0\n", "1 1 inf\n0 0 0\n0\n")), HasSubstr("\"inf\""));
  EXPECT_THAT(Refusal(Bundle("100 0 0\n", "1 1 1\n0 0 0\n1 3 0 0 0\n")),
              HasSubstr("there is no camera 3"));
  EXPECT_THAT(Refusal("# Bundle file v0.2\n"), HasSubstr("begins with \"# Bundle file v0.2\""));
  std::string mirrored = whole;
  mirrored.replace(mirrored.find("0 -1 0"), 6, "0 1 0 ");
  EXPECT_THAT(Refusal(mirrored), HasSubstr("is no rotation"));
}

TEST_F(BundlerTest, RefusesAListThatIsNotItsOwn) {
  photos.Write("model/list.txt", "a.jpg\nb.jpg\n");
  EXPECT_THAT(Refusal(Bundle("100 0 0\n", kPoint)),
              HasSubstr("lists 2 photos, and the model has 3"));
  photos.Write("model/list.txt", "a.jpg\nb.jpg\nnobody knows it.jpg\n");
  EXPECT_THAT(Refusal(Bundle("100 0 0\n", kPoint)),
              HasSubstr("1 of 2 photos of the model are not in"));
  std::filesystem::remove(list);
  EXPECT_THAT(Refusal(Bundle("100 0 0\n", kPoint)), HasSubstr("list of its photos is not there"));
}

}  // namespace
}  // namespace stucco
