// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/localise/place_in_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "calib/adjust/adjust.h"
#include "calib/features/chance.h"
#include "calib/scene/resect.h"

namespace stucco {
namespace {

// Of reprojections, in standard deviations of the keypoints; twice that for a first pose. As when a
// survey grows (MapperOptions).
constexpr double kMaxError_sigmas = 4;
constexpr int kFewestInliers = 15;
// Wrong poses that photos without anything in common with the model may get, on average.
const double kLogFalseAlarms = std::log(1e-3);
// P3P has up to four solutions for three points.
constexpr int kSampleSize = 3;
constexpr int kModelsPerSample = 4;
// Standard deviation of a pose in the picture, in those of a keypoint: beyond, edges would be
// painted beside where they are.
constexpr double kMostSigma = 1;
// What keypoints of a photo share shows in no residual: by simulated flights (benchmarks.md).
constexpr double kSharedErrors = 1.4;
// Where a focal length is a guess, others between half and twice the guess are tried, so near to
// each other that the least squares find the rest.
constexpr double kFocalStep = 1.15;
constexpr int kFocalSteps = 5;  // up and down
constexpr int kRounds = 3;      // of choosing inliers and adjusting

// Bodies of one model of camera differ in focal length by a per cent or two.
constexpr double kOtherBody = 0.02;

struct Sighting {
  SceneElement* element;
  const Eigen::Vector3d* point;
};

std::vector<Sighting> SightingsOf(Scene& scene, int photo) {
  std::vector<Sighting> sightings;
  for (const int track : scene.tracks_of_photo[photo]) {
    if (track < 0 || !scene.tracks[track].position) continue;
    for (SceneElement& element : scene.tracks[track].elements) {
      if (element.photo == photo) sightings.push_back({&element, &*scene.tracks[track].position});
    }
  }
  return sightings;
}

double LimitPx(const Scene& scene, int photo, double times) {
  return times * kMaxError_sigmas * scene.photos[photo].keypoint_sigma_px;
}

// Chooses what takes part by the photo's pose; returns how many do.
int ChooseInliers(double limit_px, int photo, Scene& scene) {
  int count = 0;
  for (const Sighting& sighting : SightingsOf(scene, photo)) {
    sighting.element->used =
        ReprojectionError(scene, *sighting.element, *sighting.point) < limit_px;
    count += sighting.element->used;
  }
  return count;
}

// The chance that a keypoint agrees with a point that it does not show: as those of the photo do
// when they are joined with each other's points.
double ChanceOfAgreeing(double limit_px, int photo, Scene& scene) {
  const std::vector<Sighting> sightings = SightingsOf(scene, photo);
  const Camera& camera = scene.CameraOf(photo);
  const double anywhere = std::numbers::pi * limit_px * limit_px /
                          (static_cast<double>(camera.width_px) * camera.height_px);
  size_t agreeing = 0;
  size_t tried = 0;
  constexpr size_t kShifts = 8;
  for (size_t k = 1; k <= kShifts && k < sightings.size(); ++k) {
    const size_t shift = std::max(k, sightings.size() * k / (kShifts + 1));
    for (size_t i = 0; i < sightings.size(); ++i) {
      const Sighting& other = sightings[(i + shift) % sightings.size()];
      agreeing += ReprojectionError(scene, *sightings[i].element, *other.point) < limit_px;
      ++tried;
    }
  }
  const double among = tried > 0 ? static_cast<double>(agreeing) / static_cast<double>(tried) : 1;
  return std::min(1.0, std::max(anywhere, among));
}

// Poses of one camera's photos from their points; returns how many points agree with them.
int ResectAll(const std::vector<int>& photos, Scene& scene) {
  int inliers = 0;
  for (const int photo : photos) {
    const auto found = Resect(scene, photo, LimitPx(scene, photo, 2), kFewestInliers);
    scene.photos[photo].pose = found ? std::optional(found->cam_from_world) : std::nullopt;
    if (found) inliers += found->num_inliers;
  }
  return inliers;
}

void ScaleFocal(double factor, SceneCamera& camera) {
  for (Camera* lens : {&camera.intrinsics, &camera.prior}) {
    lens->params[0] *= factor;
    lens->params[1] *= factor;
  }
}

std::vector<int> PhotosOf(int camera, const Scene& scene) {
  std::vector<int> photos;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (scene.photos[i].camera == camera) photos.push_back(i);
  }
  return photos;
}

// First poses of a camera's photos; a focal length that is a guess becomes the one with which most
// points agree.
void BeginWithCamera(int camera, Scene& scene) {
  const std::vector<int> photos = PhotosOf(camera, scene);
  if (scene.cameras[camera].focal_sigma_ratio < kGuessedFocal) {
    ResectAll(photos, scene);
    return;
  }
  const SceneCamera guess = scene.cameras[camera];
  SceneCamera best = guess;
  int most = 0;
  for (int step = -kFocalSteps; step <= kFocalSteps; ++step) {
    scene.cameras[camera] = guess;
    ScaleFocal(std::pow(kFocalStep, step), scene.cameras[camera]);
    const int inliers = ResectAll(photos, scene);
    if (inliers <= most) continue;
    most = inliers;
    best = scene.cameras[camera];
  }
  scene.cameras[camera] = best;
  ResectAll(photos, scene);
}

// Adjusts all poses at once, with their cameras, by what agrees with them.
void Refine(Scene& scene) {
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
      if (scene.photos[i].pose) ChooseInliers(LimitPx(scene, i, round == 0 ? 2 : 1), i, scene);
    }
    if (NumRegistered(scene) == 0) return;
    AdjustOptions options;
    options.hold_points = true;
    options.refine = RefineIntrinsics::kDistortion;
    Adjust(options, scene);
  }
}

