// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/mapping/mapper.h"
#include "calib/matching/guidance.h"
#include "calib/matching/match_photos.h"
#include "calib/options/calib_options.h"
#include "calib/records/barometer.h"
#include "calib/records/records.h"
#include "calib/scene/scene.h"
#include "survey/captures.h"
#include "survey/georef.h"
#include "survey/stage.h"

namespace stucco {

// The photos that calibration works on: those that ingest could read.
struct UsablePhotos {
  Captures captures;  // heights are the barometers' where these are steadier
  SteadiedHeights heights;
  std::vector<const CapturedPhoto*> usable;
  std::vector<int> capture_of_photo;
};

// How the scene came about, and what its photos' records say.
struct Reconstructed {
  std::optional<Georef> frame;  // of the positions; nothing where there are none
  std::vector<PoseRecord> records;
  bool is_in_frame = false;  // it began at the records
  std::string finding;       // of the records, for people; may be empty
};

struct PlaceInput {
  const CalibOptions& options;
  const MapperOptions& mapper;
  const UsablePhotos& photos;
  const Guidance& guidance;
  const DetectedFeatures& features;
  const StageContext& context;
};

// Makes a scene of poses, cameras and points by the matches and by what photos and plan say of
// where they were taken. Walls that repeat themselves are matched again as far as poses then tell
// their bays apart (match_again.h), and photos placed anew, until no more of them have a pose.
// `matched` holds the pairs that were used in the end, `repeating` what photos show of such walls
// from there.
Reconstructed PlacePhotos(const PlaceInput& input, OnRepeatingWalls& repeating,
                          MatchedPairs& matched, Scene& scene);

}  // namespace stucco
