// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "evaluate/geometry/moved.h"
#include "evaluate/picture/compare_textures.h"
#include "tests/evaluate/made_pictures.h"
#include "tests/evaluate/made_walls.h"

namespace stucco::evaluate {
namespace {

using simulate::Light;
using simulate::Renderer;

// A survey of the house, in a folder of its own.
struct PaintedSurvey {
  std::filesystem::path folder;
  Proxy truth = MadeHouse();
  Proxy proxy = MadeHouse();
  TextureSet textures;
  simulate::Flight flight;
  Similarity truth_from_world;
  std::vector<bool> occluders;
};

PaintedSurvey PaintedHouse(const std::string& name, const Renderer& scene,
                           const Painting& painting = {}) {
  PaintedSurvey survey;
  survey.folder = std::filesystem::path(testing::TempDir()) / name;
  survey.textures = PaintHouse(scene, Light{}, painting, survey.folder);
  return survey;
}

// For what is asked of one wall alone: the others are not compared.
void KeepSouth(PaintedSurvey& survey) {
  std::vector<Facet>& facets = survey.truth.buildings[0].facets;
  facets.erase(facets.begin() + 1, facets.end());
}

std::vector<FacadeFigures> Compare(const PaintedSurvey& survey, const Renderer& scene,
                                   int threads = 2) {
  return CompareFacades({.texture_folder = survey.folder,
                         .proxy = survey.proxy,
                         .textures = survey.textures,
                         .truth = survey.truth,
                         .scene = scene,
                         .light = Light{},
                         .flight = survey.flight,
                         .occluders = survey.occluders,
                         .truth_from_world = survey.truth_from_world,
                         .output = survey.folder / "evaluation",
                         .lpips_model = {},
                         .threads = threads});
}

// Codes are whole: gains that are found turn some into the next, which FLIP takes for 0.03 and 50
// dB allow to every fifth pixel.
void ExpectEqual(const FacadeFigures& figures, double most_flip = 0.006) {
  EXPECT_NEAR(figures.painted, 1, 0.002) << figures.id;
  EXPECT_GT(figures.picture.ssim, 0.999) << figures.id;
  EXPECT_GT(figures.picture.ms_ssim, 0.999) << figures.id;
  EXPECT_GT(figures.picture.psnr, 50) << figures.id;
  EXPECT_LT(figures.picture.gmsd, 0.002) << figures.id;
  EXPECT_LT(figures.picture.flip, most_flip) << figures.id;
  EXPECT_LT(figures.misregistration_px, 0.02) << figures.id;
}

TEST(CompareFacades, WhatIsBelowTheGroundNeedNotBePainted) {
  const Renderer scene(MadeHouseScene());
  PaintedSurvey survey = PaintedHouse("buried", scene);
  KeepSouth(survey);
  survey.truth.buildings[0].facets[0].seen = 0.75;
  const FacadeFigures south = Compare(survey, scene)[0];
  EXPECT_NEAR(south.area_m2, 0.75 * 3 * 2.5, 1e-9);
  EXPECT_EQ(south.painted, 1);
}

TEST(CompareFacades, TruthAgainstItselfHasNoError) {
  const Renderer scene(MadeHouseScene());
  const PaintedSurvey survey = PaintedHouse("self", scene);
  const auto figures = Compare(survey, scene);
  ASSERT_EQ(figures.size(), 4u);
  for (const FacadeFigures& facade : figures) {
    ExpectEqual(facade);
    EXPECT_EQ(facade.facet, facade.id);
    EXPECT_TRUE(std::isnan(facade.picture.lpips));
    for (const std::string& picture :
         {facade.truth_picture, facade.result_picture, facade.error_picture}) {
      EXPECT_TRUE(std::filesystem::exists(survey.folder / "evaluation" / picture)) << picture;
    }
  }
  EXPECT_NEAR(figures[0].area_m2, 7.5, 1e-9);
}

TEST(CompareFacades, ExposureAndWhiteBalanceOfTheSurveyAreNoError) {
  const Renderer scene(MadeHouseScene());
  const PaintedSurvey survey = PaintedHouse("exposed", scene, {.gains = {0.7, 0.9, 0.8}});
  for (const FacadeFigures& facade : Compare(survey, scene)) ExpectEqual(facade);
}

TEST(CompareFacades, OneFacadeThatIsDarkerIsAnError) {
  const Renderer scene(MadeHouseScene());
  PaintedSurvey survey = PaintedHouse("uneven", scene);
  const std::filesystem::path wall = survey.folder / survey.textures.facets[1].image;
  WriteImage(Changed(ReadImage(wall), [](double code) { return 0.8 * code; }), wall);
  const auto figures = Compare(survey, scene);
  // The dark one pulls at the median of the gains.
  ExpectEqual(figures[0], 0.02);
  ExpectEqual(figures[2], 0.02);
  EXPECT_LT(figures[1].picture.psnr, 25);
  EXPECT_GT(figures[1].picture.flip, 0.05);
  EXPECT_LT(figures[1].misregistration_px, 0.02);
}

TEST(CompareFacades, AShiftIsFoundInTexels) {
  const Renderer scene(MadeHouseScene());
  for (const FacadeFigures& facade :
       Compare(PaintedHouse("shifted", scene, {.shift = 2.5}), scene)) {
    EXPECT_NEAR(facade.misregistration_px, 2.5, 0.1) << facade.id;
    EXPECT_LT(facade.picture.ssim, 0.9);
  }
}

TEST(CompareFacades, WorksInTheSurveysOwnFrame) {
  const Renderer scene(MadeHouseScene());
  PaintedSurvey survey = PaintedHouse("frame", scene);
  survey.truth_from_world.scale = 2.5;
  survey.truth_from_world.rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.1, 0.2, 1).normalized());
  survey.truth_from_world.translation = {100, -40, 7};
  const Similarity world_from_truth = survey.truth_from_world.Inverse();
  survey.proxy = Moved(survey.truth, world_from_truth);
  for (TexturedFacet& facet : survey.textures.facets) {
    facet.origin = world_from_truth * facet.origin;
    facet.u_axis = world_from_truth.rotation * facet.u_axis;
    facet.v_axis = world_from_truth.rotation * facet.v_axis;
    facet.metres_per_texel *= world_from_truth.scale;
  }
  for (const FacadeFigures& facade : Compare(survey, scene)) ExpectEqual(facade);
}

