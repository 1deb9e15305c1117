// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/calibrate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "calib/adjust.h"
#include "calib/as_model.h"
#include "calib/contradictions.h"
#include "calib/covariance.h"
#include "calib/detect_photos.h"
#include "calib/focal.h"
#include "calib/georeference.h"
#include "calib/ground_control.h"
#include "calib/hold_by_control.h"
#include "calib/mapper.h"
#include "calib/match_photos.h"
#include "calib/panorama.h"
#include "calib/photos_csv.h"
#include "calib/records.h"
#include "calib/start_from_records.h"
#include "calib/summarize.h"
#include "calib/summarize_control.h"
#include "calib/summarize_photos.h"
#include "calib/take_apart.h"
#include "calib/tracks.h"
#include "calib/write_results.h"
#include "calib/wrong_poses.h"
#include "survey/calibration.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/plan_of_survey.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

constexpr double kRadians = M_PI / 180;

struct Photos {
  Captures captures;
  std::vector<const CapturedPhoto*> usable;
  std::vector<int> capture_of_photo;
};

Photos ReadPhotos(const StageContext& context) {
  Photos photos;
  photos.captures = ReadCaptures(context.survey / kCapturesFile);
  for (size_t i = 0; i < photos.captures.photos.size(); ++i) {
    if (!photos.captures.photos[i].usable) continue;
    photos.usable.push_back(&photos.captures.photos[i]);
    photos.capture_of_photo.push_back(static_cast<int>(i));
  }
  if (photos.usable.size() < 2) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{} usable photo(s): poses need at least two that overlap",
                    photos.usable.size()),
        "add photos to the photo folder; ingest/captures.json says why others were refused");
  }
  return photos;
}

// Without tracks.
Scene MakeScene(const CalibOptions& options, const Photos& photos,
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
    for (const Keypoint& k : all.keypoints) photo.keypoints.emplace_back(k.x, k.y);
    photo.colors = std::move(all.colors);
    scene.photos.push_back(std::move(photo));
  }
  return scene;
}

