// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/texture/wall_survey.h"

#include <Eigen/Geometry>

#include "survey/captures.h"
#include "survey/colmap_io.h"
#include "survey/plan_io.h"
#include "survey/survey_folder.h"
#include "tests/survey/stage_support.h"
#include "texture/texture.h"

namespace stucco::test {
namespace {

namespace fs = std::filesystem;

constexpr int kPhotoWidth = 640;
constexpr int kPhotoHeight = 480;
constexpr double kFocal = 600;

}  // namespace

WallSurvey::WallSurvey() {
  fs::create_directories(Photos());
  fs::create_directories(Folder() / "proxy");
  SetProxy(MakeProxy({MakeWall(4, 3)}));
}

void WallSurvey::SetProxy(const Proxy& proxy) {
  WriteProxy(proxy, Folder() / kFacetsFile);
}

SurveyPhoto WallSurvey::Add(const std::string& name, const Eigen::Vector3d& from,
                            const Eigen::Vector3d& to, double exposure, const Scene& scene) {
  const SurveyPhoto photo = LookFrom(name, from, to, {kPhotoWidth, kPhotoHeight, kFocal});
  WriteImage(Render(photo, scene, exposure), Photos() / name, 97);
  Pose(photo);
  return photo;
}

void WallSurvey::Pose(const SurveyPhoto& photo) {
  model_.cameras[photo.camera.id] = photo.camera;
  const PhotoId id{static_cast<uint32_t>(model_.photos.size() + 1)};
  model_.photos[id] = {id, photo.camera.id, photo.path(), photo.cam_from_world, {}};
}

void WallSurvey::Disturb(const std::string& name, double yaw_rad) {
  for (auto& [id, photo] : model_.photos) {
    if (photo.name != name) continue;
    stucco::Pose turn;
    turn.rotation = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY());
    photo.cam_from_world = turn * photo.cam_from_world;
  }
}

void WallSurvey::Plan(const std::string& planned_photo) {
  Proxy proxy = MakeProxy({MakeWall(4, 3)});
  proxy.buildings[0].facets[0].planned_facades = {"B0012/F03"};
  SetProxy(proxy);
  PlannedFacade facade;
  facade.id = "B0012/F03";
  facade.b_m = {4, 0};
  facade.z_m = {0, 3};
  facade.views = {"h0v0"};
  PlannedView view;
  view.id = "h0v0";
  view.targets = {{facade.id, {0, 4}, {0, 3}}};
  stucco::Plan plan;
  plan.crs = "+proj=tmerc";
  plan.facades = {facade};
  plan.views = {view};
  fs::create_directories(Folder() / "plan");
  WritePlan(plan, Folder() / kPlanFile);
  Captures captures;
  captures.cameras.resize(1);
  captures.cameras[0].intrinsics = model_.cameras.begin()->second;
  captures.photos.resize(1);
  captures.photos[0].camera = 0;
  captures.photos[0].path = planned_photo;
  captures.photos[0].usable = true;
  captures.photos[0].view = "h0v0";
  fs::create_directories(Folder() / "ingest");
  WriteCaptures(captures, Folder() / kCapturesFile);
}

TextureSet WallSurvey::Run(TextureOptions options, const std::string& out, int threads,
                           UnitStore* units) const {
  fs::create_directories(Out(out));
  WriteColmapText(model_, Folder() / kSparseFolder);
  StageContext context;
  context.survey = Folder();
  context.photos = Photos();
  context.out = Out(out);
  context.threads = threads;
  context.progress = &SilentProgress();
  context.units = units ? units : &NoUnits();
  RunTexture(options, context);
  return ReadTextureSet(Out(out) / "textures.json");
}

Image WallSurvey::Picture(const TexturedFacet& facet, const std::string& out) const {
  return ReadImage(Out(out) / facet.image);
}

Image WallSurvey::Labels(const TexturedFacet& facet, const std::string& out) const {
  return ReadImage(Out(out) / facet.label_image);
}

TexelGrid GridOf(const TexturedFacet& facet) {
  TexelGrid grid;
  grid.origin = facet.origin;
  grid.u_axis = facet.u_axis;
  grid.v_axis = facet.v_axis;
  grid.texel = facet.metres_per_texel;
  grid.width = facet.width_px;
  grid.height = facet.height_px;
  return grid;
}

}  // namespace stucco::test
