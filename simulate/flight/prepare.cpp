// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/flight/daylight.h"
#include "simulate/flight/exposure.h"
#include "simulate/flight/lens.h"
#include "simulate/random.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco::simulate {
namespace {

constexpr uint64_t kSensorSeed = 0x5E50;
constexpr uint64_t kMotionSeed = 0x307E;
constexpr uint64_t kBiasSeed = 0x61A5;
constexpr uint64_t kReceiverSeed = 0x6950;
constexpr uint64_t kBarometerSeed = 0xBA40;

uint64_t PhotoSeed(const FlightOptions& options, uint64_t purpose, size_t photo) {
  return SeedOf(SeedOf(static_cast<uint64_t>(options.seed), purpose), photo);
}

FlownPhoto PhotoOf(const PreparedFlight& prepared, const Shot& shot, const Camera& lens,
                   const FlightOptions& options) {
  FlownPhoto photo;
  photo.held_out = shot.view < 0;
  photo.view = photo.held_out ? "" : prepared.plan.views[shot.view].id;
  photo.path = photo.held_out
                   ? "held_out/" + PhotoName(shot, fmt::format("heldout{:04d}", shot.number))
                   : PhotoName(shot, photo.view);
  photo.camera = lens;
  photo.cam_from_world = CameraPose(prepared.placed, shot.position_m, shot.angles);
  photo.light = DaylightAt(options, prepared.plan.origin.latitude_deg, shot.day, shot.hour);
  photo.time_s = shot.time_s;
  photo.lost = shot.lost;
  if (shot.duplicate_of >= 0) {
    photo.duplicate_of = prepared.flight.photos[shot.duplicate_of].path;
  }
  return photo;
}

void Append(const Shot& shot, const Camera& lens, const FlightOptions& options,
            PreparedFlight& prepared) {
  prepared.flight.photos.push_back(PhotoOf(prepared, shot, lens, options));
  prepared.shots.push_back(shot);
}

struct BlockedView {
  std::string id;
  std::string why;
  bool is_planned = true;  // the plan is to blame; not for trees, which no map has
};

// Where no camera can be, no photo is taken.
std::vector<BlockedView> LoseBlockedPhotos(const SceneShape& scene, PreparedFlight& prepared) {
  std::vector<BlockedView> blocked;
  for (size_t i = 0; i < prepared.shots.size(); ++i) {
    FlownPhoto& photo = prepared.flight.photos[i];
    const Eigen::Vector3d place = photo.cam_from_world.Center();
    const auto why = WhyBlocked(scene, place);
    const auto tree = why ? std::nullopt : TreeInTheWay(scene, place);
    if (!why && !tree) continue;
    photo.lost = true;
    prepared.shots[i].lost = true;
    if (prepared.shots[i].duplicate_of >= 0) continue;
    blocked.push_back({photo.view, why ? *why : "stands in " + *tree, why.has_value()});
  }
  return blocked;
}

void RequireFewBlocked(const std::vector<BlockedView>& blocked, PreparedFlight& prepared) {
  const size_t views = prepared.plan.views.size();
  const auto misplanned =
      static_cast<size_t>(std::ranges::count_if(blocked, &BlockedView::is_planned));
  constexpr size_t kOneIn = 20;
  const bool is_all = blocked.size() == views;
  if (is_all || (misplanned > 1 && misplanned * kOneIn > views)) {
    const BlockedView& first =
        is_all ? blocked[0] : *std::ranges::find_if(blocked, &BlockedView::is_planned);
    throw Error(ErrorKind::kBadInput,
                fmt::format("the cameras of {} of {} views cannot be where the plan wants them: "
                            "view {} {}",
                            is_all ? views : misplanned, views, first.id, first.why),
                "plan with a map of this scene; for a model from elsewhere, --unit and --up say "
                "what its numbers mean");
  }
  for (const BlockedView& view : blocked) {
    prepared.notes.push_back(fmt::format("view {} {}: no photo", view.id, view.why));
  }
}

// Of plans for other places only walls tell; a model may have no ground to judge them by.
void NoteWallsUnknown(PreparedFlight& prepared) {
  constexpr size_t kOneIn = 5;
  const size_t walls = prepared.plan.facades.size();
  const auto judged = static_cast<size_t>(prepared.placed.walls_judged);
  if (judged * kOneIn >= walls) return;
  prepared.notes.push_back(fmt::format(
      "only {} of the plan's {} walls have ground before them and a roof behind them in "
      "the scene: whether the plan is for this scene cannot be told",
      judged, walls));
}

// A camera that touches a wall is no use either.
bool HasClearView(const SceneShape& scene, const Pose& pose) {
  constexpr double kClear_m = 2;
  const Eigen::Vector3d ahead = pose.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  const auto hit = scene.cast(pose.Center(), ahead);
  return !hit || hit->distance > kClear_m;
}

void AddHeldOut(const SceneShape& scene, const Camera& lens, const FlightOptions& options,
                PreparedFlight& prepared) {
  const std::vector<Shot> shots = prepared.shots;
  constexpr int kAttempts = 20;
  for (int number = 1; number <= options.held_out; ++number) {
    int attempt = 0;
    for (; attempt < kAttempts; ++attempt) {
      const Shot shot = HeldOutShot(prepared.plan, shots, options, number, attempt);
      const Pose pose = CameraPose(prepared.placed, shot.position_m, shot.angles);
      if (WhyBlocked(scene, pose.Center()) || TreeInTheWay(scene, pose.Center()) ||
          !HasClearView(scene, pose)) {
        continue;
      }
      Append(shot, lens, options, prepared);
      break;
    }
    if (attempt == kAttempts) {
      prepared.notes.push_back(fmt::format("held-out photo {}: no free place for it", number));
    }
  }
}

// Heights from satellites are about one and a half times as uncertain as places.
constexpr double kUpOverHorizontal = 1.5;
const Eigen::Vector3d kRtkSigma_m(0.011, 0.011, 0.02);

// Barometers are good to a decimetre from photo to photo, and drift with the weather and their own
// temperature.
constexpr double kBarometer_m = 0.1;
constexpr double kDrift_m = 0.5;
constexpr double kDriftPeriod_s = 1800;

double BarometerDrift_m(const Shot& shot, const FlightOptions& options) {
  Random of_flight(
      SeedOf(SeedOf(static_cast<uint64_t>(options.seed), kBarometerSeed), shot.flight));
  const double height_m = kDrift_m * of_flight.Normal();
  const double phase = 2 * std::numbers::pi * of_flight.Uniform(0, 1);
  return height_m * std::sin(2 * std::numbers::pi * shot.time_s / kDriftPeriod_s + phase);
}

}  // namespace

