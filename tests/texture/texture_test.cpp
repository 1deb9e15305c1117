// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/texture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>

#include "survey/captures.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/plan_io.h"
#include "survey/point_cloud.h"
#include "survey/survey_folder.h"
#include "survey/texture_set.h"
#include "tests/survey/stage_support.h"
#include "tests/texture/synthetic.h"
#include "tests/texture/wall_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using test::DiscScene;
using test::GridOf;
using test::LookFrom;
using test::MakeProxy;
using test::MakeWall;
using test::Psnr;
using test::Render;
using test::TemporaryFolder;
using test::WallPicture;
using test::WallScene;
using Survey = test::WallSurvey;

double TruthPsnr(const Survey& survey, const TexturedFacet& facet) {
  return Psnr(survey.Picture(facet), WallPicture(GridOf(facet)));
}

int LabelAt(const Image& labels, int x, int y) {
  return *labels.Pixel(x, y);
}

// Share of texels in which the picture is clearly red as DiscScene's disc is.
double RedShare(const Image& image) {
  double red = 0;
  for (size_t i = 0; i < image.data.size(); i += 3) {
    red += image.data[i] > 150 && image.data[i + 1] < 70 && image.data[i + 2] < 70;
  }
  return red / static_cast<double>(image.data.size() / 3);
}

TEST(RunTexture, PaintsTheTruth) {
  Survey survey;
  survey.Add("a.jpg", {2, -4.2, 1.5}, {2, 0, 1.5});
  survey.Add("b.jpg", {3.5, -4.5, 2}, {2, 0, 1.5});
  const TextureSet set = survey.Run();
  ASSERT_EQ(set.facets.size(), 1u);
  const TexturedFacet& facet = set.facets[0];
  EXPECT_EQ(facet.image, "textures/B0001_W01.png");
  EXPECT_NEAR(facet.metres_per_texel, 4.2 / 600, 0.0005);
  EXPECT_NEAR(facet.gsd_m, 4.2 / 600, 0.0005);
  EXPECT_EQ(facet.photos, std::vector<std::string>{"a.jpg"});
  EXPECT_NEAR(facet.painted, 1, 0.01);
  EXPECT_GT(facet.q_s, 0.9);
  EXPECT_GT(facet.q_c, 0.98);
  EXPECT_GT(facet.sharpness, 0);
  EXPECT_GT(TruthPsnr(survey, facet), 28);
  for (const char* file :
       {"model.glb", "model.obj", "model.mtl", "labels/B0001_W01.png", "orthophotos/B0001_W01.png",
        "orthophotos/B0001_W01.pgw", "orthophotos/B0001_W01.json"}) {
    EXPECT_TRUE(fs::exists(survey.Out() / file)) << file;
  }
}

// Nearly as good as each other: a.jpg is a little nearer.
void AddTwins(Survey& survey) {
  survey.Add("a.jpg", {2, -4.2, 1.5}, {2, 0, 1.5});
  survey.Add("b.jpg", {2.1, -4.3, 1.5}, {2.1, 0, 1.5});
}

using Names = std::vector<std::string>;

TEST(RunTexture, PrefersThePhotoOfThePlanAmongEquals) {
  Survey survey;
  AddTwins(survey);
  EXPECT_EQ(survey.Run().facets[0].photos, Names{"a.jpg"});
  survey.Plan("b.jpg");
  const TexturedFacet guided = survey.Run().facets[0];
  EXPECT_EQ(guided.photos, Names{"b.jpg"});
  EXPECT_EQ(guided.planned_photos, Names{"b.jpg"});
  TextureOptions options;
  options.guided = false;
  const TexturedFacet unguided = survey.Run(options).facets[0];
  EXPECT_EQ(unguided.photos, Names{"a.jpg"});
  EXPECT_TRUE(unguided.planned_photos.empty());
}

