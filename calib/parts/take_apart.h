// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/adjust/covariance.h"
#include "calib/mapping/mapper.h"
#include "calib/parts/place_part.h"
#include "calib/records/records.h"
#include "calib/scene/scene.h"
#include "calib/two_view/initial_pair.h"
#include "survey/captures.h"
#include "survey/plan.h"
#include "survey/stage.h"

namespace stucco {

// Photos that hang together, and with the others by nothing but records, if at all.
struct ScenePart {
  Scene scene;  // SceneOf these photos, with poses and points
  SceneSigmas sigmas;
  std::optional<PartPlace>
      place;  // against the first part, by records; nothing: a frame of its own
  // 0: it stays in the scene. Else it is a model of its own, numbered from 1: it is in no frame
  // with the others, or so unsurely that surfaces which both see would come out double.
  int model = 0;
  std::string why;  // for people: what parts it, and what would join it
};

struct PartsInput {
  const MapperOptions& mapper;
  const std::vector<VerifiedPair>& pairs;
  const std::vector<const CapturedPhoto*>& captures;  // of the scene's photos
  const std::optional<Plan>& plan;
  // Of the scene's photos, in its frame; those that hold it have their errors, too.
  const std::vector<PoseRecord>& records;
  const RecordErrors* errors = nullptr;
  const StageContext& context;
};

struct SceneParts {
  std::vector<int> part_of_photo;  // -1: in none; 0: the first, which is not in `others`
  std::vector<ScenePart> others;   // part i + 1
  std::map<int, std::string>
      taken;  // photos that lost a pose that hardly anything but records held
};

// What comes apart of a calibrated scene. Groups that share too few points with the largest stand
// in one frame with it by their records alone, if at all. One that sees nothing that the largest
// sees stays in the scene: a house farther on is better a hand beside its place than not there. One
// that sees the same surfaces only stays where it is placed better than a pixel. What hangs on the
// largest so loosely that its points are less sure in its pictures than matches may be off, and
// five times less than is usual, counts as untied. Photos without a pose that overlap with each
// other are reconstructed, group by group, and placed by their records likewise. Fewer than five
// photos are no part. `sigmas` are those of the scene; in the end each pose's are within its part.
SceneParts TakeApart(const PartsInput& input, SceneSigmas& sigmas, Scene& scene);

// Why photos are not in the scene, as far as that is due to their parts.
std::map<int, std::string> WhyApart(const SceneParts& parts);

}  // namespace stucco