// What all that a camera's placed photos show says against its lens: twice the negative logarithm
// of the likelihood under the loss that adjustment uses (Cauchy); and of how many points.
struct Misfit {
  double cost = 0;
  size_t points = 0;
};

Misfit MisfitOf(int camera, Scene& scene) {
  const double scale = AdjustOptions().loss_scale;
  Misfit misfit;
  for (const int photo : PhotosOf(camera, scene)) {
    if (!scene.photos[photo].pose) continue;
    for (const Sighting& sighting : SightingsOf(scene, photo)) {
      const double sigmas = ReprojectionError(scene, *sighting.element, *sighting.point) /
                            scene.photos[photo].KeypointSigma(sighting.element->keypoint);
      misfit.cost += scale * scale * std::log1p(sigmas * sigmas / (scale * scale));
      ++misfit.points;
    }
  }
  return misfit;
}

// A lens that is held because the model knows a camera of its name may be that of another body, or
// have changed since: it is let go where that explains the photos so much better that it is worth
// its parameters (Schwarz, "Estimating the dimension of a model", 1978), and its photos are placed
// anew. Whether it was.
bool LetLensGo(int camera, Scene& scene) {
  if (scene.cameras[camera].focal_sigma_ratio > 0) return false;
  const Misfit held = MisfitOf(camera, scene);
  if (held.points == 0) return false;
  Scene trial = scene;
  trial.cameras[camera].focal_sigma_ratio = kOtherBody;
  Refine(trial);
  const double gained = held.cost - MisfitOf(camera, trial).cost;
  const auto parameters = static_cast<double>(trial.cameras[camera].intrinsics.params.size());
  if (!(gained > parameters * std::log(2.0 * static_cast<double>(held.points)))) return false;
  scene.cameras[camera] = trial.cameras[camera];
  ResectAll(PhotosOf(camera, scene), scene);
  return true;
}

std::string WhyTooFew(const PlacedPhoto& placed) {
  if (placed.num_points < kFewestInliers) {
    return fmt::format(
        "only {} of its details are points of the survey, {} are needed: it shows "
        "something else, or from where no photo of the survey saw it",
        placed.num_points, kFewestInliers);
  }
  return fmt::format(
      "of {} details that look like points of the survey {} agree on a place to see "
      "them from, no more than chance lets",
      placed.num_points, placed.num_inliers);
}

bool IsAboveChance(double limit_px, int photo, const PlacedPhoto& placed, Scene& scene) {
  if (placed.num_inliers < kFewestInliers) return false;
  const ChanceFinding finding{placed.num_points, placed.num_inliers, kSampleSize, kModelsPerSample,
                              ChanceOfAgreeing(limit_px, photo, scene)};
  return LogFalseAlarms(finding) < kLogFalseAlarms;
}

// Takes the poses that no more points agree with, within `times` the usual error, than by chance.
void DropByChance(double times, std::vector<PlacedPhoto>& placed, Scene& scene) {
  for (int photo = 0; photo < static_cast<int>(placed.size()); ++photo) {
    PlacedPhoto& one = placed[photo];
    if (!one.why.empty()) continue;
    const double limit_px = LimitPx(scene, photo, times);
    one.num_points = NumVisiblePoints(scene, photo);
    if (scene.photos[photo].pose) {
      one.num_inliers = ChooseInliers(limit_px, photo, scene);
      if (IsAboveChance(limit_px, photo, one, scene)) continue;
    }
    one.why = WhyTooFew(one);
    for (const Sighting& sighting : SightingsOf(scene, photo)) sighting.element->used = false;
    scene.photos[photo].pose.reset();
  }
}

void DropUncertain(const std::vector<PoseSigma>& sigmas, std::vector<PlacedPhoto>& placed,
                   Scene& scene) {
  for (size_t i = 0; i < placed.size(); ++i) {
    if (!scene.photos[i].pose) continue;
    const double px = kSharedErrors * sigmas[i].picture_px;
    placed[i].sigma = {kSharedErrors * sigmas[i].position, kSharedErrors * sigmas[i].rotation_rad,
                       px};
    if (sigmas[i].picture_px >= 0 && px <= kMostSigma * scene.photos[i].keypoint_sigma_px) continue;
    placed[i].why = sigmas[i].picture_px < 0
                        ? "how surely it is placed could not be computed"
                        : fmt::format(
                              "its place is good to {:.1f} pixels only, from {} points: "
                              "edges would be painted beside where they are",
                              px, placed[i].num_inliers);
    scene.photos[i].pose.reset();
  }
}

}  // namespace

std::vector<PlacedPhoto> PlaceInModel(Scene& scene) {
  assert(scene.tracks_of_photo.size() == scene.photos.size());
  assert(NumRegistered(scene) == 0);
  for (int camera = 0; camera < static_cast<int>(scene.cameras.size()); ++camera) {
    BeginWithCamera(camera, scene);
  }
  const auto place = [&scene] {
    std::vector<PlacedPhoto> placed(scene.photos.size());
    DropByChance(2, placed, scene);  // before they bend a camera that others share
    Refine(scene);
    return placed;
  };
  std::vector<PlacedPhoto> placed = place();
  bool anew = false;
  for (int camera = 0; camera < static_cast<int>(scene.cameras.size()); ++camera) {
    anew |= LetLensGo(camera, scene);
  }
  if (anew) placed = place();
  DropByChance(1, placed, scene);
  SigmaOptions options;
  options.points_are_given = true;
  DropUncertain(EstimateSigmas(options, scene).poses, placed, scene);
  return placed;
}

}  // namespace stucco
