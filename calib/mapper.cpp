// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/mapper.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "calib/adjust.h"
#include "calib/resect.h"
#include "calib/triangulate.h"
#include "survey/error.h"

namespace stucco {
namespace {

constexpr int kLocalPhotos = 8;         // adjusted together with a new photo
constexpr double kGlobalGrowth = 1.15;  // more photos than at the last adjustment of everything
constexpr int kMaxRounds = 6;
constexpr int kLeastSeedPoints = 30;

TriangulateOptions ForTriangulation(const MapperOptions& options) {
  return {.max_error_px = options.max_error_px, .min_angle_rad = options.min_angle_rad};
}

RefineIntrinsics LevelFor(int num_posed) {
  if (num_posed < 3) return RefineIntrinsics::kNone;
  return num_posed < 5 ? RefineIntrinsics::kFocal : RefineIntrinsics::kDistortion;
}

void Reset(const Scene& start, Scene& scene) {
  for (size_t i = 0; i < scene.photos.size(); ++i) scene.photos[i].pose.reset();
  for (size_t i = 0; i < scene.cameras.size(); ++i) scene.cameras[i] = start.cameras[i];
  for (SceneTrack& track : scene.tracks) ClearPoint(track);
}

int TriangulateMissing(const MapperOptions& options, Scene& scene) {
  int added = 0;
  for (SceneTrack& track : scene.tracks) {
    if (!track.position && TriangulateTrack(scene, ForTriangulation(options), track)) ++added;
  }
  return added;
}

// Lets a newly posed photo take part: its keypoints join the points they agree with, and tracks
// that had too few photos so far are triangulated.
void ConnectPhoto(const MapperOptions& options, int photo, Scene& scene) {
  for (const int index : scene.tracks_of_photo[photo]) {
    if (index < 0) continue;
    SceneTrack& track = scene.tracks[index];
    if (!track.position) {
      TriangulateTrack(scene, ForTriangulation(options), track);
      continue;
    }
    for (SceneElement& element : track.elements) {
      if (element.photo != photo) continue;
      element.used = ReprojectionError(scene, element, *track.position) < options.max_error_px;
    }
  }
}

// Observations of existing points that fit by now.
void CompleteTracks(const MapperOptions& options, Scene& scene) {
  for (SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    for (SceneElement& element : track.elements) {
      element.used = ReprojectionError(scene, element, *track.position) < options.max_error_px;
    }
  }
}

bool StartFrom(const MapperOptions& options, const Seed& seed, Scene& scene) {
  scene.photos[seed.first].pose = Pose{};
  scene.photos[seed.second].pose = seed.relative.second_from_first;
  TriangulateMissing(options, scene);
  AdjustOptions adjust;
  adjust.variable_photos = {seed.second};
  adjust.refine = RefineIntrinsics::kNone;
  adjust.threads = options.threads;
  if (!Adjust(adjust, scene).usable) return false;
  FilterScene(options, options.max_error_px, scene);
  const int points = NumUsedObservations(scene, seed.second);
  return scene.photos[seed.first].pose && scene.photos[seed.second].pose &&
         points >= kLeastSeedPoints;
}

// The new photo and those that share most points with it.
std::vector<int> Neighbourhood(const Scene& scene, int photo) {
  std::vector<int> shared(scene.photos.size(), 0);
  for (const int index : scene.tracks_of_photo[photo]) {
    if (index < 0 || !scene.tracks[index].position) continue;
    for (const SceneElement& e : scene.tracks[index].elements) shared[e.photo] += e.used;
  }
  std::vector<int> order;
  for (size_t i = 0; i < shared.size(); ++i) {
    if (shared[i] > 0 && static_cast<int>(i) != photo) order.push_back(static_cast<int>(i));
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return shared[a] > shared[b]; });
  if (order.size() > kLocalPhotos) order.resize(kLocalPhotos);
  order.push_back(photo);
  return order;
}

void AdjustEverything(const MapperOptions& options, Scene& scene) {
  AdjustOptions adjust;
  adjust.refine = LevelFor(NumPosed(scene));
  adjust.threads = options.threads;
  adjust.max_iterations = 30;
  Adjust(adjust, scene);
  FilterScene(options, options.max_error_px, scene);
  CompleteTracks(options, scene);
  TriangulateMissing(options, scene);
}

void AdjustAround(const MapperOptions& options, int photo, Scene& scene) {
  AdjustOptions adjust;
  adjust.variable_photos = Neighbourhood(scene, photo);
  // With every posed photo variable nothing would hold the frame.
  if (static_cast<int>(adjust.variable_photos.size()) >= NumPosed(scene)) {
    adjust.variable_photos.erase(adjust.variable_photos.begin());
  }
  adjust.refine = RefineIntrinsics::kNone;
  adjust.threads = options.threads;
  adjust.max_iterations = 15;
  Adjust(adjust, scene);
}

// The unposed photo with the best view of the points so far; -1 when none sees enough.
int NextPhoto(const MapperOptions& options, const Scene& scene, const std::set<int>& refused) {
  int best = -1;
  int best_score = 0;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (scene.photos[i].pose || refused.contains(i)) continue;
    if (NumVisiblePoints(scene, i) < options.min_inliers) continue;
    const int score = VisibilityScore(scene, i);
    if (score > best_score) {
      best = i;
      best_score = score;
    }
  }
  return best;
}