TEST(CompareFacades, FinerTexelsAreComparedAtTheTruths) {
  const Renderer scene(MadeHouseScene());
  for (const FacadeFigures& facade :
       Compare(PaintedHouse("fine", scene, {.texel_m = 0.005, .shift = 3}), scene)) {
    // Three texels of half a centimetre.
    EXPECT_NEAR(facade.misregistration_px, 1.5, 0.1) << facade.id;
  }
  for (const FacadeFigures& facade :
       Compare(PaintedHouse("coarse", scene, {.texel_m = 0.02, .shift = 3}), scene)) {
    EXPECT_NEAR(facade.misregistration_px, 3, 0.1) << facade.id;
  }
}

TEST(CompareFacades, FilledInTexelsAreNotPainted) {
  const Renderer scene(MadeHouseScene());
  PaintedSurvey survey = PaintedHouse("filled", scene);
  KeepSouth(survey);
  TexturedFacet& south = survey.textures.facets[0];
  Image image = ReadImage(survey.folder / south.image);
  Image labels{south.width_px, south.height_px, 1, {}};
  for (int y = 0; y < south.height_px; ++y) {
    for (int x = 0; x < south.width_px; ++x) {
      const bool painted = x < south.width_px / 2;
      labels.data.push_back(painted ? 1 : 255);
      if (!painted) std::fill_n(image.Pixel(x, y), 3, uint8_t{255});
    }
  }
  south.label_image = "labels.png";
  WriteImage(labels, survey.folder / south.label_image);
  WriteImage(image, survey.folder / south.image);
  const auto figures = Compare(survey, scene);
  EXPECT_NEAR(figures[0].painted, 0.5, 0.01);
  EXPECT_GT(figures[0].picture.ssim, 0.999);
  EXPECT_GT(figures[0].picture.psnr, 50);
}

TEST(CompareFacades, WhatStandsBeforeAWallIsLeftOutButNotItsShade) {
  simulate::Scene with_tree = MadeHouseScene();
  AddBoard("occluder/tree-1", 0.4, with_tree);  // so near that its shade is on the wall
  const Renderer scene(with_tree);
  std::vector<bool> tree(scene.scene().elements.size(), false);
  tree.back() = true;
  PaintedSurvey survey = PaintedHouse("tree", scene, {.left_out = tree});
  KeepSouth(survey);
  EXPECT_LT(Compare(survey, scene)[0].picture.psnr, 20);
  survey.occluders = tree;
  ExpectEqual(Compare(survey, scene)[0]);
  // Without the tree there would be no shade.
  EXPECT_LT(Compare(survey, Renderer(MadeHouseScene()))[0].picture.psnr, 30);
}

