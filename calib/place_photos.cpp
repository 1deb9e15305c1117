// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/place_photos.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "calib/mapping/start_from_records.h"
#include "calib/matching/contradictions.h"
#include "calib/matching/known_poses.h"
#include "calib/matching/match_again.h"
#include "calib/matching/place_on_walls.h"
#include "calib/records/georeference.h"
#include "calib/scene/as_model.h"
#include "calib/scene/tracks.h"
#include "calib/two_view/focal.h"
#include "survey/plan_of_survey.h"

namespace stucco {
namespace {

constexpr int kMostRounds = 3;

// Without tracks.
Scene MakeScene(const CalibOptions& options, const UsablePhotos& photos,
                const DetectedFeatures& features) {
  Scene scene;
  for (const CapturedCamera& captured : photos.captures.cameras) {
    // What was given as the truth keeps its own model; the rest is calibrated with the wished one.
    CameraModel model = *CameraModelFromName(options.camera_model);
    if (captured.fixed && captured.intrinsics.params.size() > ParameterNames(model).size()) {
      model = captured.intrinsics.model;
    }
    const Camera camera = AsModel(captured.intrinsics, model);
    scene.cameras.push_back({camera, camera, FocalSigmaRatio(captured)});
  }
  for (size_t i = 0; i < photos.usable.size(); ++i) {
    ScenePhoto photo;
    photo.name = photos.usable[i]->path;
    photo.camera = photos.usable[i]->camera;
    photo.keypoint_sigma_px = DetectionScale(options, *photos.usable[i]);
    Features all = features.AllOf(static_cast<int>(i));
    for (const Keypoint& k : all.keypoints) {
      photo.keypoints.emplace_back(k.x, k.y);
      photo.blobs_px.push_back(k.scale);
    }
    photo.colors = std::move(all.colors);
    scene.photos.push_back(std::move(photo));
  }
  return scene;
}

void AddTracks(const std::vector<VerifiedPair>& pairs, Scene& scene) {
  std::vector<size_t> num_keypoints;
  num_keypoints.reserve(scene.photos.size());
  for (const ScenePhoto& photo : scene.photos) num_keypoints.push_back(photo.keypoints.size());
  std::vector<const PhotoPair*> matches;
  matches.reserve(pairs.size());
  for (const VerifiedPair& pair : pairs) matches.push_back(&pair.pair);
  scene.tracks = BuildTracks(num_keypoints, std::move(matches));
  IndexTracks(scene);
}

void QuestionPairs(const Guidance& guidance, const Scene& scene, const StageContext& context,
                   std::vector<VerifiedPair>& pairs) {
  if (!guidance.views) return;
  const int dropped = DropContradictions(*guidance.views, scene, pairs);
  if (dropped == 0) return;
  context.progress->Note(fmt::format(
      "{} pairs of photos are not used: their matches contradict the plan, as those of something "
      "that repeats itself do",
      dropped));
}

// Cameras whose metadata say nothing get a focal length from the epipolar geometries of their
// photos.
void GuessFocalLengths(const UsablePhotos& photos, const std::vector<VerifiedPair>& pairs,
                       const StageContext& context, Scene& scene) {
  for (size_t c = 0; c < scene.cameras.size(); ++c) {
    if (photos.captures.cameras[c].focal_source != "default") continue;
    std::vector<FocalEvidence> evidence;
    for (const VerifiedPair& pair : pairs) {
      const bool of_this_camera = scene.photos[pair.pair.first].camera == static_cast<int>(c) &&
                                  scene.photos[pair.pair.second].camera == static_cast<int>(c);
      const bool is_plane = pair.geometry.num_homography > 0.7 * pair.geometry.num_fundamental;
      if (!of_this_camera || is_plane || pair.geometry.num_fundamental < 50) continue;
      evidence.push_back({pair.geometry.fundamental, pair.geometry.num_fundamental});
    }
    SceneCamera& camera = scene.cameras[c];
    const auto focal =
        FocalFromFundamentals(evidence, camera.prior.width_px, camera.prior.height_px);
    if (!focal) continue;
    context.progress->Note(
        fmt::format("{}: no focal length in the metadata; {} pairs of photos say {:.0f} px",
                    photos.captures.cameras[c].label, evidence.size(), *focal));
    for (Camera* each : {&camera.prior, &camera.intrinsics})
      each->params[0] = each->params[1] = *focal;
  }
}

// Why the photos' own positions do not hold the frame; empty where nobody needs to know.
std::string WhyNoFrame(const UsablePhotos& photos, bool plan_holds_it) {
  int positions = 0;
  int heights = 0;
  for (const CapturedPhoto* photo : photos.usable) {
    positions += photo->position.has_value();
    heights += photo->position && photo->position->has_height;
  }
  if (heights > 0 && !plan_holds_it) {
    return fmt::format(
        "only {} of the photos say where and how high they were taken: three or more are needed "
        "for a scale and a place",
        heights);
  }
  if (heights > 0) return "too few photos have a height: the plan's places took their place";
  if (positions == 0) {
    return plan_holds_it
               ? "the photos do not say where they were taken: they begin where the plan wanted "
                 "them, and the model lies where the plan's map does, to some metres"
               : "";
  }
  return plan_holds_it
             ? "the photos' positions have no heights: those of the plan took their place"
             : "the photos' positions have no heights and are not used; switch heights on in the "
               "camera, or run with the plan";
}

Reconstructed ReadRecordsOf(const CalibOptions& options, const UsablePhotos& photos,
                            const Guidance& guidance, const StageContext& context, Scene& scene) {
  Reconstructed result;
  const std::optional<Plan> plan = PlanOfSurvey(context);
  if (options.use_positions) result.frame = FrameFromPositions(photos.usable, scene);
  const bool by_plan = options.use_positions && !result.frame && guidance.views;
  if (by_plan) result.frame = FrameFromPlan(plan->origin, guidance.views->poses, scene);
  if (options.use_positions && (by_plan || !result.frame)) {
    result.finding = WhyNoFrame(photos, result.frame.has_value());
  }
  result.records = ReadRecords(photos.usable, plan ? &*plan : nullptr, scene);
  for (size_t i = 0; i < result.records.size(); ++i) {
    result.records[i].height_zero_sigma_m = photos.heights.zero_sigma_m[photos.capture_of_photo[i]];
  }
  for (size_t i = 0; by_plan && i < result.records.size(); ++i) {
    const std::optional<Pose>& expected = guidance.views->poses[i];
    if (expected && !result.records[i].gimbal) result.records[i].gimbal = expected->rotation;
  }
  return result;
}

// Photos at their records first, corrected by their matches; what has no record, or where records
// are of no use, one photo after the other.
void PlaceOnce(MapperOptions mapper, const std::vector<VerifiedPair>& pairs,
               const StageContext& context, Reconstructed& from, Scene& scene) {
  if (from.frame) {
    const RecordsStart start = StartFromRecords(mapper, pairs, from.records, context, scene);
    from.is_in_frame = start.usable;
    if (!start.why_not.empty()) {
      context.progress->Note(
          fmt::format("photos are placed one after the other: {}", start.why_not));
    }
  }
  if (from.is_in_frame) {
    mapper.use_priors = true;
    GrowOn(mapper, context, scene);
  } else {
    Reconstruct(mapper, pairs, context, scene);
  }
}

// Chooses what the pairs say, and gives photos poses by it. Requires a scene without tracks.
Reconstructed PlaceMatched(const PlaceInput& input, const std::vector<bool>& may_be_bays_off,
                           std::vector<VerifiedPair>& pairs, Scene& scene) {
  QuestionPairs(input.guidance, scene, input.context, pairs);
  AddTracks(pairs, scene);
  for (VerifiedPair& pair : pairs) ClassifyMotion(scene, input.mapper.max_error_sigmas, pair);
  Reconstructed placed =
      ReadRecordsOf(input.options, input.photos, input.guidance, input.context, scene);
  for (size_t i = 0; i < placed.records.size(); ++i) {
    placed.records[i].may_be_bays_off = may_be_bays_off[i];
  }
  PlaceOnce(input.mapper, pairs, input.context, placed, scene);
  return placed;
}

void NoteRepeating(const Guidance& guidance, const OnRepeatingWalls& repeating,
                   const StageContext& context) {
  std::vector<std::string> names;
  for (const auto& [wall, period] : repeating.period_m) {
    names.push_back(fmt::format("{} every {:.1f} m", guidance.facades[wall].id, period));
  }
  context.progress->Note(
      fmt::format("walls that repeat themselves are matched as far as poses tell bays apart: {}",
                  fmt::join(names, ", ")));
}

std::vector<std::optional<Pose>> SurePoses(const std::vector<std::optional<KnownPose>>& known) {
  std::vector<std::optional<Pose>> poses(known.size());
  for (size_t i = 0; i < known.size(); ++i) {
    if (known[i] && !known[i]->is_recorded) poses[i] = known[i]->cam_from_plan;
  }
  return poses;
}

// Whatever pose was looked from: a wrong one may not show the walls that made it wrong.
void DoubtBays(const OnRepeatingWalls& repeating, std::vector<bool>& may_be_bays_off) {
  for (size_t i = 0; i < may_be_bays_off.size(); ++i) {
    if (repeating.IsMostOf(static_cast<int>(i))) may_be_bays_off[i] = true;
  }
}

// Those that hang on what repeats itself are placed once others tell where they are.
Reconstructed PlaceInRounds(const PlaceInput& input, OnRepeatingWalls& repeating,
                            MatchedPairs& matched, Scene& scene) {
  const Scene start = scene;
  const MatchedPairs first = matched;
  std::vector<bool> may_be_bays_off(scene.photos.size(), false);
  DoubtBays(repeating, may_be_bays_off);
  Reconstructed placed = PlaceMatched(input, may_be_bays_off, matched.verified, scene);
  if (!placed.is_in_frame) return placed;
  NoteRepeating(input.guidance, repeating, input.context);
  const PhotoSet set{input.photos.captures, input.photos.usable, input.guidance};
  bool go_on = true;
  for (int round = 0; round < kMostRounds && go_on; ++round) {
    const int before = NumRegistered(scene);
    ApplyRecords(placed.records, MeasureRecordErrors(placed.records, scene), scene);
    const KnownPoses known = KnowPoses({input.guidance, repeating, placed.records}, scene);
    const DetectInput detect{input.options, set, input.context};
    LookAgain(detect, input.features, SurePoses(known.poses), repeating);
    // Before a wall that stands elsewhere everything is off, each photo by itself.
    auto poses = known.poses;
    if (known.on_map) {
      poses = PlaceOnWalls({input.options, set, input.features, repeating, poses, input.context});
      LookAgain(detect, input.features, SurePoses(poses), repeating);
    }
    MatchedPairs again = first;
    DropOnRepeatingWalls(repeating, static_cast<size_t>(input.mapper.min_inliers), again.verified);
    if (MatchAgain({input.options, set, input.features, repeating, poses, input.context}, again) ==
        0) {
      break;
    }
    matched = std::move(again);
    scene = start;
    DoubtBays(repeating, may_be_bays_off);
    placed = PlaceMatched(input, may_be_bays_off, matched.verified, scene);
    // Walls that are matched tell the map's place.
    go_on = NumRegistered(scene) > before || !known.on_map;
  }
  return placed;
}

}  // namespace

Reconstructed PlacePhotos(const PlaceInput& input, OnRepeatingWalls& repeating,
                          MatchedPairs& matched, Scene& scene) {
  scene = MakeScene(input.options, input.photos, input.features);
  GuessFocalLengths(input.photos, matched.verified, input.context, scene);
  if (!repeating.period_m.empty()) return PlaceInRounds(input, repeating, matched, scene);
  const std::vector<bool> none(scene.photos.size(), false);
  return PlaceMatched(input, none, matched.verified, scene);
}

}  // namespace stucco
