// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/mapper.h"

#include <fmt/format.h>

#include <algorithm>

#include "calib/adjust.h"
#include "calib/groups.h"
#include "calib/resect.h"
#include "calib/triangulate.h"
#include "survey/error.h"

namespace stucco {
namespace {

constexpr int kLocalPhotos = 8;         // adjusted together with a new photo
constexpr double kGlobalGrowth = 1.15;  // more photos than at the last adjustment of everything
constexpr int kMaxRounds = 6;
constexpr int kLeastSeedPoints = 30;
constexpr int kMaxAttempts = 3;      // to place a photo
constexpr size_t kCompared = 20;     // candidates for the next photo
constexpr size_t kSureMatches = 30;  // tie two photos into one component

TriangulateOptions ForTriangulation(const MapperOptions& options) {
  return {.max_misfit = options.max_misfit, .min_angle_rad = options.min_angle_rad};
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
      element.used = Misfit(scene, element, *track.position) < options.max_misfit;
    }
  }
}

// Observations of existing points that fit by now.
void CompleteTracks(const MapperOptions& options, Scene& scene) {
  for (SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    for (SceneElement& element : track.elements) {
      element.used = Misfit(scene, element, *track.position) < options.max_misfit;
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
  FilterScene(options, options.max_misfit, scene);
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
  adjust.refine = RefineIntrinsics::kDistortion;
  adjust.threads = options.threads;
  adjust.max_iterations = 30;
  Adjust(adjust, scene);
  FilterScene(options, options.max_misfit, scene);
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

// Which photos may still be tried. One that was refused gets another chance when others were placed
// since then, but not for ever: a photo can be placed and dropped again.
struct Attempts {
  explicit Attempts(size_t num_photos) : count(num_photos, 0), refused(num_photos, false) {}

  bool MayTry(int photo) const { return !refused[photo] && count[photo] < kMaxAttempts; }
  void ForgiveRefused() { refused.assign(refused.size(), false); }

  std::vector<int> count;
  std::vector<bool> refused;
};

// The unposed photo with the best view of the points so far; -1 when none sees enough. Only the
// photos that see most points are compared by how these spread over the picture.
int NextPhoto(const MapperOptions& options, const Scene& scene, const Attempts& attempts) {
  std::vector<std::pair<int, int>> candidates;  // (-points, photo)
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (scene.photos[i].pose || !attempts.MayTry(i)) continue;
    const int points = NumVisiblePoints(scene, i);
    if (points >= options.min_inliers) candidates.emplace_back(-points, i);
  }
  const size_t count = std::min(candidates.size(), kCompared);
  std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count),
                    candidates.end());
  int best = -1;
  int best_score = 0;
  for (size_t i = 0; i < count; ++i) {
    const int score = VisibilityScore(scene, candidates[i].second);
    if (score > best_score) {
      best = candidates[i].second;
      best_score = score;
    }
  }
  return best;
}

// Gives a photo a pose when enough of what it should see agrees on one.
bool Place(const MapperOptions& options, int photo, Scene& scene) {
  const double limit_px = 2 * options.max_misfit * scene.photos[photo].keypoint_sigma_px;
  const auto resection = Resect(scene, photo, limit_px, options.min_inliers);
  // A pose that explains only a small part of what the photo should see is a wrong one.
  if (!resection || resection->num_inliers < 0.2 * resection->num_points) return false;
  scene.photos[photo].pose = resection->cam_from_world;
  ConnectPhoto(options, photo, scene);
  return true;
}

void Grow(const MapperOptions& options, const StageContext& context, Scene& scene) {
  int posed_at_last_global = NumPosed(scene);
  Attempts attempts(scene.photos.size());
  bool grew = false;  // since photos were last forgiven
  while (true) {
    context.ThrowIfCancelled();
    const int photo = NextPhoto(options, scene, attempts);
    if (photo < 0) {
      if (!grew) return;
      attempts.ForgiveRefused();
      grew = false;
      AdjustEverything(options, scene);
      continue;
    }
    ++attempts.count[photo];
    if (Place(options, photo, scene)) {
      const int posed = NumPosed(scene);
      if (posed <= 6 || posed >= posed_at_last_global * kGlobalGrowth) {
        AdjustEverything(options, scene);
        posed_at_last_global = NumPosed(scene);
      } else {
        AdjustAround(options, photo, scene);
      }
    }
    if (scene.photos[photo].pose) {
      grew = true;
      context.progress->Advance();
    } else {
      attempts.refused[photo] = true;
    }
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
      "only {} of its keypoints see points of the reconstruction, and fewer than the {} that are "
      "needed agree on a pose; its best pair has {} matches",
      NumVisiblePoints(scene, photo), options.min_inliers, best);
}