TEST(RunTexture, APlannedPhotoThatIsFarWorseLoses) {
  Survey survey;
  survey.Add("a.jpg", {2, -4.2, 1.5}, {2, 0, 1.5});
  survey.Add("far.jpg", {5.5, -6, 2}, {2, 0, 1.5});
  survey.Plan("far.jpg");
  const TexturedFacet facet = survey.Run().facets[0];
  EXPECT_EQ(facet.photos, Names{"a.jpg"});
  EXPECT_TRUE(facet.planned_photos.empty());
}

TEST(RunTexture, APlanWhosePhotoIsMissingOrThatIsDamagedChangesNothing) {
  Survey survey;
  AddTwins(survey);
  const TexturedFacet before = survey.Run().facets[0];
  const std::string picture = ReadFile(survey.Out() / before.image);
  survey.Plan("lost.jpg");
  const TexturedFacet lost = survey.Run().facets[0];
  EXPECT_EQ(lost.photos, before.photos);
  EXPECT_EQ(ReadFile(survey.Out() / lost.image), picture);
  survey.Plan("b.jpg");
  WriteFile(survey.Folder() / kPlanFile, "{ this is no plan");
  const TexturedFacet damaged = survey.Run().facets[0];
  EXPECT_EQ(damaged.photos, before.photos);
  EXPECT_EQ(ReadFile(survey.Out() / damaged.image), picture);
}

TEST(RunTexture, JoinsPhotosThatEachSeeAPart) {
  Survey survey;
  survey.Add("left.jpg", {1, -2.5, 1.5}, {1, 0, 1.5});
  survey.Add("right.jpg", {3, -2.5, 1.5}, {3, 0, 1.5}, 1.25);
  TextureOptions options;
  options.texel_size = 0.01;
  const TexturedFacet facet = survey.Run(options).facets.at(0);
  EXPECT_EQ(facet.photos.size(), 2u);
  const Image labels = survey.Labels(facet);
  EXPECT_NE(LabelAt(labels, 20, 150), LabelAt(labels, 380, 150));
  // The right photo is a quarter brighter; afterwards both are between, and alike.
  EXPECT_NEAR(facet.gains.at("left.jpg") / facet.gains.at("right.jpg"), 1.25, 0.03);
  Image picture = survey.Picture(facet);
  const double scale = 1 / facet.gains.at("left.jpg");
  for (uint8_t& value : picture.data) value = static_cast<uint8_t>(value * scale);
  // The photos end 14 cm from the upper and lower edge of the wall; the rest is invented.
  std::vector<uint8_t> seen(labels.data.size());
  std::transform(labels.data.begin(), labels.data.end(), seen.begin(),
                 [](uint8_t label) { return label != 0 && label != 255; });
  EXPECT_GT(Psnr(picture, WallPicture(GridOf(facet)), seen), 26);
  EXPECT_GT(facet.painted, 0.6);
}

TEST(RunTexture, PaintsALongWallWithTheTwentyPhotosItNeeds) {
  Survey survey;
  survey.SetProxy(MakeProxy({MakeWall(20, 0.6)}));
  const test::Scene bricks = [](const Eigen::Vector3d& from, const Eigen::Vector3d& way) {
    const Eigen::Vector3d point = from - from.y() / way.y() * way;
    const bool dark = (std::lround(6 * point.x()) + std::lround(9 * point.z())) % 2 == 0;
    return std::optional<test::Colour>(test::Colour::Constant(dark ? 90 : 150));
  };
  for (int i = 0; i < 20; ++i) {
    const double x = i + 0.5;  // each shows 1.1 m
    survey.Add("p" + std::to_string(i) + ".jpg", {x, -1, 0.3}, {x, 0, 0.3}, 1, bricks);
  }
  TextureOptions options;
  options.texel_size = 0.01;
  const TexturedFacet facet = survey.Run(options).facets.at(0);
  EXPECT_EQ(facet.photos.size(), 20u);
  EXPECT_GT(facet.painted, 0.99);
  EXPECT_EQ(facet.inpainted, 1 - facet.painted);
}

