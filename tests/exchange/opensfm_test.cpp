// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/opensfm.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/exchange/row_of_photos.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A third of a turn about (1, -1, 1): camera x is -y of the world, its y is -z, its z is x.
constexpr char kShot[] =
    R"("camera": "c", "rotation": [1.2091995761561452, -1.2091995761561452, 1.2091995761561452],
       "translation": [2, 3, -1])";
constexpr char kPerspective[] =
    R"("projection_type": "perspective", "focal": 0.5, "k1": 0, "k2": 0)";

std::string ReconstructionJson(const std::string& lens, const std::string& more) {
  return fmt::format(R"([{{"cameras": {{"c": {{{}, "width": 200, "height": 100}}}},
    "shots": {{"a.jpg": {{{}}}, "c.jpg": {{{}}}}},
    "points": {{"12": {{"coordinates": [11, 1, 5], "color": [200, 100, 50]}}}}{}}}])",
                     lens, kShot, kShot, more);
}

class OpenSfmTest : public testing::Test {
 protected:
  ExchangedModel Read(const std::string& text) {
    return ReadOpenSfm(photos.Write("reconstruction.json", text), photos.Index());
  }
  Eigen::Vector2d SeenBy(const std::string& lens) {
    return PixelIn(Read(ReconstructionJson(lens, "")).model, "a.jpg", kSeen);
  }
  std::string Refusal(const std::string& text) {
    const Error error = RefusalOf([&] { Read(text); });
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }

  RowOfPhotos photos;
};

TEST_F(OpenSfmTest, APointIsWhereTheDocumentSays) {
  // Image coordinates are from the middle, over the longer side: (110 - 100) / 200, (30 - 50) /
  // 200.
  photos.Write("tracks.csv",
               "OPENSFM_TRACKS_VERSION_v2\na.jpg\t12\t3\t0.05\t-0.1\t0.002\t9\t8\t7\t-1\t-1\n"
               "c.jpg\t12\t5\t0.05\t-0.1\t0.002\t9\t8\t7\t-1\t-1\n"
               "c.jpg\t13\t6\t0\t0\t0.002\t9\t8\t7\t-1\t-1\n");
  const ExchangedModel read = Read(ReconstructionJson(kPerspective, ""));
  EXPECT_LT((PixelIn(read.model, "a.jpg", kSeen) - kSeenAt).norm(), 1e-12);
  EXPECT_LT((PixelIn(read.model, "sub/c.jpg", kSeen) - kSeenAt).norm(), 1e-12);
  ASSERT_EQ(read.model.points.size(), 1u);
  EXPECT_EQ(read.model.points.begin()->second.position, kSeen);
  EXPECT_THAT(read.model.points.begin()->second.rgb, ElementsAre(200, 100, 50));
  const auto& observations = read.model.photos.begin()->second.observations;
  ASSERT_EQ(observations.size(), 1u);
  EXPECT_LT((observations[0].pixel - kSeenAt).norm(), 1e-12);
  EXPECT_FALSE(read.georef);
  EXPECT_THAT(read.notes, IsEmpty());
}

TEST_F(OpenSfmTest, EveryLensOfItsDocumentThatIsOneOfOurs) {
  const double s = 0.05;  // x^2 + y^2 of the ray (0.1, -0.2)
  double r = 1 + 0.5 * s + 0.25 * s * s;
  EXPECT_LT((SeenBy(R"("projection_type": "perspective", "focal": 0.5, "k1": 0.5, "k2": 0.25)") -
             Eigen::Vector2d(100 + 10 * r, 50 - 20 * r))
                .norm(),
            1e-12);
  const std::string apart =
      R"("focal_x": 0.5, "focal_y": 0.6, "c_x": 0.01, "c_y": -0.02, "k1": 0.5)";
  r = 1 + 0.5 * s;
  EXPECT_LT((SeenBy(R"("projection_type": "simple_radial", )" + apart) -
             Eigen::Vector2d(100 + 2 + 10 * r, 50 - 4 - 24 * r))
                .norm(),
            1e-12);
  r = 1 + 0.5 * s + 0.25 * s * s;
  EXPECT_LT((SeenBy(R"("projection_type": "radial", "k2": 0.25, )" + apart) -
             Eigen::Vector2d(100 + 2 + 10 * r, 50 - 4 - 24 * r))
                .norm(),
            1e-12);
  r += 0.125 * s * s * s;
  const double x = 0.1 * r + 2 * 0.1 * 0.1 * -0.2 + 0.01 * (s + 2 * 0.01);
  const double y = -0.2 * r + 2 * 0.01 * 0.1 * -0.2 + 0.1 * (s + 2 * 0.04);
  EXPECT_LT((SeenBy(R"("projection_type": "brown", "k2": 0.25, "k3": 0.125, "p1": 0.1,
                       "p2": 0.01, )" +
                    apart) -
             Eigen::Vector2d(100 + 2 + 100 * x, 50 - 4 + 120 * y))
                .norm(),
            1e-12);
}

