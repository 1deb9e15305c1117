// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/fly.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "simulate/flight/choose_views.h"
#include "simulate/flight/ground_control.h"
#include "simulate/flight/photo_store.h"
#include "simulate/flight/prepare.h"
#include "simulate/flight/take_photos.h"
#include "simulate/render/renderer.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/plan_io.h"
#include "survey/survey_folder.h"

namespace stucco::simulate {
namespace {

namespace fs = std::filesystem;

// Changes when the same flight gives other photos.
constexpr char kFlightVersion[] = "4";

fs::path PlanPath(const fs::path& given) {
  std::error_code error;
  if (!fs::is_directory(given, error)) return given;
  for (const char* name : {kPlanFile, "plan.json"}) {
    if (fs::exists(given / name, error)) return given / name;
  }
  throw Error(ErrorKind::kBadInput, fmt::format("{}: has no {}", given.string(), kPlanFile),
              "make one with stucco plan");
}

std::string MadeFrom(const Scene& scene, const Georef& place, const fs::path& plan,
                     FlightOptions options) {
  options.write_depth = false;  // changes no photo
  OptionTable table("simulate");
  Describe(table, options);
  const std::string parts[] = {kFlightVersion, HashScene(scene),
                               fmt::format("{} {} {} {}", place.frame, place.origin_latitude_deg,
                                           place.origin_longitude_deg, place.origin_height_m),
                               HashFile(plan), CanonicalText(table)};
  return HashParts(parts);
}

SceneShape ShapeOf(const Renderer& renderer, const SceneInfo& info) {
  SceneShape shape;
  shape.is_ours = !info.style.empty() || info.has_truth;
  for (const Eigen::Vector3f& position : renderer.scene().positions) {
    shape.box.extend(position.cast<double>().eval());
  }
  shape.elements = renderer.scene().elements;
  shape.cast = [&renderer](const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
    return renderer.Cast(from, direction);
  };
  return shape;
}

Photographer PhotographerOf(const Renderer& renderer) {
  Photographer photographer;
  photographer.photograph = [&renderer](const Camera& camera, const Pose& pose, const Light& light,
                                        int threads) {
    return renderer.Photograph(camera, pose, light, {.threads = threads, .left_out = {}});
  };
  photographer.depth = [&renderer](const Camera& camera, const Pose& pose, int threads) {
    return renderer.Depth(camera, pose, {.threads = threads, .left_out = {}});
  };
  return photographer;
}

// Says which files an error is about, and what to do where nobody else does.
template <typename Fn>
auto About(const std::string& files, const char* remedy, const Fn& fn) {
  try {
    return fn();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kBadInput) throw;
    const std::string what = error.what();
    throw Error(error.kind(), what.starts_with(files) ? what : fmt::format("{}: {}", files, what),
                error.remedy().empty() ? remedy : error.remedy());
  }
}

void RequireNoOtherPlan(const fs::path& plan, const fs::path& survey) {
  const fs::path kept = survey / kPlanFile;
  std::error_code error;
  if (!fs::exists(kept, error) || fs::equivalent(plan, kept, error)) return;
  if (ReadFile(kept) == ReadFile(plan)) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: is another plan than {}", kept.string(), plan.string()),
              "simulate into a new survey");
}

// The survey keeps the plan that it was flown by.
void KeepPlan(const fs::path& plan, const fs::path& survey) {
  RequireNoOtherPlan(plan, survey);
  const fs::path kept = survey / kPlanFile;
  std::error_code error;
  if (fs::exists(kept, error)) return;
  fs::create_directories(kept.parent_path(), error);  // what fails here fails in writing
  WriteFileAtomically(kept, ReadFile(plan));
}

void WriteControl(const Flight& flight, const Renderer& renderer, int count,
                  const fs::path& survey) {
  const auto cast = [&renderer](const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
    return renderer.Cast(from, direction);
  };
  WriteFileAtomically(survey / kTrueControlFile,
                      GroundControlText(SurveyPoints(flight, cast, count)));
}

}  // namespace

FlySummary Fly(const FlyRequest& request, const FlightOptions& options,
               const std::function<void(size_t, size_t)>& progress) {
  FlyRequest real = request;
  if (real.threads <= 0) {
    real.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  const fs::path plan_path = PlanPath(request.plan);
  const Plan plan = ChooseViews(About(plan_path.string(), "make the plan again with stucco plan",
                                      [&] { return ReadPlan(plan_path); }),
                                options);
  // Before anything is written, and before the scene is read, which takes time.
  RequireNoOtherPlan(plan_path, request.survey);
  RequireFreeStore(request.survey);
  const SceneInfo info = ReadSceneInfo(request.scene);
  Scene scene = ReadScene(request.scene, request.reading);
  const std::string made_from = MadeFrom(scene, info.georef, plan_path, options);
  const Renderer renderer(std::move(scene));
  const std::string both = fmt::format("{} in {}", plan_path.string(), request.scene.string());
  PreparedFlight prepared =
      About(both, "", [&] { return PrepareFlight(plan, info, ShapeOf(renderer, info), options); });
  prepared.flight.scene = request.scene.string();
  prepared.flight.scene_hash = HashFile(ModelFile(request.scene));
  prepared.flight.made_from = made_from;
  if (renderer.scene().textures.empty()) {
    prepared.notes.push_back(
        "the scene has no textures: photos show plain colours, on which little can be matched");
  }
  const Photographer photographer = PhotographerOf(renderer);
  renderer.PrepareLight();
  MeterFlight(photographer, options, real.threads, prepared);
  if (progress) {
    progress(0, static_cast<size_t>(
                    std::count_if(prepared.flight.photos.begin(), prepared.flight.photos.end(),
                                  [](const FlownPhoto& photo) { return !photo.lost; })));
  }
  KeepPlan(plan_path, request.survey);
  FlySummary summary = TakePhotos(prepared, photographer, options, real, progress);
  if (options.ground_control > 0) {
    WriteControl(prepared.flight, renderer, options.ground_control, request.survey);
  }
  return summary;
}

}  // namespace stucco::simulate