TEST(RunTexture, DoesNotPaintAnOccluderThatOthersSeeBehind) {
  Survey survey;
  const auto scene = DiscScene({2, -1, 1.5}, 0.25, WallScene(4, 3));
  survey.Add("a.jpg", {2, -4.2, 1.5}, {2, 0, 1.5}, 1, scene);
  survey.Add("b.jpg", {4.5, -4.2, 1.5}, {2, 0, 1.5}, 1, scene);
  survey.Add("c.jpg", {-0.5, -4.2, 1.5}, {2, 0, 1.5}, 1, scene);
  const TexturedFacet by_colour = survey.Run().facets.at(0);
  EXPECT_LT(RedShare(survey.Picture(by_colour)), 0.001);
  EXPECT_GT(TruthPsnr(survey, by_colour), 24);
}

TEST(RunTexture, AvoidsWhatTheCloudHasInFront) {
  // Two photos cannot outvote each other: only the cloud knows which one shows the wall.
  Survey survey;
  const auto scene = DiscScene({2, -1, 1.5}, 0.25, WallScene(4, 3));
  survey.Add("a.jpg", {2, -4.2, 1.5}, {2, 0, 1.5}, 1, scene);
  survey.Add("b.jpg", {4.5, -4.2, 1.5}, {2, 0, 1.5}, 1, scene);
  PointCloud cloud;
  for (double x = -0.25; x <= 0.25; x += 0.01) {
    for (double z = -0.25; z <= 0.25; z += 0.01) {
      if (x * x + z * z < 0.25 * 0.25) cloud.positions.push_back({2 + x, -1, 1.5 + z});
    }
  }
  fs::create_directories(survey.Folder() / "dense");
  WritePly(cloud, survey.Folder() / kCloudFile);
  EXPECT_LT(RedShare(survey.Picture(survey.Run().facets.at(0))), 0.001);
}

TEST(RunTexture, KeepsAWhiteRoofWithoutPoints) {
  Survey survey;
  Facet roof = MakeWall(4, 3);  // laid flat: x to 4, y to 3
  roof.facet_class = FacetClass::kRoof;
  roof.normal = Eigen::Vector3d::UnitZ();
  for (auto& vertex : roof.outer) vertex = {vertex.x(), vertex.z(), 0};
  survey.SetProxy(MakeProxy({roof}));
  // The left quarter is a smooth white membrane, of which stereo gives no points.
  const test::Scene scene = [](const Eigen::Vector3d& from, const Eigen::Vector3d& way) {
    const Eigen::Vector3d point = from - from.z() / way.z() * way;
    return std::optional<test::Colour>(
        point.x() < 1 ? test::Colour(240, 240, 240)
                      : test::Colour(0.6 * test::WallColour(point.x(), point.y())));
  };
  survey.Add("a.jpg", {2, 1.4, 4.2}, {2, 1.5, 0}, 1, scene);
  PointCloud cloud;
  for (double x = 1.0; x <= 4; x += 0.04) {
    for (double y = 0; y <= 3; y += 0.04) cloud.positions.push_back({x, y, 0});
  }
  fs::create_directories(survey.Folder() / "dense");
  WritePly(cloud, survey.Folder() / kCloudFile);
  EXPECT_NEAR(survey.Run().facets.at(0).painted, 1, 0.01);
}

TEST(RunTexture, MeasuresAndRemovesMisregistration) {
  Survey survey;
  survey.Add("left.jpg", {1.3, -3.2, 1.5}, {1.3, 0, 1.5});
  survey.Add("right.jpg", {2.7, -3.2, 1.5}, {2.7, 0, 1.5});
  survey.Disturb("right.jpg", 0.006);  // 3.6 pixels
  TextureOptions options;
  options.texel_size = 0.006;
  options.align = false;
  const double before = survey.Run(options).facets.at(0).misregistration_px;
  EXPECT_NEAR(before, 3.6, 1.5);
  options.align = true;
  const TexturedFacet after = survey.Run(options, "aligned").facets.at(0);
  EXPECT_LT(after.misregistration_px, 0.5);
  EXPECT_GT(after.misregistration_px, 0);
}