TEST_F(OpenSfmTest, ItsReferenceIsWhereTheFrameLies) {
  const char place[] = R"({"latitude": 52.01, "longitude": 4.36, "altitude": 7})";
  ExchangedModel read =
      Read(ReconstructionJson(kPerspective, fmt::format(R"(, "reference_lla": {})", place)));
  ASSERT_TRUE(read.georef);
  EXPECT_EQ(read.georef->origin_latitude_deg, 52.01);
  EXPECT_EQ(read.georef->origin_height_m, 7);
  photos.Write("reference_lla.json", place);
  EXPECT_TRUE(Read(ReconstructionJson(kPerspective, "")).georef);
  // What it writes when no photo has a position.
  EXPECT_FALSE(Read(ReconstructionJson(kPerspective, R"(, "reference_lla":
                                {"latitude": 0, "longitude": 0, "altitude": 0})"))
                   .georef);
}

TEST_F(OpenSfmTest, WithoutTracksThereAreNoPoints) {
  const ExchangedModel read = Read(ReconstructionJson(kPerspective, ""));
  EXPECT_TRUE(read.model.points.empty());
  EXPECT_THAT(read.notes, ElementsAre(HasSubstr("its 1 points do not say which photos see them")));
}

TEST_F(OpenSfmTest, OfSeveralTheLargestCounts) {
  const std::string small = R"({"cameras": {}, "shots": {}}, )";
  const ExchangedModel read = Read("[" + small + ReconstructionJson(kPerspective, "").substr(1));
  EXPECT_EQ(read.model.photos.size(), 2u);
  EXPECT_THAT(read.notes, testing::Contains(HasSubstr("of its 2 reconstructions the one with")));
}

TEST_F(OpenSfmTest, RefusesWhatItCannotRead) {
  EXPECT_THAT(Refusal(ReconstructionJson(
                  R"("projection_type": "fisheye", "focal": 0.5, "k1": 0, "k2": 0)", "")),
              HasSubstr("cameras: c: projection_type: \"fisheye\" is not supported"));
  const std::string whole = ReconstructionJson(kPerspective, "");
  EXPECT_THAT(Refusal(whole.substr(0, whole.size() / 2)), HasSubstr("is no whole JSON file"));
  std::string damaged = whole;
  damaged.replace(damaged.find("[2, 3, -1]"), 10, "[2, NaN, 1]");
  EXPECT_THAT(Refusal(damaged), HasSubstr("is no whole JSON file"));
  damaged = whole;
  damaged.replace(damaged.find("[2, 3, -1]"), 10, "[2, 3]    ");
  EXPECT_THAT(Refusal(damaged), HasSubstr("shots: a.jpg: translation: has not three numbers"));
  damaged = whole;
  damaged.replace(damaged.find("\"focal\": 0.5"), 12, "\"focal\": -1 ");
  EXPECT_THAT(Refusal(damaged), HasSubstr("focal length is not positive"));
  EXPECT_THAT(Refusal("[]"), HasSubstr("no reconstruction with photos"));
  photos.Write("tracks.csv", "a.jpg\t12\t3\t0.05\n");
  EXPECT_THAT(Refusal(whole), HasSubstr("tracks.csv:1: is no line of tracks"));
}

}  // namespace
}  // namespace stucco