TEST(CompareFacades, ANearHouseBehindTheOnlookerIsLeftOut) {
  simulate::Scene narrow = MadeHouseScene();
  AddBoard("B0002/F01", 1.5, narrow);
  const Renderer scene(narrow);
  std::vector<bool> neighbour(scene.scene().elements.size(), false);
  neighbour.back() = true;
  PaintedSurvey survey = PaintedHouse("narrow", scene, {.left_out = neighbour});
  KeepSouth(survey);
  survey.truth.buildings.push_back(
      {.id = "B0002", .watertight = true, .source = "", .detail = "", .facets = {}});
  ExpectEqual(Compare(survey, scene)[0]);
}

TEST(CompareFacades, AWallWithoutAResultSaysSo) {
  const Renderer scene(MadeHouseScene());
  PaintedSurvey survey = PaintedHouse("bare", scene);
  survey.textures.facets[0].image.clear();
  auto& facets = survey.proxy.buildings[0].facets;
  facets.erase(facets.begin() + 1);
  const auto figures = Compare(survey, scene);
  EXPECT_EQ(figures[0].facet, "B0001/F00");
  EXPECT_EQ(figures[0].painted, 0);
  EXPECT_TRUE(std::isnan(figures[0].picture.ssim));
  EXPECT_TRUE(figures[0].truth_picture.empty());
  EXPECT_EQ(figures[1].facet, "");
  EXPECT_TRUE(std::isnan(figures[1].misregistration_px));
  ExpectEqual(figures[2]);
}

// A photo 4 m south of the house.
simulate::FlownPhoto SouthPhoto() {
  simulate::FlownPhoto photo = HeldOutPhoto("a.jpg", 1);
  photo.held_out = false;
  return photo;
}

// Of the south wall, whose every texel was painted from the photo of this number.
OccludedArea PaintedBy(uint8_t label, const Renderer& scene, PaintedSurvey& survey) {
  TexturedFacet& south = survey.textures.facets[0];
  south.label_image = "labels.png";
  south.photos = {"a.jpg", "b.jpg"};
  Image labels{south.width_px, south.height_px, 1, {}};
  labels.data.assign(static_cast<size_t>(south.width_px) * south.height_px, label);
  WriteImage(labels, survey.folder / south.label_image);
  return Compare(survey, scene)[0].occluded;
}

TEST(CompareFacades, WhatIsPaintedThroughATreeIsFoundByThePhotosOwnView) {
  simulate::Scene with_tree = MadeHouseScene();
  AddBoard("occluder/tree-1", 2, with_tree);
  const Renderer scene(with_tree);
  PaintedSurvey survey = PaintedHouse("through", scene);
  KeepSouth(survey);
  survey.occluders.assign(scene.scene().elements.size(), false);
  survey.occluders.back() = true;
  simulate::FlownPhoto beside = SouthPhoto();
  beside.path = "b.jpg";  // a metre farther west
  beside.cam_from_world.translation += beside.cam_from_world.rotation * Eigen::Vector3d(1, 0, 0);
  survey.flight.photos = {SouthPhoto(), beside};
  const OccludedArea behind = PaintedBy(1, scene, survey);
  // The board hides 2 m by 1.7 m above the ground, of which the other photo shows the western half.
  EXPECT_NEAR(behind.through_m2, 1.7, 0.3);
  EXPECT_GT(behind.free_m2, behind.through_m2 + 1);
  EXPECT_NEAR(behind.Share(), behind.through_m2 / behind.free_m2, 1e-12);
  survey.occluders.back() = false;  // a part of the building, such as a balcony
  EXPECT_EQ(PaintedBy(1, scene, survey).through_m2, 0);
  EXPECT_EQ(PaintedBy(3, scene, survey).free_m2, 0);  // of a photo that nothing is known of
}

