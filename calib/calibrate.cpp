// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/calibrate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "calib/adjust/adjust.h"
#include "calib/adjust/covariance.h"
#include "calib/control/ground_control.h"
#include "calib/control/hold_by_control.h"
#include "calib/control/summarize_control.h"
#include "calib/mapping/mapper.h"
#include "calib/mapping/wrong_poses.h"
#include "calib/matching/detect_photos.h"
#include "calib/matching/match_photos.h"
#include "calib/matching/repeating_walls.h"
#include "calib/parts/parts.h"
#include "calib/parts/take_apart.h"
#include "calib/parts/untold_bays.h"
#include "calib/parts/weak_pose.h"
#include "calib/place_photos.h"
#include "calib/records/align_to_map.h"
#include "calib/records/georeference.h"
#include "calib/records/records.h"
#include "calib/results/photos_csv.h"
#include "calib/results/record_findings.h"
#include "calib/results/summarize.h"
#include "calib/results/summarize_photos.h"
#include "calib/results/write_results.h"
#include "calib/two_view/panorama.h"
#include "survey/calibration.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/one_blas_thread.h"
#include "survey/one_opencv_thread.h"
#include "survey/plan_of_survey.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr char kAmbiguous[] =
    "ambiguous: the walls that it shows repeat themselves, and its recorded position does not tell "
    "one bay from the next; record positions by RTK, or show a corner, the ground or a roof too";

