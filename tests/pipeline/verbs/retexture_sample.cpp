// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/pipeline/verbs/retexture_sample.h"

#include <nlohmann/json.hpp>

#include "pipeline/default_stages.h"
#include "pipeline/verbs/init.h"
#include "pipeline/verbs/run.h"
#include "survey/colmap_io.h"
#include "survey/files.h"
#include "survey/pose.h"
#include "survey/proxy.h"
#include "survey/survey_folder.h"
#include "texture/texture.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

const fs::path kSample = SAMPLE_FOLDER;

// Every fifth photo of the sample is of another day.
bool IsNew(const fs::path& photo) {
  return std::stoi(photo.stem().string().substr(4)) % 5 == 3;
}

// The truth of the sample in the world of its calibration, as a model would be found.
void WriteTrueProxy(const fs::path& survey) {
  const Reconstruction truth = ReadColmapModel(kSample / "truth");
  const Reconstruction found = ReadColmapModel(survey / kSparseFolder);
  std::map<std::string, Eigen::Vector3d> true_centres;
  for (const auto& [id, photo] : truth.photos) {
    true_centres[photo.name] = photo.cam_from_world.Center();
  }
  Eigen::Matrix3Xd from(3, found.photos.size());
  Eigen::Matrix3Xd to(3, found.photos.size());
  Eigen::Index i = 0;
  for (const auto& [id, photo] : found.photos) {
    from.col(i) = true_centres.at(photo.name);
    to.col(i++) = photo.cam_from_world.Center();
  }
  const Similarity world_from_truth = AlignPoints(from, to);
  const auto json = nlohmann::json::parse(ReadFile(kSample / "truth/planes.json"));
  const std::map<std::string, FacetClass> classes = {
      {"wall", FacetClass::kWall}, {"roof", FacetClass::kRoof}, {"ground", FacetClass::kGround}};
  Proxy proxy;
  proxy.metric = true;
  for (const auto& plane : json.at("planes")) {
    Facet facet;
    facet.id = plane.at("id");
    facet.facet_class = classes.at(plane.at("class"));
    const auto& n = plane.at("normal");
    facet.normal = (world_from_truth.rotation * Eigen::Vector3d(n[0], n[1], n[2])).normalized();
    for (const auto& p : plane.at("outer")) {
      facet.outer.push_back(world_from_truth * Eigen::Vector3d(p[0], p[1], p[2]));
    }
    facet.offset = facet.normal.dot(facet.outer.front());
    for (Eigen::Vector3d& p : facet.outer) p -= (p.dot(facet.normal) - facet.offset) * facet.normal;
    const std::string building = facet.id.substr(0, facet.id.find('/'));
    if (proxy.buildings.empty() || proxy.buildings.back().id != building) {
      proxy.buildings.emplace_back().id = building;
    }
    proxy.buildings.back().facets.push_back(std::move(facet));
  }
  fs::create_directories(survey / "proxy");
  WriteProxy(proxy, survey / kFacetsFile);
}

RetextureRequest RequestOf(const fs::path& photos, const std::string& epoch, ReplaceMode replace) {
  RetextureRequest request;
  request.photos = photos;
  request.epoch = epoch;
  request.replace = replace;
  return request;
}

}  // namespace

test::TemporaryFolder* RetextureSample::folder_ = nullptr;
std::FILE* RetextureSample::log_ = std::tmpfile();
bool RetextureSample::interrupted_ = false;

std::map<std::string, std::string> Contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (entry.is_regular_file() && !name.starts_with(kWorkFolder) &&
        !name.starts_with(kEpochsFolder)) {
      files[name] = HashFile(entry.path());
    }
  }
  return files;
}

void RetextureSample::SetUpTestSuite() {
  folder_ = new test::TemporaryFolder();
  for (const char* name : {"old", "same"}) fs::create_directories(*folder_ / name);
  for (const fs::directory_entry& photo : fs::directory_iterator(kSample / "photos")) {
    fs::copy(photo.path(), *folder_ / (IsNew(photo.path()) ? "same" : "old"));
  }
  InitSurvey(Survey(), *folder_ / "old", DefaultStages());
  RunOptions options;
  options.until = "calib";
  options.set = {"calib.max_image_px=700", "calib.max_features=1200"};
  Console console(log_, false, Verbosity::kQuiet);
  ASSERT_EQ(RunSurvey(Survey(), DefaultStages(), options, console, RealPlatform()).exit_code, 0);
  WriteTrueProxy(Survey());
  StageContext context;
  context.survey = Survey();
  context.photos = *folder_ / "old";
  context.out = Survey() / "texture";
  fs::create_directories(context.out);
  context.threads = 2;
  context.progress = &SilentProgress();
  context.units = &NoUnits();
  TextureOptions texture;
  texture.max_texture_px = 400;  // small enough for a test
  RunTexture(texture, context);
}
void RetextureSample::TearDownTestSuite() {
  delete folder_;
  std::fclose(log_);
}

RetextureReport RetextureSample::RunIn(const fs::path& survey, RetextureRequest request) {
  Console console(log_, false, Verbosity::kQuiet);
  request.command = "retexture";
  Platform platform = RealPlatform();
  platform.interrupted = [] { return interrupted_; };
  return RetextureSurvey(survey, request, DefaultStages(), console, platform);
}

RetextureReport RetextureSample::Run(const std::string& set, const std::string& epoch,
                                     ReplaceMode replace) {
  return Run(RequestOf(Photos(set), epoch, replace));
}

RetextureReport RetextureSample::Run(const RetextureRequest& request) {
  return RunIn(Survey(), request);
}

Error RetextureSample::RefusalIn(const fs::path& survey, const RetextureRequest& request) {
  try {
    RunIn(survey, request);
  } catch (const Error& e) {
    return e;
  }
  return Error(ErrorKind::kUsage, "was not refused");
}

Error RetextureSample::RefusalOf(const fs::path& survey, const std::string& set,
                                 const std::string& epoch) {
  return RefusalIn(survey, RequestOf(Photos(set), epoch, ReplaceMode::kAuto));
}

Error RetextureSample::Refusal(const std::string& set, const std::string& epoch) {
  return RefusalOf(Survey(), set, epoch);
}

Error RetextureSample::Refusal(const RetextureRequest& request) {
  return RefusalIn(Survey(), request);
}

std::vector<std::string> RetextureSample::OtherPictures(const fs::path& epoch) {
  std::vector<std::string> other;
  for (const char* kind : {"textures", "labels", "orthophotos"}) {
    for (const auto& file : fs::directory_iterator(Survey() / "texture" / kind)) {
      const fs::path name = fs::path(kind) / file.path().filename();
      if (!fs::exists(epoch / name) || HashFile(epoch / name) != HashFile(file.path())) {
        other.push_back(name.generic_string());
      }
    }
  }
  return other;
}

}  // namespace stucco
