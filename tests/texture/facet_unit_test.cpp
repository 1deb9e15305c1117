// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/facet_unit.h"

#include <gtest/gtest.h>

#include "survey/error.h"
#include "tests/texture/synthetic.h"
#include "texture/output/file_names.h"

namespace stucco {
namespace {

TEST(FacetLook, SurvivesPacking) {
  FacetLook look;
  look.texel = 0.0123;
  look.candidates = {{3, 0.5, 0.25}, {1, 1, 0.75}};
  look.ratios = {{1, 3, {0.1, -0.2, 0.3}, 99}};
  look.limits = {77, 0.03, 0.2};
  const FacetLook again = UnpackLook(PackLook(look));
  EXPECT_EQ(again.texel, look.texel);
  ASSERT_EQ(again.candidates.size(), 2u);
  EXPECT_EQ(again.candidates[0].photo, 3);
  EXPECT_EQ(again.candidates[1].merit, 0.75);
  EXPECT_EQ(again.limits.max_angle_deg, 77);
  EXPECT_EQ(again.limits.tolerance, 0.03);
  EXPECT_EQ(again.limits.clearance, 0.2);
  ASSERT_EQ(again.ratios.size(), 1u);
  EXPECT_EQ(again.ratios[0].log_ratio, look.ratios[0].log_ratio);
  EXPECT_EQ(again.ratios[0].weight, 99);
  EXPECT_THROW(UnpackLook("nonsense"), Error);
  EXPECT_THROW(UnpackLook(PackFiles({})), Error);
}

TEST(FacetFiles, SurvivePacking) {
  FacetFiles files;
  files.facet.id = "B0001/W01";
  files.facet.width_px = 12;
  files.facet.photos = {"a.jpg", "b/c.jpg"};
  files.facet.planned_photos = {"b/c.jpg"};
  files.facet.origin = {1.5, 2.25, -3};
  files.facet.gains = {{"a.jpg", 1.25}};
  files.facet.q_u = 0.5;
  files.texture_png = std::string("\0\xff png", 6);
  const FacetFiles again = UnpackFiles(PackFiles(files));
  EXPECT_EQ(again.facet.id, files.facet.id);
  EXPECT_EQ(again.facet.width_px, 12);
  EXPECT_EQ(again.facet.photos, files.facet.photos);
  EXPECT_EQ(again.facet.planned_photos, files.facet.planned_photos);
  EXPECT_EQ(again.facet.origin, files.facet.origin);
  EXPECT_EQ(again.facet.gains, files.facet.gains);
  EXPECT_EQ(again.facet.q_u, 0.5);
  EXPECT_EQ(again.texture_png, files.texture_png);
  EXPECT_TRUE(again.label_png.empty());
}

TEST(FilesKey, ChangesWithWhatTheFacetDependsOnOnly) {
  TextureInput input;
  input.geometry_hash = "g";
  const Facet wall = test::MakeWall(4, 3);
  for (const char* name : {"a", "b", "c"}) {
    input.photos.push_back(test::LookFrom(name, {2, -5, 1}, {2, 0, 1}, {100, 100, 100}));
  }
  FacetLook look;
  look.candidates = {{0, 1, 1}, {1, 1, 1}};
  PhotosLight light{std::vector<Eigen::Vector3d>(3, Eigen::Vector3d::Ones()),
                    std::vector<Falloff>(3), std::vector<TakenPhoto>(3)};
  TextureOptions options;
  const auto key = [&] { return FilesKey(wall, look, input, light, options); };
  const std::string original = key();

  input.photos[2].captured.hash = "other";  // no candidate
  light.gains[2] *= 2;
  options.glb_quality = 50;
  EXPECT_EQ(key(), original);
  input.photos[1].captured.hash = "other";
  EXPECT_NE(key(), original);
  input.photos[1].captured.hash = "b";
  EXPECT_EQ(key(), original);
  light.gains[0].x() = 1.01;
  EXPECT_NE(key(), original);
  light.gains[0].x() = 1;
  light.falloffs[0].terms[0] = -0.1;
  EXPECT_NE(key(), original);
  light.falloffs[0] = {};
  input.photos[0].cam_from_world.translation.x() += 1e-9;
  EXPECT_NE(key(), original);
  input.photos[0].cam_from_world.translation.x() -= 1e-9;
  look.limits.tolerance += 1e-9;  // other photos have moved
  EXPECT_NE(key(), original);
  look.limits.tolerance -= 1e-9;
  look.limits.clearance += 1e-9;
  EXPECT_NE(key(), original);
  look.limits = {};
  EXPECT_EQ(key(), original);
  options.guided = false;  // no photo was planned for it
  input.photos[0].planned_facades = {"B0009/F01"};
  EXPECT_EQ(key(), original);
  options.seam_cost = 2;
  EXPECT_NE(key(), original);
}

TEST(FilesKey, OfWallsWithReliefChangesWithAllPhotosThatMaySeeThem) {
  TextureInput input;
  input.proxy.metric = true;
  const Facet wall = test::MakeWall(4, 3);
  input.photos = {test::LookFrom("a", {2, -5, 1}, {2, 0, 1}, {100, 100, 100}),
                  test::LookFrom("no candidate", {1, -5, 1}, {2, 0, 1}, {100, 100, 100}),
                  test::LookFrom("behind", {2, 5, 1}, {2, 0, 1}, {100, 100, 100})};
  FacetLook look;
  look.candidates = {{0, 1, 1}};
  PhotosLight light{std::vector<Eigen::Vector3d>(3, Eigen::Vector3d::Ones()),
                    std::vector<Falloff>(3), std::vector<TakenPhoto>(3)};
  TextureOptions options;
  const auto key = [&] { return FilesKey(wall, look, input, light, options); };
  const std::string original = key();
  input.photos[2].captured.hash = "other";
  EXPECT_EQ(key(), original);
  input.photos[1].captured.hash = "other";
  EXPECT_NE(key(), original);
  look.grid = TexelGrid();  // relief comes with it
  const std::string on_grid = key();
  input.photos[1].captured.hash = "yet another";
  EXPECT_EQ(key(), on_grid);
}

TEST(FilesKey, ChangesWithThePlannedPhotosOfTheFacade) {
  TextureInput input;
  Facet wall = test::MakeWall(4, 3);
  wall.planned_facades = {"B0009/F01"};
  input.photos = {test::LookFrom("a", {2, -5, 1}, {2, 0, 1}, {100, 100, 100})};
  FacetLook look;
  look.candidates = {{0, 1, 1}};
  const PhotosLight light{{Eigen::Vector3d::Ones()}, {Falloff()}, {TakenPhoto()}};
  const std::string files = FilesKey(wall, look, input, light, {});
  const std::string first_look = LookKey(wall, input, {});
  input.photos[0].planned_facades = {"B0009/F02"};
  EXPECT_EQ(FilesKey(wall, look, input, light, {}), files);
  EXPECT_EQ(LookKey(wall, input, {}), first_look);
  input.photos[0].planned_facades = {"B0009/F01"};
  EXPECT_NE(FilesKey(wall, look, input, light, {}), files);
  EXPECT_NE(LookKey(wall, input, {}), first_look);
}

TEST(FileNames, AreSafeAndUnique) {
  EXPECT_EQ(
      FileNames({"B0001/W03", "B0001_W03", "b0001_w03", "../x", "", "\xc3\xa4 y"}),
      (std::vector<std::string>{"B0001_W03", "B0001_W03-2", "b0001_w03-3", "_.._x", "_", "___y"}));
}

}  // namespace
}  // namespace stucco