UsablePhotos ReadPhotos(const std::optional<Plan>& plan, const StageContext& context) {
  UsablePhotos photos;
  photos.captures = ReadCaptures(context.survey / kCapturesFile);
  photos.heights = SteadyHeights(plan ? &*plan : nullptr, photos.captures);
  if (photos.heights.num_photos > 0) {
    context.progress->Note(
        fmt::format("{} photos are as high as their barometers say: heights by satellites scatter "
                    "by {:.1f} m about these",
                    photos.heights.num_photos, photos.heights.scatter_m));
  }
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

struct GeoreferenceResult {
  Georef georef;
  std::vector<int> prior_outliers;
  std::vector<int> off_together;  // photos that are off their records as a group
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
// that agree. Requires a scene in the frame of the records, of which each photo has one.
GeoreferenceResult RefineWithRecords(const MapperOptions& mapper,
                                     const std::vector<PoseRecord>& records,
                                     const StageContext& context, Scene& scene) {
  assert(records.size() == scene.photos.size());
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
    const PoseRecord& record = records[photo];
    result.taken[photo] = fmt::format(
        "its matches give a pose that contradicts its recorded {} by more than {} good to; "
        "something that repeats itself looks like that, or a wrong record",
        !record.gimbal     ? "position"
        : !record.position ? "angles"
                           : "position and angles",
        record.gimbal ? "these are" : "it is");
  }
  FilterScene(mapper, scene);
  result.off_together = OffTogether(scene);
  result.sigmas = SigmasOf(mapper, true, scene);
  for (size_t i = 0; i < records.size(); ++i) scene.photos[i].prior = records[i].position;
  return result;
}

GeoreferenceResult WithoutPositions(const UsablePhotos& photos, Scene& scene) {
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
                                                 const MapperOptions& mapper,
                                                 const UsablePhotos& photos,
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
                                const UsablePhotos& photos, const StageContext& context,
                                Scene& scene) {
  std::optional<GeoreferenceResult> without;
  if (!from.is_in_frame) without = BringIntoFrame(from, mapper, photos, context, scene);
  assert(without || from.frame);
  GeoreferenceResult result =
      without ? std::move(*without) : RefineWithRecords(mapper, from.records, context, scene);
  if (without) {
    result.sigmas = SigmasOf(mapper, false, scene);
  } else {
    result.georef = *from.frame;
    if (const auto sigma = UpSigma_rad(*result.records)) {
      result.georef.up_sigma_deg = *sigma / kRadians;
    }
  }
  for (const int photo : result.prior_outliers) {
    context.progress->Warn(
        fmt::format("{}: its recorded position contradicts the other photos and hardly counts",
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

// Takes poses that may be bays off, of photos that show hardly anything but walls that repeat
// themselves: those that little holds, and those of which neither matches nor records tell the bay.
// `recorded` are positions by records, corrected. Returns the photos.
std::vector<int> TakeBaysInDoubt(const OnRepeatingWalls& repeating,
                                 const std::vector<PlannedFacade>& facades,
                                 const std::vector<std::optional<PositionPrior>>& recorded,
                                 const std::vector<PoseSigma>& sigmas, Scene& scene) {
  std::vector<int> taken;
  if (repeating.period_m.empty()) return taken;
  while (true) {
    std::vector<int> photos = WeakPoses(scene, sigmas);
    std::erase_if(photos, [&](int photo) { return !repeating.IsMostOf(photo); });
    if (photos.empty()) photos = UntoldBays(repeating, facades, recorded, scene);
    if (photos.empty()) return taken;
    TakePoses(photos, scene);
    taken.insert(taken.end(), photos.begin(), photos.end());
  }
}

std::vector<std::optional<PositionPrior>> CorrectedPositions(const std::vector<PoseRecord>& records,
                                                             const RecordErrors* errors) {
  std::vector<std::optional<PositionPrior>> positions(records.size());
  for (size_t i = 0; errors != nullptr && i < records.size(); ++i) {
    positions[i] = CorrectedPosition(records[i], *errors);
  }
  return positions;
}

// Those of `why` that match others and could stand before any of several bays, ascending.
std::vector<int> NoteUnregistered(const OnRepeatingWalls& repeating,
                                  const std::vector<VerifiedPair>& pairs, const Scene& scene,
                                  const StageContext& context, std::map<int, std::string>& why) {
  std::vector<bool> matches(scene.photos.size(), false);
  for (const VerifiedPair& pair : pairs) {
    matches[pair.pair.first] = matches[pair.pair.second] = true;
  }
  std::vector<int> ambiguous;
  for (auto& [photo, reason] : why) {
    if (matches[photo] && repeating.IsMostOf(photo)) {
      ambiguous.push_back(photo);
      reason = kAmbiguous;
    }
    context.progress->Warn(fmt::format("{}: not placed: {}", scene.photos[photo].name, reason));
  }
  return ambiguous;
}

// Where the walls of the plan's map show the scene. Nothing where no positions place it, or where
// these are the plan's.
std::optional<MapAlignment> FindOnMap(const Guidance& guidance, const std::optional<Plan>& plan,
                                      const Georef& georef, const Scene& scene) {
  if (!plan || !guidance.views || georef.frame != "enu" || georef.source == "plan") return {};
  std::vector<Eigen::Vector3d> points;
  for (const SceneTrack& track : scene.tracks) {
    if (track.position) points.push_back(*track.position);
  }
  return AlignToWalls(points, MapInScene(*plan, georef, guidance.views->poses, scene));
}

CalibratedMap Summary(const MapAlignment& alignment, bool moved) {
  CalibratedMap map;
  map.shift_m = {alignment.shift_m.x(), alignment.shift_m.y()};
  map.turn_deg = alignment.turn_rad / kRadians;
  map.sigma_m = alignment.sigma_m;
  map.walls = alignment.walls;
  map.moved = moved;
  return map;
}

// Moves what lies in the frame of the positions onto the map.
void MoveAll(const MapAlignment& alignment, std::vector<PoseRecord>& records, SceneParts& parts,
             Scene& scene) {
  MoveToMap(alignment, records, scene);
  for (ScenePart& part : parts.others) {
    if (part.place) Transform(alignment.map_from_scene, part.scene);
  }
}

struct MapUse {
  const Guidance& guidance;
  const std::optional<Plan>& plan;
  bool move = false;  // onto the map, where it shows the scene
  const StageContext& context;
};

// Where the map shows the scene; nothing where it does not.
std::optional<CalibratedMap> PlaceOnMap(const MapUse& use, Georef& georef,
                                        std::vector<PoseRecord>& records, SceneParts& parts,
                                        Scene& scene) {
  const auto found = FindOnMap(use.guidance, use.plan, georef, scene);
  if (!found) {
    if (use.move) {
      use.context.progress->Warn(
          "calib.georef is map, but the walls of the map are not found in the model: it stays "
          "where positions put it");
    }
    return std::nullopt;
  }
  georef.on_map = use.move;
  if (use.move) MoveAll(*found, records, parts, scene);
  return Summary(*found, use.move);
}

}  // namespace

void RunCalib(const CalibOptions& options, StageContext& context) {
  const OneOpenCvThread photos_run_side_by_side;
  UseOneBlasThread();
  const std::optional<Plan> plan = PlanOfSurvey(context);
  const UsablePhotos photos = ReadPhotos(plan, context);
  const GroundControl control = ReadGroundControl(options, photos.captures, photos.usable, context);
  const Guidance guidance = GuideByPlan(options, photos.captures, photos.usable, context);
  const PhotoSet set{photos.captures, photos.usable, guidance};
  DetectedFeatures features = DetectAll(options, set, context);
  OnRepeatingWalls repeating = FindOnRepeatingWalls({options, set, context}, features);
  MatchedPairs matched = MatchAll(options, set, features, repeating, context);
  DropDescriptors(features);  // what is matched again reads its own

  MapperOptions mapper;
  mapper.min_angle_rad = options.min_angle_deg * kRadians;
  mapper.refine_principal_point = options.refine_principal_point;
  mapper.threads = context.threads;
  mapper.adjust_threads = options.fast_adjustment ? context.threads : 1;
  Scene scene;
  Reconstructed placed = PlacePhotos({options, mapper, photos, guidance, features, context},
                                     repeating, matched, scene);
  const std::vector<VerifiedPair>& pairs = matched.verified;
  std::vector<std::string> findings = DescribePanoramas(scene, pairs, photos.usable);
  if (NumRegistered(scene) < 2) ThrowNothingRegistered(pairs, findings);
  if (!placed.finding.empty()) findings.push_back(placed.finding);
  for (const std::string& finding : findings) context.progress->Warn(finding);
  GeoreferenceResult georeference = Georeference(placed, mapper, photos, context, scene);
  const Eigen::Vector3d surveyed_sigma_m = SurveyedSigma(options);
  const ControlOutcome held = UseGroundControl(
      {control, surveyed_sigma_m, mapper, placed.records, georeference.georef, context},
      georeference, scene);
  std::vector<PoseRecord> records =
      held.placed_records.empty() ? placed.records : held.placed_records;
  const RecordErrors* errors = georeference.records ? &*georeference.records : nullptr;
  SceneParts parts = TakeApart({mapper, pairs, photos.usable, plan, records, errors, context},
                               georeference.sigmas, scene);
  for (const int photo :
       TakeBaysInDoubt(repeating, guidance.facades, CorrectedPositions(records, errors),
                       georeference.sigmas.poses, scene)) {
    parts.part_of_photo[photo] = -1;
  }
  georeference.residuals = MeasurePriors(scene, georeference.prior_outliers);
  const std::optional<CalibratedMap> on_map =
      PlaceOnMap({guidance, plan, options.georef == "map" && !held.georef, context},
                 georeference.georef, records, parts, scene);
  std::map<int, std::string> unregistered =
      Unregistered(mapper, pairs, scene, parts, georeference.taken);
  const std::vector<int> ambiguous =
      NoteUnregistered(repeating, pairs, scene, context, unregistered);
  const SummaryInput summary{.captures = photos.captures,
                             .capture_of_photo = photos.capture_of_photo,
                             .scene = scene,
                             .unregistered = unregistered,
                             .priors = georeference.residuals,
                             .prior_outliers = georeference.prior_outliers,
                             .records = errors,
                             .sigmas = georeference.sigmas,
                             .parts = &parts,
                             .off_together = georeference.off_together,
                             .ambiguous = ambiguous};
  Calibration calibration = Summarize(summary);
  calibration.findings.insert(calibration.findings.begin(), findings.begin(), findings.end());
  calibration.map = on_map;
  if (on_map && !held.georef) {
    std::ranges::move(MapFindings(*on_map), std::back_inserter(calibration.findings));
  }
  if (errors != nullptr) {
    calibration.records.barometric_photos = photos.heights.num_photos;
    calibration.records.satellite_heights_sigma_m = photos.heights.scatter_m;
    std::ranges::move(SummarizeRecordOnly(summary, records, *errors),
                      std::back_inserter(calibration.photos));
  }
  SummarizeControl(control, held, surveyed_sigma_m, calibration);
  WriteResults(summary, georeference.georef, std::move(calibration), context);
  const auto keypoints = CountKeypoints(features, PlacesOfAll(options, set, features));
  WriteFile(context.out / "photos.csv", PhotosCsv(summary, {keypoints, matched.tried, pairs}));
}

}  // namespace stucco