PreparedFlight PrepareFlight(const Plan& plan, const SceneInfo& info, const SceneShape& scene,
                             const FlightOptions& options) {
  PreparedFlight prepared;
  prepared.plan = plan;
  prepared.placed = PlacePlan(plan, info, scene);
  NoteWallsUnknown(prepared);
  prepared.flight.seed = static_cast<uint64_t>(options.seed);
  prepared.flight.georef = prepared.placed.world;
  prepared.flight.faults = {.motion_blur_px = options.motion_blur_px,
                            .focus_blur_px = options.focus_blur_px,
                            .noise = options.noise,
                            .sharpening = options.sharpening,
                            .jpeg_quality = options.jpeg_quality};
  const Camera lens = MakeLens(plan.camera, options);
  for (const Shot& shot : ScheduleShots(plan, options)) Append(shot, lens, options, prepared);
  RequireFewBlocked(LoseBlockedPhotos(scene, prepared), prepared);
  AddHeldOut(scene, lens, options, prepared);
  return prepared;
}

void MeterFlight(const Photographer& photographer, const FlightOptions& options, int threads,
                 PreparedFlight& prepared) {
  constexpr int kWidth_px = 64;
  std::vector<FlownPhoto*> photos;
  for (FlownPhoto& photo : prepared.flight.photos) {
    if (!photo.lost) photos.push_back(&photo);  // a camera in a wall would meter darkness
  }
  std::vector<double> metered(photos.size());
  ParallelFor(photos.size(), threads, [&](size_t i) {
    const Camera& lens = photos[i]->camera;
    const int width_px = std::min(kWidth_px, lens.width_px);
    const int height_px = std::max(1, lens.height_px * width_px / lens.width_px);
    metered[i] = MeteredExposure(photographer.photograph(
        Resized(lens, width_px, height_px), photos[i]->cam_from_world, photos[i]->light, 1));
  });
  const std::vector<double> exposures = Exposures(metered, options);
  for (size_t i = 0; i < photos.size(); ++i) {
    photos[i]->exposure = exposures[i];
    photos[i]->white_balance =
        WhiteBalance(NeutralGains(photos[i]->light), photos[i]->time_s, options);
  }
}