void Grow(const MapperOptions& options, const StageContext& context, Scene& scene) {
  int posed_at_last_global = NumPosed(scene);
  std::set<int> refused;
  bool grew_since_refusal = false;
  while (true) {
    context.ThrowIfCancelled();
    const int photo = NextPhoto(options, scene, refused);
    if (photo < 0) {
      if (refused.empty() || !grew_since_refusal) return;
      refused.clear();  // more points since then: they get another chance
      grew_since_refusal = false;
      AdjustEverything(options, scene);
      continue;
    }
    const auto resection = Resect(scene, photo, 2 * options.max_error_px, options.min_inliers);
    // A pose that explains only a small part of what the photo should see is a wrong one.
    if (!resection || resection->num_inliers < 0.2 * resection->num_points) {
      refused.insert(photo);
      continue;
    }
    scene.photos[photo].pose = resection->cam_from_world;
    grew_since_refusal = true;
    ConnectPhoto(options, photo, scene);
    const int posed = NumPosed(scene);
    if (posed <= 6 || posed >= posed_at_last_global * kGlobalGrowth) {
      AdjustEverything(options, scene);
      posed_at_last_global = NumPosed(scene);
    } else {
      AdjustAround(options, photo, scene);
    }
    context.progress->Advance(scene.photos[photo].pose ? 1 : 0);
    if (!scene.photos[photo].pose) refused.insert(photo);
  }
}

std::string WhyUnposed(const MapperOptions& options, const Scene& scene,
                       const std::vector<VerifiedPair>& pairs, int photo) {
  size_t num_pairs = 0;
  size_t best = 0;
  size_t rotations = 0;
  for (const VerifiedPair& pair : pairs) {
    if (pair.pair.first != photo && pair.pair.second != photo) continue;
    ++num_pairs;
    rotations += pair.rotation_only;
    best = std::max(best, pair.pair.matches.size());
  }
  if (num_pairs == 0) {
    return "it overlaps with no other photo: no pair has enough matches that agree; take photos "
           "between it and the others";
  }
  if (rotations == num_pairs) {
    return fmt::format(
        "its {} overlapping photos were all taken from the same point (rotation only), "
        "which gives no depth; move between photos",
        num_pairs);
  }
  return fmt::format(
      "only {} of its keypoints see points of the reconstruction that agree on a pose "
      "(at least {} are needed); its best pair has {} matches",
      NumVisiblePoints(scene, photo), options.min_inliers, best);
}

