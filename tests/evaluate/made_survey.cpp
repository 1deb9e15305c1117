// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/evaluate/made_survey.h"

#include "evaluate/geometry/compare_proxy.h"
#include "evaluate/geometry/moved.h"
#include "simulate/scene/scene_folder.h"
#include "survey/colmap_io.h"
#include "survey/files.h"
#include "survey/point_cloud.h"
#include "survey/survey_folder.h"
#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

namespace fs = std::filesystem;

constexpr char kStats[] = R"({"version": 1, "method": "cocapture", "photos": 13, "hovers": 9,
 "length_m": 812.5, "time_min": 6.25, "battery_percent": 21.5,
 "mean_by_length": {"q_s": 0.5, "q_d": 0.25, "q_u": 0.75, "q_c": 1}})";

void WriteScene(const fs::path& folder) {
  fs::create_directories(folder / "truth");
  simulate::SceneInfo info;
  info.style = "hamlet";
  info.seed = 7;
  info.georef = MadeGeoref();
  info.has_truth = true;
  simulate::WriteSceneInfo(info, folder);
  simulate::WriteGlb(MadeScene(MadeTruth()), folder / simulate::kSceneModel);
  WriteProxy(MadeTruth(), folder / simulate::kTruthFacets);
}

}  // namespace

MadeSurvey WriteMadeSurvey(const fs::path& root, const Similarity& truth_from_world) {
  const MadeSurvey made{root / "scene", root / "survey"};
  fs::remove_all(root);
  for (const char* folder : {"plan", "calib/sparse/0", "dense", "proxy", "truth"}) {
    fs::create_directories(made.survey / folder);
  }
  WriteScene(made.scene);
  simulate::Flight flight = MadeFlight();
  flight.scene = made.scene.string();
  flight.georef = MadeGeoref();
  simulate::WriteFlight(flight, made.survey);
  const Similarity world_from_truth = truth_from_world.Inverse();
  Reconstruction result = MadeReconstruction(flight);
  Transform(world_from_truth, result);
  WriteColmapText(result, made.survey / kSparseFolder);
  WriteGeoref(MadeGeoref(), made.survey / kGeorefFile);
  Surface surface = BuildingSurface(MadeTruth());
  Append(MadeTruth().buildings.back().facets[0], surface);
  PointCloud cloud;
  for (const SurfacePoint& point : SamplePoints(surface, 200000, 3)) {
    cloud.positions.push_back(world_from_truth * point.position);
  }
  WritePly(cloud, made.survey / kCloudFile);
  WriteProxy(Moved(MadeTruth(), world_from_truth), made.survey / kFacetsFile);
  WriteFile(made.survey / "plan/stats.json", kStats);
  return made;
}

}  // namespace stucco::evaluate
