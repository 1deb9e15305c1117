// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/find_relief.h"

#include <gtest/gtest.h>

#include "tests/texture/wall_survey.h"
#include "texture/relief_file.h"

namespace stucco::testing {
namespace {

const Balcony kBalcony = {{1.3, 1.2}, {2.7, 2.0}, 0.6};

// Five photos, none of them straight before the balcony.
void AddPhotosOfBalcony(WallSurvey& survey) {
  const auto scene = BalconyScene(kBalcony, WallScene(4, 3));
  survey.Add("a.jpg", {4.6, -4.0, 1.7}, {2, 0, 1.5}, 1, scene);
  survey.Add("b.jpg", {-0.6, -4.0, 1.6}, {2, 0, 1.5}, 1, scene);
  survey.Add("c.jpg", {2.8, -4.0, 3.9}, {2, 0, 1.5}, 1, scene);
  survey.Add("d.jpg", {1.2, -4.0, 3.2}, {2, 0, 1.5}, 1, scene);
  survey.Add("e.jpg", {3.4, -4.2, 0.4}, {2, 0, 1.5}, 1, scene);
}

TEST(RunTexture, PaintsABalconyWhereItIs) {
  WallSurvey survey;
  AddPhotosOfBalcony(survey);
  TextureOptions options;
  options.texel_size = 0.01;
  options.relief = true;
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

TEST(RunTexture, FindsNoReliefOnAFlatWall) {
  WallSurvey survey;
  survey.Add("a.jpg", {4.6, -4.0, 1.7}, {2, 0, 1.5});
  survey.Add("b.jpg", {-0.6, -4.0, 1.6}, {2, 0, 1.5});
  survey.Add("c.jpg", {2.8, -4.0, 3.9}, {2, 0, 1.5});
  TextureOptions options;
  options.relief = true;
  survey.Run(options);
  EXPECT_EQ(ReadRelief(survey.Out(), "B0001_W01"), nullptr);
}

}  // namespace
}  // namespace stucco::testing