TEST(RunTexture, APhotoWithAWrongPoseIsOutvoted) {
  Survey survey;
  survey.Add("a.jpg", {1.4, -4.4, 1.5}, {1.9, 0, 1.5});
  survey.Add("b.jpg", {2.6, -4.4, 1.5}, {2.1, 0, 1.5});
  survey.Add("c.jpg", {2, -4.4, 2.2}, {2, 0, 1.5});
  survey.Add("nearest.jpg", {2, -4.0, 1.5}, {2, 0, 1.5});
  survey.Disturb("nearest.jpg", 0.05);  // the wall lies 0.2 m beside where the others have it
  const TexturedFacet facet = survey.Run().facets.at(0);
  EXPECT_EQ(std::ranges::count(facet.photos, "nearest.jpg"), 0);
  EXPECT_GT(TruthPsnr(survey, facet), 24);
}

TEST(RunTexture, LeavesFacetsThatNobodySeesWithoutPicture) {
  Survey survey;
  Facet back = MakeWall(4, 3);
  back.id = "B0001/W02";
  back.normal = Eigen::Vector3d::UnitY();
  std::reverse(back.outer.begin(), back.outer.end());
  for (auto& vertex : back.outer) vertex.y() = 2;
  back.offset = 2;
  survey.SetProxy(MakeProxy({MakeWall(4, 3), back}));
  survey.Add("a.jpg", {2, -4.2, 1.5}, {2, 0, 1.5});
  const TextureSet set = survey.Run();
  ASSERT_EQ(set.facets.size(), 2u);
  EXPECT_FALSE(set.facets[0].image.empty());
  EXPECT_TRUE(set.facets[1].image.empty());
  EXPECT_EQ(set.facets[1].painted, 0);
  EXPECT_TRUE(set.facets[1].photos.empty());

  survey.SetProxy(MakeProxy({back}));
  EXPECT_THROW(survey.Run(), Error);
}

TEST(RunTexture, FillsAndMarksWhatNobodySees) {
  Survey survey;
  survey.Add("a.jpg", {1, -2.5, 1.5}, {1, 0, 1.5});  // the left 2.3 m only
  TextureOptions options;
  options.texel_size = 0.02;
  const TexturedFacet facet = survey.Run(options).facets.at(0);
  EXPECT_NEAR(facet.painted + facet.inpainted, 1, 1e-9);
  EXPECT_NEAR(facet.painted, 2.3 / 4 * 2.0 / 3, 0.06);
  EXPECT_EQ(LabelAt(survey.Labels(facet), 190, 75), 255);
  EXPECT_EQ(LabelAt(survey.Labels(facet), 50, 75), 1);
  EXPECT_GT(survey.Picture(facet).Pixel(190, 75)[0], 20);
  options.inpaint = false;
  const TexturedFacet bare = survey.Run(options).facets.at(0);
  EXPECT_EQ(bare.inpainted, 0);
  EXPECT_EQ(LabelAt(survey.Labels(bare), 190, 75), 0);
  EXPECT_EQ(survey.Picture(bare).Pixel(190, 75)[0], 0);
}