TEST(CompareFacades, TheCeilingIsWhatIdealPhotosShow) {
  const Renderer scene(MadeHouseScene());
  PaintedSurvey survey = PaintedHouse("ceiling", scene, {.shift = 4});
  survey.flight.photos = {SouthPhoto()};
  const auto figures = Compare(survey, scene);
  const FacadeFigures& south = figures[0];
  EXPECT_GT(south.ideal_distance_m, 4);
  EXPECT_LT(south.ideal_distance_m, 4.5);  // to the corners the way is longer
  // Photos of about the pictures' resolution lose detail, but nothing lies elsewhere.
  EXPECT_LT(south.picture.ssim, 0.8);
  EXPECT_GT(south.ceiling.ssim, 0.9);
  EXPECT_LT(south.ceiling.ssim, 0.999);
  EXPECT_GT(south.ceiling.psnr, 30);
  EXPECT_LT(south.ceiling.shift_m, 0.001);
  EXPECT_NEAR(south.plane.result.shift_m, 0.04, 0.002);
  EXPECT_TRUE(std::isnan(figures[2].ceiling.ssim));  // no photo sees it
}

TEST(CompareFacades, ACoarserCameraHasALowerCeiling) {
  const Renderer scene(MadeHouseScene());
  PaintedSurvey survey = PaintedHouse("coarse_ceiling", scene);
  KeepSouth(survey);
  survey.flight.photos = {SouthPhoto()};
  const double fine = Compare(survey, scene)[0].ceiling.ssim;
  survey.flight.photos[0].camera = Resized(survey.flight.photos[0].camera, 40, 30);
  EXPECT_LT(Compare(survey, scene)[0].ceiling.ssim, fine - 0.05);
  survey.flight.photos = {SouthPhoto()};
  survey.flight.faults.focus_blur_px = 8;
  EXPECT_LT(Compare(survey, scene)[0].ceiling.ssim, fine - 0.05);
}

TEST(CompareFacades, TellsTheWallsPlaneFromRelief) {
  simulate::Scene scene_with_balcony = MadeHouseScene();
  AddBoard("B0001/trim", 0.3, scene_with_balcony);  // 1 m x 1 m before a wall of 3 m x 2.5 m
  const Renderer scene(scene_with_balcony);
  PaintedSurvey survey = PaintedHouse("relief", scene);
  KeepSouth(survey);
  survey.flight.photos = {SouthPhoto()};
  // Wrong on relief alone: as if no board were there.
  const Renderer bare(MadeHouseScene());
  PaintHouse(bare, Light{}, {}, survey.folder);
  const FacadeFigures south = Compare(survey, scene)[0];
  EXPECT_NEAR(south.plane.share, 1 - 1 / 7.5, 0.01);
  EXPECT_NEAR(south.relief.share, 1 / 7.5, 0.01);
  EXPECT_LT(south.relief.result.ssim, 0.5);
  EXPECT_GT(south.plane.result.ssim, south.relief.result.ssim + 0.3);
  EXPECT_GT(south.plane.ceiling.ssim, 0.9);
}

TEST(CompareFacades, IsTheSameAtAnyNumberOfThreads) {
  const Renderer scene(MadeHouseScene());
  PaintedSurvey survey = PaintedHouse("threads", scene, {.shift = 1});
  survey.flight.photos = {SouthPhoto()};
  const auto one = Compare(survey, scene, 1);
  const auto two = Compare(survey, scene, 2);
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].picture.ssim, two[i].picture.ssim);
    EXPECT_EQ(one[i].picture.flip, two[i].picture.flip);
    EXPECT_EQ(one[i].misregistration_px, two[i].misregistration_px);
    EXPECT_EQ(one[i].plane.result.ssim, two[i].plane.result.ssim);
  }
  EXPECT_EQ(one[0].ceiling.ssim, two[0].ceiling.ssim);
}

TEST(CompareFacades, AMissingPictureIsNamedAndTheOthersAreMeasured) {
  const Renderer scene(MadeHouseScene());
  PaintedSurvey survey = PaintedHouse("missing", scene);
  survey.textures.facets[2].image = "gone.png";
  const auto figures = Compare(survey, scene);
  EXPECT_THAT(figures[2].problem, testing::HasSubstr("gone.png"));
  EXPECT_EQ(figures[2].painted, 0);
  EXPECT_TRUE(std::isnan(figures[2].picture.psnr));
  EXPECT_EQ(figures[1].problem, "");
  ExpectEqual(figures[1]);
}

}  // namespace
}  // namespace stucco::evaluate
