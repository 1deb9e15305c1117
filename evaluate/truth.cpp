// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/truth.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "survey/error.h"
#include "survey/files.h"

namespace stucco::evaluate {
namespace {

namespace fs = std::filesystem;

// A camera farther from everything than this flew elsewhere.
constexpr double kFarthestM = 2000;

[[noreturn]] void Refuse(const std::string& what, const std::string& remedy) {
  throw Error(ErrorKind::kBadInput, what, remedy);
}

Eigen::AlignedBox3d BoxOf(const Proxy& facets) {
  Eigen::AlignedBox3d box;
  for (const Building& building : facets.buildings) {
    for (const Facet& facet : building.facets) {
      for (const Eigen::Vector3d& corner : facet.outer) box.extend(corner);
    }
  }
  return box;
}

// By the model's bytes; where the flight does not tell, by the folder that it was flown in, where
// that is still there.
bool IsOtherScene(const Truth& truth, const fs::path& scene) {
  std::error_code ignored;
  if (!truth.flight.scene_hash.empty() && fs::exists(scene / simulate::kSceneModel, ignored)) {
    return HashFile(scene / simulate::kSceneModel) != truth.flight.scene_hash;
  }
  if (!fs::exists(fs::path(truth.flight.scene) / simulate::kSceneFile, ignored)) return false;
  const simulate::SceneInfo flown = simulate::ReadSceneInfo(truth.flight.scene);
  return flown.style != truth.info.style || flown.seed != truth.info.seed;
}

void RequireSameScene(const Truth& truth, const fs::path& scene, const fs::path& flight) {
  const Eigen::AlignedBox3d box = BoxOf(truth.facets);
  bool elsewhere = IsOtherScene(truth, scene);
  for (const simulate::FlownPhoto& photo : truth.flight.photos) {
    const double away = box.exteriorDistance(photo.cam_from_world.Center());
    elsewhere = elsewhere || !(away <= kFarthestM);
  }
  if (!elsewhere) return;
  Refuse(fmt::format("{}: was flown in {}, which is not {}",
                     (flight / simulate::kFlightFile).string(), truth.flight.scene, scene.string()),
         "give the scene that the flight was simulated in");
}

}  // namespace

Truth ReadTruth(const fs::path& scene, const fs::path& flight) {
  Truth truth;
  truth.info = simulate::ReadSceneInfo(scene);
  if (!truth.info.has_truth) {
    Refuse(fmt::format("{}: has no truth to measure against", scene.string()),
           "give a scene folder that stucco simulate city made");
  }
  if (!fs::exists(scene / simulate::kTruthFacets)) {
    Refuse(fmt::format("{}: there is no {} in it", scene.string(), simulate::kTruthFacets),
           "make the scene again with stucco simulate city");
  }
  truth.facets = ReadProxy(scene / simulate::kTruthFacets);
  if (!fs::exists(flight / simulate::kFlightFile)) {
    Refuse(fmt::format("{}: there is no {} in it", flight.string(), simulate::kFlightFile),
           "give a survey that stucco simulate flew; where it lies elsewhere, with --flight");
  }
  truth.flight = simulate::ReadFlight(flight);
  RequireSameScene(truth, scene, flight);
  return truth;
}

}  // namespace stucco::evaluate
