// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "evaluate/figures/attempt.h"
#include "evaluate/geometry/cloud.h"
#include "evaluate/geometry/compare_proxy.h"
#include "evaluate/geometry/part_near.h"
#include "evaluate/geometry/poses.h"
#include "evaluate/geometry/seen.h"
#include "evaluate/measure_pictures.h"
#include "evaluate/picture/lpips.h"
#include "evaluate/plan_figures.h"
#include "evaluate/truth.h"
#include "simulate/scene/scene_folder.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/plan_io.h"
#include "survey/survey_folder.h"

namespace stucco::evaluate {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr char kStatsFile[] = "plan/stats.json";
constexpr char kMeshFile[] = "dense/mesh.ply";
constexpr size_t kTruthSamples = 200000;  // a share is then known to 0.1 %
constexpr uint64_t kSeed = 1;

// The scene as geometry, made once for every measure that needs it.
struct SceneShape {
  Surface relief;  // buildings and ground with all they have standing out
  SceneIndex index;
  TruthPoints wanted;  // of the relief, near buildings
};

SceneShape ShapeOf(const simulate::Scene& scene, const Truth& truth, int threads) {
  SceneShape shape{ReliefOf(scene),
                   {SurfaceIndex(SurfaceOf(scene)), SurfaceIndex(BuildingSurface(truth.facets))},
                   {}};
  const Surface surveyed = PartNear(shape.relief, shape.index.buildings, kGroundReachM);
  shape.wanted.points = SamplePoints(surveyed, kTruthSamples, kSeed);
  shape.wanted.showing = PhotosThatShow(shape.wanted.points, DeliveredPhotos(truth.flight),
                                        shape.index.everything, kPhotosToConfirm, threads);
  return shape;
}

class Evaluator {
 public:
  Evaluator(const EvaluateRequest& request, Truth truth)
      : request_(request), truth_(std::move(truth)) {
    evaluation_.survey = NameOf(request.survey);
    evaluation_.scene = NameOf(request.scene);
    evaluation_.tolerance_m = request.tolerance_m;
  }

  Evaluation Run() {
    Try("the plan is", [&] { MeasurePlan(); });
    Try("poses, and what lies in their frame, are", [&] { MeasurePoses(); });
    if (truth_from_world_) MeasureResults();
    return std::move(evaluation_);
  }

 private:
  // Results must not depend on where the folders lie.
  static std::string NameOf(const fs::path& folder) {
    const fs::path whole = fs::absolute(folder).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  }
  void Note(std::string note) { evaluation_.notes.push_back(std::move(note)); }
  void Try(const char* measured, const std::function<void()>& measure) {
    Attempt(measured, measure, evaluation_);
  }
  // Whether the survey has a file; if not, says what is therefore not measured.
  bool Has(std::string_view file, const char* measured) {
    if (fs::exists(request_.survey / file)) return true;
    Note(fmt::format("{} not measured: there is no {}; {} makes it", measured, file,
                     file == kStatsFile ? "stucco plan" : "stucco run"));
    return false;
  }

  void MeasurePlan() {
    if (!Has(kStatsFile, "the plan is")) return;
    evaluation_.plan = ReadPlanFigures(request_.survey / kStatsFile);
    evaluation_.has_plan = true;
  }

  void MeasurePoses() {
    evaluation_.poses.total = static_cast<int>(DeliveredPhotos(truth_.flight).size());
    if (!Has(kSparseFolder, "poses, and what lies in their frame, are")) return;
    const Reconstruction result = ReadColmapModel(request_.survey / kSparseFolder);
    Georef georef;
    if (fs::exists(request_.survey / kGeorefFile)) {
      Try("georeferenced positions are",
          [&] { georef = ReadGeoref(request_.survey / kGeorefFile); });
    }
    PoseComparison poses = ComparePoses(result, georef, truth_.flight, truth_.info.georef);
    evaluation_.poses = poses.figures;
    for (std::string& note : poses.notes) Note(std::move(note));
    truth_from_world_ = poses.truth_from_world;
    if (!truth_from_world_) Note("nothing in the frame of the poses is measured either");
  }