SensorEffects EffectsOf(const PreparedFlight& prepared, size_t photo,
                        const FlightOptions& options) {
  const FlownPhoto& flown = prepared.flight.photos[photo];
  SensorEffects effects;
  effects.exposure = flown.exposure;
  effects.white_balance = flown.white_balance;
  effects.vignetting = options.vignetting;
  effects.focus_blur_px = options.focus_blur_px;
  effects.noise = options.noise;
  effects.sharpening = options.sharpening;
  effects.seed = PhotoSeed(options, kSensorSeed, photo);
  // Two normal components of which the length's mean is the typical motion; turns about the axis
  // move the picture's border half as much.
  Random random(PhotoSeed(options, kMotionSeed, photo));
  const double sigma_px = options.motion_blur_px / std::sqrt(std::numbers::pi / 2);
  const double x = sigma_px * random.Normal() / flown.camera.FocalX();
  const double y = sigma_px * random.Normal() / flown.camera.FocalY();
  const double z = sigma_px * random.Normal() / flown.camera.width_px;
  effects.turn_rad = {x, y, z};
  return effects;
}

PhotoMetadata MetadataOf(const PreparedFlight& prepared, size_t photo,
                         const FlightOptions& options) {
  const FlownPhoto& flown = prepared.flight.photos[photo];
  const Shot& shot = prepared.shots[photo];
  Random of_flight(SeedOf(static_cast<uint64_t>(options.seed), kBiasSeed));
  Random of_photo(PhotoSeed(options, kReceiverSeed, photo));
  const Eigen::Vector3d bias = options.gps_bias_m * of_flight.NormalVector().normalized();
  const Eigen::Vector3d sigma =
      options.rtk ? kRtkSigma_m : Eigen::Vector3d(1, 1, kUpOverHorizontal) * options.gps_sigma_m;
  Eigen::Vector3d error = sigma.cwiseProduct(of_photo.NormalVector());
  if (!options.rtk) error += bias;
  const Eigen::Vector3d geodetic =
      GeodeticFromEnu(prepared.placed.world, flown.cam_from_world.Center() + error);
  PhotoMetadata metadata;
  metadata.model = ExifModel(prepared.plan.camera.name);
  metadata.exif_time = ExifTime(shot);
  metadata.milliseconds = Milliseconds(shot);
  metadata.latitude_deg = geodetic[0];
  metadata.longitude_deg = geodetic[1];
  metadata.height_m = geodetic[2];
  if (!options.rtk) metadata.height_m -= options.geoid_m;
  metadata.above_takeoff_m = shot.position_m.z() - prepared.plan.HomeOf(shot.flight).z() +
                             BarometerDrift_m(shot, options) + kBarometer_m * of_photo.Normal();
  metadata.gimbal = shot.angles;
  metadata.gimbal.yaw_deg += options.gimbal_noise_deg * of_photo.Normal();
  metadata.gimbal.pitch_deg += options.gimbal_noise_deg * of_photo.Normal();
  metadata.gimbal.roll_deg = 0;  // as gimbals report it, whatever it is
  metadata.rtk = options.rtk;
  metadata.rtk_sigma_m = kRtkSigma_m;
  metadata.shutter = ShutterFor(flown.exposure);
  metadata.focal_mm = prepared.plan.camera.focal_m * 1000;
  metadata.focal_35mm_mm = FocalOn35mm_mm(prepared.plan.camera);
  metadata.width_px = flown.camera.width_px;
  metadata.height_px = flown.camera.height_px;
  const uint64_t low = of_photo.Next();
  metadata.uuid = fmt::format("{:016x}{:016x}", SeedOf(of_photo.Next(), 1), low);
  return metadata;
}

}  // namespace stucco::simulate