TEST(RunTexture, TakesAFacetOfOnePixelAndLimitsALargeOne) {
  Survey survey;
  Facet tiny = MakeWall(4, 3);
  tiny.id = "B0001/W02";
  tiny.outer = {{4.2, 0, 1}, {4.203, 0, 1}, {4.203, 0, 1.003}, {4.2, 0, 1.003}};
  survey.SetProxy(MakeProxy({MakeWall(4, 3), tiny}));
  survey.Add("a.jpg", {2, -5, 1.5}, {2, 0, 1.5});
  TextureOptions options;
  options.texel_size = 0.0001;
  options.max_texture_px = 500;
  const TextureSet set = survey.Run(options);
  EXPECT_EQ(set.facets[0].width_px, 500);
  EXPECT_EQ(set.facets[0].height_px, 375);
  EXPECT_DOUBLE_EQ(set.facets[0].metres_per_texel, 0.008);
  EXPECT_DOUBLE_EQ(set.facets[0].wanted_metres_per_texel, 0.0001);
  EXPECT_DOUBLE_EQ(set.facets[1].wanted_metres_per_texel, set.facets[1].metres_per_texel);
  EXPECT_GT(TruthPsnr(survey, set.facets[0]), 25);
  EXPECT_EQ(set.facets[1].width_px, 30);
  options.texel_size = 0.01;
  const TexturedFacet one = survey.Run(options).facets.at(1);
  EXPECT_EQ(one.width_px, 1);
  EXPECT_EQ(one.height_px, 1);
  EXPECT_EQ(one.painted, 1);
}

TEST(RunTexture, RejectsGrazingPhotos) {
  Survey survey;
  survey.Add("grazing.jpg", {-14, -2, 1.5}, {2, 0, 1.5});  // 83 degrees
  EXPECT_THROW(survey.Run(), Error);
  TextureOptions options;
  options.max_angle_deg = 88;
  EXPECT_GT(survey.Run(options).facets.at(0).painted, 0.5);
}

std::map<std::string, std::string> Contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[fs::relative(entry.path(), folder).string()] = HashFile(entry.path());
    }
  }
  return files;
}

TEST(RunTexture, WritesTheSameBytesAtAnyThreadCountAndFromCheckpoints) {
  Survey survey;
  Facet side = MakeWall(4, 3);
  side.id = "B0001/W02";
  for (auto& vertex : side.outer) vertex.x() += 4;
  survey.SetProxy(MakeProxy({MakeWall(4, 3), side}));
  survey.Add("a.jpg", {2, -4.2, 1.5}, {2, 0, 1.5}, 1, WallScene(8, 3));
  survey.Add("b.jpg", {4, -4.2, 1.5}, {4, 0, 1.5}, 1.2, WallScene(8, 3));
  survey.Add("c.jpg", {6, -4.2, 1.5}, {6, 0, 1.5}, 0.9, WallScene(8, 3));
  test::MemoryUnits units;
  survey.Run({}, "one", 1, &units);
  const size_t computed = units.size();
  EXPECT_EQ(computed, 4u);
  survey.Run({}, "two", 2);
  survey.Run({}, "again", 2, &units);
  EXPECT_EQ(units.size(), computed);
  const auto one = Contents(survey.Out("one"));
  EXPECT_GT(one.size(), 10u);
  EXPECT_EQ(one, Contents(survey.Out("two")));
  EXPECT_EQ(one, Contents(survey.Out("again")));
}

TEST(RunTexture, SaysWhatIsMissing) {
  const Survey empty;
  EXPECT_THROW(empty.Run(), Error);  // no photos

  Survey gone;
  gone.Add("a.jpg", {2, -4.2, 1.5}, {2, 0, 1.5});
  gone.Add("b.jpg", {3, -4.2, 1.5}, {2, 0, 1.5});
  fs::rename(gone.Photos() / "a.jpg", gone.Photos() / "elsewhere.jpg");
  try {
    gone.Run();
    ADD_FAILURE() << "painted without a photo";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_NE(std::string(error.what()).find("a.jpg"), std::string::npos);
    EXPECT_FALSE(error.remedy().empty());
  }
  fs::rename(gone.Photos() / "elsewhere.jpg", gone.Photos() / "a.jpg");
  EXPECT_EQ(gone.Run().facets.at(0).photos, std::vector<std::string>{"a.jpg"});
  WriteFile(gone.Photos() / "b.jpg", "not a picture");
  EXPECT_THROW(gone.Run(), Error);
  fs::remove(gone.Folder() / kFacetsFile);
  EXPECT_THROW(gone.Run(), Error);
}

}  // namespace
}  // namespace stucco