  void MeasureResults() {
    const bool has_cloud = Has(kCloudFile, "the cloud is");
    const bool has_mesh = fs::exists(request_.survey / kMeshFile);
    const bool has_proxy = Has(kFacetsFile, "the model is");
    const bool has_textures = Has(kTexturesFile, "textures and views are") && has_proxy;
    if (!has_cloud && !has_mesh && !has_proxy) return;
    Try("surfaces and pictures are", [&] {
      simulate::Scene scene = simulate::ReadScene(request_.scene);
      MeasureShapes(scene, has_cloud, has_mesh, has_proxy);
      if (!has_textures) return;
      Try("textures and views are", [&] {
        MeasurePictures(request_, truth_, std::move(scene), *truth_from_world_, evaluation_);
      });
    });
  }

  void MeasureShapes(const simulate::Scene& scene, bool has_cloud, bool has_mesh, bool has_proxy) {
    const SceneShape shape = ShapeOf(scene, truth_, request_.threads);
    if (has_cloud) Try("the cloud is", [&] { MeasureCloud(shape); });
    if (has_mesh) Try("the mesh is", [&] { MeasureMesh(shape); });
    if (has_proxy) Try("the model is", [&] { MeasureProxy(shape); });
  }

  void MeasureCloud(const SceneShape& shape) {
    evaluation_.dense = CompareCloud(request_.survey / kCloudFile, *truth_from_world_, shape.index,
                                     shape.wanted, {tolerance(), threads()});
  }

  void MeasureMesh(const SceneShape& shape) {
    simulate::ModelReading reading;
    reading.up = simulate::UpAxis::kZ;
    Surface mesh = SurfaceOf(simulate::ReadScene(request_.survey / kMeshFile, reading));
    for (Vector3d& vertex : mesh.vertices) vertex = *truth_from_world_ * vertex;
    evaluation_.mesh = CompareSurface(SurfaceIndex(std::move(mesh)), shape.index, shape.wanted,
                                      {tolerance(), threads()});
  }

  void MeasureProxy(const SceneShape& shape) {
    const Proxy proxy = ReadProxy(request_.survey / kFacetsFile);
    const auto photos = DeliveredPhotos(truth_.flight);
    std::vector<std::string> planned;
    if (fs::exists(request_.survey / kPlanFile)) {
      for (const PlannedFacade& facade : ReadPlan(request_.survey / kPlanFile).facades) {
        planned.push_back(facade.id);
      }
    }
    evaluation_.proxy = CompareProxy(proxy, *truth_from_world_,
                                     {truth_.facets, shape.relief, shape.index, photos, planned},
                                     tolerance(), threads());
  }

  double tolerance() const { return request_.tolerance_m; }
  int threads() const { return request_.threads; }

  const EvaluateRequest& request_;
  Truth truth_;
  Evaluation evaluation_;
  std::optional<Similarity> truth_from_world_;
};

}  // namespace

Evaluation Evaluate(const EvaluateRequest& request) {
  if (!(request.tolerance_m > 0) || !std::isfinite(request.tolerance_m)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("a tolerance of {} m makes no sense", request.tolerance_m));
  }
  if (!fs::is_directory(request.survey)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: no such survey", request.survey.string()));
  }
  // Before anything that takes minutes; the folder not for what cannot be measured.
  if (!request.lpips_model.empty()) Lpips{request.lpips_model};
  const fs::path& flight = request.flight.empty() ? request.survey : request.flight;
  Truth truth = ReadTruth(request.scene, flight);
  if (!request.output.empty()) MakeOutputFolder(request.output);
  return Evaluator(request, std::move(truth)).Run();
}

}  // namespace stucco::evaluate