void AddTracks(const std::vector<VerifiedPair>& pairs, Scene& scene) {
  std::vector<size_t> num_keypoints;
  num_keypoints.reserve(scene.photos.size());
  for (const ScenePhoto& photo : scene.photos) num_keypoints.push_back(photo.keypoints.size());
  std::vector<PhotoPair> matches;
  matches.reserve(pairs.size());
  for (const VerifiedPair& pair : pairs) matches.push_back(pair.pair);
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
void GuessFocalLengths(const Photos& photos, const std::vector<VerifiedPair>& pairs,
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

[[noreturn]] void ThrowNothingRegistered(const std::vector<VerifiedPair>& pairs,
                                         const std::vector<std::string>& findings) {
  if (pairs.empty()) {
    throw Error(
        ErrorKind::kStageFailed,
        "no two photos overlap: no pair has enough matches that agree with one geometry",
        "photograph every part of a wall from at least two, better three, positions that share "
        "more than half of the picture");
  }
  if (!findings.empty()) {
    throw Error(
        ErrorKind::kStageFailed, fmt::format("{}", fmt::join(findings, "; ")),
        "move between photos: depth comes from different positions, not from turning the camera");
  }
  throw Error(
      ErrorKind::kStageFailed,
      fmt::format("{} pairs of photos match, but none gives a start: too few matches, or seen "
                  "under too small an angle",
                  pairs.size()),
      "add photos between the existing ones, taken from clearly different positions");
}

// How the scene came about, and what its photos' records say.
struct Reconstructed {
  std::optional<Georef> frame;  // of the positions; nothing where there are none
  std::vector<PoseRecord> records;
  bool is_in_frame = false;  // it began at the records
  std::string finding;       // of the records, for people; may be empty
  std::optional<Plan> plan;
};

// Why the photos' own positions do not hold the frame; empty where nobody needs to know.
std::string WhyNoFrame(const Photos& photos, bool plan_holds_it) {
  int positions = 0;
  int heights = 0;
  for (const CapturedPhoto* photo : photos.usable) {
    positions += photo->position.has_value();
    heights += photo->position && photo->position->has_height;
  }
  if (heights > 0) return "";
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

Reconstructed ReadRecordsOf(const CalibOptions& options, const Photos& photos,
                            const Guidance& guidance, const StageContext& context, Scene& scene) {
  Reconstructed result;
  const std::optional<Plan>& plan = result.plan = PlanOfSurvey(context);
  if (options.use_positions) result.frame = FrameFromPositions(photos.usable, scene);
  const bool by_plan = options.use_positions && !result.frame && guidance.views;
  if (by_plan) result.frame = FrameFromPlan(plan->origin, guidance.views->poses, scene);
  if (options.use_positions && (by_plan || !result.frame)) {
    result.finding = WhyNoFrame(photos, result.frame.has_value());
  }
  result.records = ReadRecords(photos.usable, plan ? &*plan : nullptr, scene);
  for (size_t i = 0; by_plan && i < result.records.size(); ++i) {
    const std::optional<Pose>& expected = guidance.views->poses[i];
    if (expected && !result.records[i].gimbal) result.records[i].gimbal = expected->rotation;
  }
  return result;
}

// Photos at their records first, corrected by their matches; what has no record, or where records
// are of no use, one photo after the other.
void PlacePhotos(MapperOptions mapper, const std::vector<VerifiedPair>& pairs,
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

struct GeoreferenceResult {
  Georef georef;
  std::vector<int> prior_outliers;
  PriorResiduals residuals;
  std::map<int, std::string> taken;     // photos whose poses contradict their records
  std::optional<RecordErrors> records;  // where they hold the frame
  SceneSigmas sigmas;
};

SceneSigmas SigmasOf(const MapperOptions& mapper, bool use_priors, const Scene& scene) {
  SigmaOptions options;
  options.use_priors = use_priors;
  options.tracks = TracksToAdjust(mapper, scene);
  options.threads = mapper.threads;
  return EstimateSigmas(options, scene);
}

// Judges every pose by what the records turned out to be good to, and adjusts once more with those
// that agree. Requires a scene in the frame of the records.
GeoreferenceResult RefineWithRecords(const MapperOptions& mapper,
                                     const std::vector<PoseRecord>& records,
                                     const StageContext& context, Scene& scene) {
  GeoreferenceResult result;
  const auto apply = [&] {
    result.records = MeasureRecordErrors(records, scene);
    ApplyRecords(records, *result.records, scene);
  };
  apply();
  const WrongPoses wrong = MendWrongPoses(mapper, context, scene);
  for (const int photo : wrong.corrected) {
    context.progress->Note(
        fmt::format("{}: posed anew from its record, which its first pose contradicted",
                    scene.photos[photo].name));
  }
  Settle(mapper, true, context, scene);
  apply();
  Converge(mapper, true, context, scene);
  apply();
  std::vector<int> taken = wrong.taken;
  for (const int photo : ContradictingPoses(scene)) {
    scene.photos[photo].pose.reset();
    taken.push_back(photo);
  }
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (scene.photos[i].pose && JudgePose(scene, i) != RecordVerdict::kAgrees) {
      result.prior_outliers.push_back(i);
    }
  }
  for (const int photo : taken) {
    result.taken[photo] =
        "its matches give a pose that contradicts its recorded position and angles by more than "
        "these are good to; something that repeats itself looks like that, or a wrong record";
  }
  FilterScene(mapper, scene);
  result.sigmas = SigmasOf(mapper, true, scene);
  for (size_t i = 0; i < records.size(); ++i) scene.photos[i].prior = records[i].position;
  return result;
}

GeoreferenceResult WithoutPositions(const Photos& photos, Scene& scene) {
  GeoreferenceResult result;
  for (ScenePhoto& photo : scene.photos) photo.prior.reset();
  result.residuals = MeasurePriors(scene, {});
  result.georef.up = UpFromGimbal(photos.usable, scene);
  result.georef.source = result.georef.up ? "gimbal" : "none";
  return result;
}

// Fits a scene that did not begin at the records to the positions. Nothing where these hold its
// frame, else what holds it.
std::optional<GeoreferenceResult> BringIntoFrame(const Reconstructed& from,
                                                 const MapperOptions& mapper, const Photos& photos,
                                                 const StageContext& context, Scene& scene) {
  const auto fit_to_priors = [&] {
    return from.frame ? FitToPriors(scene, UpFromGimbal(photos.usable, scene))
                      : std::optional<PriorFit>();
  };
  auto fit = fit_to_priors();
  if (fit && fit->holds == FitHolds::kEverything) {
    Transform(fit->enu_from_scene, scene);
    return std::nullopt;
  }
  // The positions take no part in the adjustment.
  RefineAll(mapper, false, context, scene);
  fit = fit_to_priors();
  if (!fit) {
    if (from.frame) {
      context.progress->Warn(
          "the photos' positions are too close together or contradict each other: the model keeps "
          "an arbitrary scale and direction");
    }
    return WithoutPositions(photos, scene);
  }
  Transform(fit->enu_from_scene, scene);
  if (fit->holds == FitHolds::kEverything) return std::nullopt;
  if (fit->holds == FitHolds::kScale) {
    context.progress->Warn(
        "the photos were taken along one line: their positions give the scale, but not which way "
        "is up; photograph from two heights or distances to mend that");
    GeoreferenceResult result = WithoutPositions(photos, scene);
    result.georef.metric = true;
    return result;
  }
  context.progress->Note(
      "the photos were taken along one line: the gimbal's angles say which way is up");
  GeoreferenceResult result;
  result.georef = *from.frame;
  result.prior_outliers = fit->outliers;
  return result;
}

GeoreferenceResult Georeference(const Reconstructed& from, const MapperOptions& mapper,
                                const Photos& photos, const StageContext& context, Scene& scene) {
  std::optional<GeoreferenceResult> without;
  if (!from.is_in_frame) without = BringIntoFrame(from, mapper, photos, context, scene);
  GeoreferenceResult result =
      without ? std::move(*without) : RefineWithRecords(mapper, from.records, context, scene);
  if (without) {
    result.sigmas = SigmasOf(mapper, false, scene);
  } else {
    result.georef = *from.frame;
  }
  for (const int photo : result.prior_outliers) {
    context.progress->Warn(
        fmt::format("{}: its recorded position contradicts the other photos and is not used",
                    scene.photos[photo].name));
  }
  result.residuals = MeasurePriors(scene, result.prior_outliers);
  return result;
}

Eigen::Vector3d SurveyedSigma(const CalibOptions& options) {
  return {options.control_sigma_horizontal_m, options.control_sigma_horizontal_m,
          options.control_sigma_vertical_m};
}

// Brings the scene to its control points, where it has some.
ControlOutcome UseGroundControl(const ControlInput& input, GeoreferenceResult& georeference,
                                Scene& scene) {
  if (input.control.file.empty()) return {};
  ControlOutcome outcome = HoldByControl(input, scene);
  if (!outcome.georef) {
    if (!outcome.why_not.empty()) {
      input.context.progress->Warn(fmt::format("{}: its points do not hold the model: {}",
                                               input.control.file, outcome.why_not));
    }
    return outcome;
  }
  georeference.georef = *outcome.georef;
  if (outcome.records) georeference.records = outcome.records;
  georeference.sigmas = SigmasOf(input.mapper, outcome.records.has_value(), scene);
  // Residuals are of what was recorded, but for the shift.
  for (size_t i = 0; i < outcome.placed_records.size(); ++i) {
    scene.photos[i].prior = outcome.placed_records[i].position;
  }
  georeference.residuals = MeasurePriors(scene, georeference.prior_outliers);
  return outcome;
}

// Photos that are not in the scene, and why.
std::map<int, std::string> Unregistered(const MapperOptions& mapper,
                                        const std::vector<VerifiedPair>& pairs, const Scene& scene,
                                        const SceneParts& parts,
                                        const std::map<int, std::string>& taken) {
  std::map<int, std::string> why = WhyApart(parts);
  why.insert(taken.begin(), taken.end());
  why.merge(ExplainUnregistered(mapper, pairs, scene));
  std::erase_if(why, [&](const auto& photo) { return scene.photos[photo.first].pose.has_value(); });
  return why;
}

}  // namespace

void RunCalib(const CalibOptions& options, StageContext& context) {
  const Photos photos = ReadPhotos(context);
  const GroundControl control = ReadGroundControl(options, photos.captures, photos.usable, context);
  const Guidance guidance = GuideByPlan(options, photos.captures, photos.usable, context);
  const PhotoSet set{photos.captures, photos.usable, guidance};
  const DetectedFeatures features = DetectAll(options, set, context);
  MatchedPairs matched = MatchAll(options, set, features, context);
  std::vector<VerifiedPair>& pairs = matched.verified;

  Scene scene = MakeScene(options, photos, features);
  GuessFocalLengths(photos, pairs, context, scene);
  QuestionPairs(guidance, scene, context, pairs);
  AddTracks(pairs, scene);
  MapperOptions mapper;
  mapper.min_angle_rad = options.min_angle_deg * kRadians;
  mapper.refine_principal_point = options.refine_principal_point;
  mapper.threads = context.threads;
  mapper.adjust_threads = options.fast_adjustment ? context.threads : 1;

  for (VerifiedPair& pair : pairs) ClassifyMotion(scene, mapper.max_error_sigmas, pair);
  Reconstructed placed = ReadRecordsOf(options, photos, guidance, context, scene);
  PlacePhotos(mapper, pairs, context, placed, scene);
  std::vector<std::string> findings = DescribePanoramas(scene, pairs, photos.usable);
  if (NumRegistered(scene) < 2) ThrowNothingRegistered(pairs, findings);
  if (!placed.finding.empty()) findings.push_back(placed.finding);
  for (const std::string& finding : findings) context.progress->Warn(finding);
  GeoreferenceResult georeference = Georeference(placed, mapper, photos, context, scene);
  const Eigen::Vector3d surveyed_sigma_m = SurveyedSigma(options);
  const ControlOutcome held = UseGroundControl(
      {control, surveyed_sigma_m, mapper, placed.records, georeference.georef, context},
      georeference, scene);
  const std::vector<PoseRecord>& records =
      held.placed_records.empty() ? placed.records : held.placed_records;
  const RecordErrors* errors = georeference.records ? &*georeference.records : nullptr;
  const SceneParts parts =
      TakeApart({mapper, pairs, photos.usable, placed.plan, records, errors, context},
                georeference.sigmas, scene);
  georeference.residuals = MeasurePriors(scene, georeference.prior_outliers);
  const std::map<int, std::string> unregistered =
      Unregistered(mapper, pairs, scene, parts, georeference.taken);
  for (const auto& [photo, why] : unregistered) {
    context.progress->Warn(fmt::format("{}: not placed: {}", scene.photos[photo].name, why));
  }
  const SummaryInput summary{photos.captures, photos.capture_of_photo, scene,
                             unregistered,    georeference.residuals,  georeference.prior_outliers,
                             errors,          georeference.sigmas,     &parts};
  Calibration calibration = Summarize(summary);
  calibration.findings.insert(calibration.findings.begin(), findings.begin(), findings.end());
  if (errors != nullptr) {
    std::ranges::move(SummarizeRecordOnly(summary, records, *errors),
                      std::back_inserter(calibration.photos));
  }
  SummarizeControl(control, held, surveyed_sigma_m, calibration);
  WriteResults(summary, georeference.georef, std::move(calibration), context);
  const auto keypoints = CountKeypoints(features, PlacesOfAll(options, set, features));
  WriteFile(context.out / "photos.csv", PhotosCsv(summary, {keypoints, matched.tried, pairs}));
}

}  // namespace stucco