int FilterPoints(const MapperOptions& options, double max_misfit, Scene& scene) {
  int dropped = 0;
  for (SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    int used = 0;
    for (SceneElement& element : track.elements) {
      if (!element.used) continue;
      if (Misfit(scene, element, *track.position) < max_misfit) {
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

int FilterScene(const MapperOptions& options, double max_misfit, Scene& scene) {
  int dropped = FilterPoints(options, max_misfit, scene);
  // A photo that goes takes observations from points that other photos may then see too little of.
  while (DropWeakPoses(options, scene)) dropped += FilterPoints(options, max_misfit, scene);
  return dropped;
}

namespace {

AdjustOptions ForEverything(const MapperOptions& options, bool use_priors, const Scene& scene) {
  AdjustOptions adjust;
  adjust.refine = options.refine_principal_point ? RefineIntrinsics::kPrincipalPoint
                                                 : RefineIntrinsics::kDistortion;
  adjust.use_priors = use_priors;
  adjust.threads = options.threads;
  // Robust by the noise that there is. The weight against positions and lens priors stays that of
  // the stated one: keypoints also err together, which their residuals do not show.
  adjust.loss_scale *= MeasureNoise(scene);
  return adjust;
}

// Rounds of adjustment, filtering and triangulating anew until observations and noise stay as they
// are.
void Settle(const MapperOptions& options, bool use_priors, const StageContext& context,
            Scene& scene) {
  int last_observations = 0;
  double last_noise = -1;
  for (int round = 0; round < kMaxRounds; ++round) {
    context.ThrowIfCancelled();
    CompleteTracks(options, scene);
    TriangulateMissing(options, scene);
    const AdjustReport report = Adjust(ForEverything(options, use_priors, scene), scene);
    FilterScene(options, options.max_misfit, scene);
    const double noise = MeasureNoise(scene);
    const bool same_observations =
        std::abs(report.num_observations - last_observations) <= 0.001 * report.num_observations;
    const bool same_noise = std::abs(noise - last_noise) <= 0.01 * noise;
    if (!report.usable || (same_observations && same_noise)) return;
    last_observations = report.num_observations;
    last_noise = noise;
  }
}

}  // namespace

AdjustReport RefineAll(const MapperOptions& options, bool use_priors, const StageContext& context,
                       Scene& scene) {
  Settle(options, use_priors, context, scene);
  context.ThrowIfCancelled();
  AdjustOptions adjust = ForEverything(options, use_priors, scene);
  adjust.max_iterations = 100;
  adjust.tolerance = 1e-6;
  const AdjustReport report = Adjust(adjust, scene);
  FilterScene(options, options.max_misfit, scene);
  return report;
}

namespace {

// Photos that sure pairs tie together, as these pairs.
struct Component {
  int num_photos = 0;
  std::vector<VerifiedPair> pairs;
};

// Largest first.
std::vector<Component> Components(size_t num_photos, const std::vector<VerifiedPair>& pairs) {
  Groups groups(num_photos);
  for (const VerifiedPair& pair : pairs) {
    if (pair.pair.matches.size() < kSureMatches) continue;
    groups.Join(pair.pair.first, pair.pair.second);
  }
  std::vector<Component> components(num_photos);
  for (size_t i = 0; i < num_photos; ++i) ++components[groups.Of(static_cast<int>(i))].num_photos;
  for (const VerifiedPair& pair : pairs) {
    if (pair.pair.matches.size() < kSureMatches) continue;
    components[groups.Of(pair.pair.first)].pairs.push_back(pair);
  }
  std::erase_if(components, [](const Component& c) { return c.num_photos < 2; });
  std::stable_sort(components.begin(), components.end(),
                   [](const auto& a, const auto& b) { return a.num_photos > b.num_photos; });
  return components;
}

struct GrowInput {
  const MapperOptions& options;
  const StageContext& context;
  const Scene& start;
};

// Grows from seeds of a component until one explains most of it. Keeps the largest result in
// `best`; returns the number of seeds tried.
int GrowComponent(const GrowInput& input, const Component& component, Scene& scene, Scene& best) {
  const MapperOptions& options = input.options;
  std::vector<bool> posed(scene.photos.size(), false);  // from any seed so far
  int num_tried = 0;
  for (const Seed& seed :
       FindSeeds(input.start, component.pairs, options.max_misfit, options.max_seeds)) {
    if (posed[seed.first] && posed[seed.second]) continue;  // it would give the same again
    ++num_tried;
    Reset(input.start, scene);
    if (!StartFrom(options, seed, scene)) continue;
    Grow(options, input.context, scene);
    for (size_t i = 0; i < posed.size(); ++i) posed[i] = posed[i] || scene.photos[i].pose;
    if (NumPosed(scene) > NumPosed(best)) best = scene;
    if (NumPosed(scene) >= 0.9 * component.num_photos) break;
  }
  return num_tried;
}

}  // namespace

std::map<int, std::string> ExplainUnposed(const MapperOptions& options,
                                          const std::vector<VerifiedPair>& pairs,
                                          const Scene& scene) {
  std::map<int, std::string> unposed;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (!scene.photos[i].pose) unposed[i] = WhyUnposed(options, scene, pairs, i);
  }
  return unposed;
}

MapReport Reconstruct(const MapperOptions& options, const std::vector<VerifiedPair>& pairs,
                      const StageContext& context, Scene& scene) {
  const Scene start = scene;
  Scene best = scene;
  MapReport report;
  context.progress->Begin("placing photos", scene.photos.size());
  for (const Component& component : Components(scene.photos.size(), pairs)) {
    if (component.num_photos <= NumPosed(best)) break;  // the largest comes first
    report.num_seeds_tried += GrowComponent({options, context, start}, component, scene, best);
  }
  scene = std::move(best);
  if (NumPosed(scene) >= 2) {
    Settle(options, false, context, scene);
    Grow(options, context, scene);  // photos that only fit now
  }
  report.num_posed = NumPosed(scene);
  report.unposed = ExplainUnposed(options, pairs, scene);
  return report;
}

}  // namespace stucco