int FilterPoints(const MapperOptions& options, double max_error_px, Scene& scene) {
  int dropped = 0;
  for (SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    int used = 0;
    for (SceneElement& element : track.elements) {
      if (!element.used) continue;
      if (ReprojectionError(scene, element, *track.position) < max_error_px) {
        ++used;
      } else {
        element.used = false;
        ++dropped;
      }
    }
    if (used < 2 || LargestRayAngle(scene, track) < options.min_angle_rad) {
      dropped += used;
      ClearPoint(track);
    }
  }
  return dropped;
}

// Takes poses away that too few observations hold. Returns whether there were any.
bool DropWeakPoses(const MapperOptions& options, Scene& scene) {
  bool any = false;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (!scene.photos[i].pose || NumUsedObservations(scene, i) >= options.min_inliers) continue;
    scene.photos[i].pose.reset();
    any = true;
  }
  return any;
}

}  // namespace

int FilterScene(const MapperOptions& options, double max_error_px, Scene& scene) {
  int dropped = FilterPoints(options, max_error_px, scene);
  // A photo that goes takes observations from points that other photos may then see too little of.
  while (DropWeakPoses(options, scene)) dropped += FilterPoints(options, max_error_px, scene);
  return dropped;
}

AdjustReport RefineAll(const MapperOptions& options, bool use_priors, const StageContext& context,
                       Scene& scene) {
  AdjustReport report;
  AdjustReport last;
  double last_noise = -1;
  for (int round = 0; round < kMaxRounds; ++round) {
    context.ThrowIfCancelled();
    CompleteTracks(options, scene);
    TriangulateMissing(options, scene);
    AdjustOptions adjust;
    adjust.refine = options.refine_principal_point ? RefineIntrinsics::kPrincipalPoint
                                                   : RefineIntrinsics::kDistortion;
    if (NumPosed(scene) < 3) adjust.refine = RefineIntrinsics::kNone;
    adjust.use_priors = use_priors;
    adjust.threads = options.threads;
    adjust.max_iterations = 100;
    adjust.tolerance = 1e-6;
    adjust.loss_scale = 1;
    adjust.noise = MeasureNoise(scene);
    report = Adjust(adjust, scene);
    FilterScene(options, options.max_error_px, scene);
    const bool same_observations = std::abs(report.num_observations - last.num_observations) <=
                                   0.001 * report.num_observations;
    const bool same_noise = std::abs(adjust.noise - last_noise) <= 0.01 * adjust.noise;
    if (!report.usable || (same_observations && same_noise)) break;
    last = report;
    last_noise = adjust.noise;
  }
  return report;
}

MapReport Reconstruct(const MapperOptions& options, const std::vector<VerifiedPair>& pairs,
                      const StageContext& context, Scene& scene) {
  const Scene start = scene;
  Scene best = scene;
  MapReport report;
  const int connected = [&] {
    std::set<int> photos;
    for (const VerifiedPair& pair : pairs) photos.insert({pair.pair.first, pair.pair.second});
    return static_cast<int>(photos.size());
  }();
  context.progress->Begin("placing photos", scene.photos.size());
  for (const Seed& seed : FindSeeds(scene, pairs, options.max_error_px, options.max_seeds)) {
    ++report.num_seeds_tried;
    Reset(start, scene);
    if (!StartFrom(options, seed, scene)) continue;
    Grow(options, context, scene);
    if (NumPosed(scene) > NumPosed(best)) best = scene;
    if (NumPosed(best) >= 0.9 * connected) break;
  }
  scene = std::move(best);
  if (NumPosed(scene) >= 2) {
    RefineAll(options, false, context, scene);
    const int posed = NumPosed(scene);
    Grow(options, context, scene);  // photos that only fit now
    if (NumPosed(scene) > posed) RefineAll(options, false, context, scene);
  }
  report.num_posed = NumPosed(scene);
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (!scene.photos[i].pose) report.unposed[i] = WhyUnposed(options, scene, pairs, i);
  }
  return report;
}

}  // namespace stucco
