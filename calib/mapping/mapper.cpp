// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/mapping/mapper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <optional>

#include "calib/scene/choose_tracks.h"
#include "calib/scene/hidden_points.h"
#include "calib/scene/points.h"
#include "calib/scene/resect.h"
#include "calib/scene/triangulate.h"
#include "survey/disjoint_sets.h"
#include "survey/error.h"

namespace stucco {
namespace {

constexpr int kLocalPhotos = 8;         // adjusted together with a new photo
constexpr double kGlobalGrowth = 1.15;  // more photos than at the last adjustment of everything
constexpr int kMaxRounds = 6;
constexpr int kLeastInitialPoints = 30;
constexpr int kMaxAttempts = 3;      // to place a photo
constexpr size_t kCompared = 20;     // candidates for the next photo
constexpr size_t kSureMatches = 30;  // tie two photos into one component
// More observations than these take no part in an adjustment of everything: poses are as good
// without, as each photo has its share of those that do.
constexpr int kAllObservations = 150000;
// Against positions keypoints are not better than this, whatever their residuals show: what the
// lens model lacks makes them err together.
constexpr double kLeastNoiseAgainstPositions = 0.5;

TriangulateOptions ForTriangulation(const MapperOptions& options) {
  return {.max_error_sigmas = options.max_error_sigmas, .min_angle_rad = options.min_angle_rad};
}

void Reset(const std::vector<SceneCamera>& cameras, Scene& scene) {
  for (ScenePhoto& photo : scene.photos) photo.pose.reset();
  scene.cameras = cameras;
  for (SceneTrack& track : scene.tracks) ClearPoint(track);
}

// What of a scene changes while it grows: a small part of it.
struct Grown {
  int num_registered = 0;
  std::vector<SceneCamera> cameras;
  std::vector<std::optional<Pose>> poses;              // by photo
  std::vector<std::optional<Eigen::Vector3d>> points;  // by track
  std::vector<bool> used;                              // elements of all tracks
};

Grown Remember(const Scene& scene) {
  Grown grown{NumRegistered(scene), scene.cameras, {}, {}, {}};
  for (const ScenePhoto& photo : scene.photos) grown.poses.push_back(photo.pose);
  for (const SceneTrack& track : scene.tracks) {
    grown.points.push_back(track.position);
    for (const SceneElement& element : track.elements) grown.used.push_back(element.used);
  }
  return grown;
}

void Recall(const Grown& grown, Scene& scene) {
  scene.cameras = grown.cameras;
  for (size_t i = 0; i < scene.photos.size(); ++i) scene.photos[i].pose = grown.poses[i];
  auto used = grown.used.begin();
  for (size_t t = 0; t < scene.tracks.size(); ++t) {
    scene.tracks[t].position = grown.points[t];
    for (SceneElement& element : scene.tracks[t].elements) element.used = *used++;
  }
}

// How many points each photo's keypoints belong to, as NumVisiblePoints counts them. Counted on
// while photos are added: counting anew for each makes the time grow with the square of photos.
class VisiblePoints {
 public:
  explicit VisiblePoints(const Scene& scene) : count_(scene.photos.size(), 0) {
    for (const SceneTrack& track : scene.tracks) {
      if (track.position) Add(track);
    }
  }
  void Add(const SceneTrack& track) {
    for (const SceneElement& element : track.elements) ++count_[element.photo];
  }
  int Of(int photo) const { return count_[photo]; }

 private:
  std::vector<int> count_;
};

// Lets a newly registered photo take part: its keypoints join the points they agree with, and
// tracks that had too few photos so far are triangulated.
void ConnectPhoto(const MapperOptions& options, int photo, VisiblePoints& visible, Scene& scene) {
  for (const int index : scene.tracks_of_photo[photo]) {
    if (index < 0) continue;
    SceneTrack& track = scene.tracks[index];
    if (!track.position) {
      if (TriangulateTrack(scene, ForTriangulation(options), track)) visible.Add(track);
      continue;
    }
    for (SceneElement& element : track.elements) {
      if (element.photo != photo) continue;
      element.used =
          ReprojectionErrorInSigmas(scene, element, *track.position) < options.max_error_sigmas;
    }
  }
}

bool StartFrom(const MapperOptions& options, const InitialPair& pair, Scene& scene) {
  scene.photos[pair.first].pose = Pose{};
  scene.photos[pair.second].pose = pair.relative.second_from_first;
  TriangulateMissing(ForTriangulation(options), options.threads, scene);
  AdjustOptions adjust;
  adjust.variable_photos = {pair.second};
  adjust.refine = RefineIntrinsics::kNone;
  adjust.threads = options.adjust_threads;
  if (!Adjust(adjust, scene).usable) return false;
  FilterScene(options, scene);
  const int points = NumUsedObservations(scene, pair.second);
  return scene.photos[pair.first].pose && scene.photos[pair.second].pose &&
         points >= kLeastInitialPoints;
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

int NumObservations(const Scene& scene) {
  int count = 0;
  for (const SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    for (const SceneElement& element : track.elements) count += element.used;
  }
  return count;
}

// Adjusts everything; of a large scene with chosen tracks, the points of the others follow.
AdjustReport AdjustChosen(const MapperOptions& options, AdjustOptions adjust, Scene& scene) {
  adjust.tracks = TracksToAdjust(options, scene);
  const AdjustReport report = Adjust(adjust, scene);
  if (adjust.tracks.empty()) return report;
  std::vector<bool> is_chosen(scene.tracks.size(), false);
  for (const int track : adjust.tracks) is_chosen[track] = true;
  for (size_t t = 0; t < scene.tracks.size(); ++t) {
    if (!is_chosen[t]) ClearPoint(scene.tracks[t]);
  }
  TriangulateMissing(ForTriangulation(options), options.threads, scene);
  return report;
}

AdjustOptions ForEverything(const MapperOptions& options, bool use_priors, const Scene& scene) {
  AdjustOptions adjust;
  adjust.refine = options.refine_principal_point ? RefineIntrinsics::kPrincipalPoint
                                                 : RefineIntrinsics::kDistortion;
  adjust.use_priors = use_priors;
  adjust.threads = options.adjust_threads;
  // Robust by the noise that there is; records, whose deviations are measured too, weigh against
  // it. The weight against lens priors stays that of the stated one.
  adjust.noise = MeasureNoise(scene);
  adjust.least_noise_against_positions = kLeastNoiseAgainstPositions;
  adjust.loss_scale *= adjust.noise;
  return adjust;
}

void AdjustEverything(const MapperOptions& options, Scene& scene) {
  AdjustOptions adjust = options.use_priors ? ForEverything(options, true, scene) : AdjustOptions{};
  adjust.refine = RefineIntrinsics::kDistortion;
  adjust.threads = options.adjust_threads;
  adjust.max_iterations = 30;
  AdjustChosen(options, adjust, scene);
  FilterScene(options, scene);
  CompleteTracks(options.max_error_sigmas, options.threads, scene);
  TriangulateMissing(ForTriangulation(options), options.threads, scene);
}

void AdjustAround(const MapperOptions& options, int photo, Scene& scene) {
  AdjustOptions adjust;
  adjust.variable_photos = Neighbourhood(scene, photo);
  // With every registered photo variable nothing would hold the frame.
  if (static_cast<int>(adjust.variable_photos.size()) >= NumRegistered(scene)) {
    adjust.variable_photos.erase(adjust.variable_photos.begin());
  }
  adjust.refine = RefineIntrinsics::kNone;
  adjust.threads = options.adjust_threads;
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

// The photo without a pose that has the best view of the points so far; -1 when none sees enough.
// Only the photos that see most points are compared by how these spread over the picture.
int NextPhoto(const MapperOptions& options, const Scene& scene, const Attempts& attempts,
              const VisiblePoints& visible) {
  std::vector<std::pair<int, int>> candidates;  // (-points, photo)
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (scene.photos[i].pose || !attempts.MayTry(i)) continue;
    const int points = visible.Of(i);
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
bool Register(const MapperOptions& options, int photo, VisiblePoints& visible, Scene& scene) {
  const double limit_px = 2 * options.max_error_sigmas * scene.photos[photo].keypoint_sigma_px;
  const auto resection = Resect(scene, photo, limit_px, options.min_inliers);
  // A pose that explains only a small part of what the photo should see is a wrong one.
  if (!resection || resection->num_inliers < 0.2 * resection->num_points) return false;
  scene.photos[photo].pose = resection->cam_from_world;
  ConnectPhoto(options, photo, visible, scene);
  return true;
}

void Grow(const MapperOptions& options, const StageContext& context, Scene& scene) {
  int registered_at_last_global = NumRegistered(scene);
  Attempts attempts(scene.photos.size());
  VisiblePoints visible(scene);
  bool grew = false;  // since photos were last forgiven
  while (true) {
    context.ThrowIfCancelled();
    const int photo = NextPhoto(options, scene, attempts, visible);
    if (photo < 0) {
      if (!grew) return;
      attempts.ForgiveRefused();
      grew = false;
      AdjustEverything(options, scene);
      visible = VisiblePoints(scene);
      continue;
    }
    ++attempts.count[photo];
    if (Register(options, photo, visible, scene)) {
      const int registered = NumRegistered(scene);
      if (registered <= 6 || registered >= registered_at_last_global * kGlobalGrowth) {
        AdjustEverything(options, scene);
        visible = VisiblePoints(scene);
        registered_at_last_global = NumRegistered(scene);
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

std::string WhyUnregistered(const MapperOptions& options, const Scene& scene,
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

std::vector<int> TracksToAdjust(const MapperOptions& options, const Scene& scene) {
  if (NumObservations(scene) <= kAllObservations) return {};
  return ChooseTracks(scene, options.observations_per_photo);
}

int FilterScene(const MapperOptions& options, Scene& scene) {
  int dropped = FilterPoints(ForTriangulation(options), options.threads, scene);
  // A photo that goes takes observations from points that other photos may then see too little of.
  while (DropWeakPoses(options, scene))
    dropped += FilterPoints(ForTriangulation(options), options.threads, scene);
  return dropped;
}

void Settle(const MapperOptions& options, bool use_priors, const StageContext& context,
            Scene& scene) {
  int last_observations = 0;
  double last_noise = -1;
  for (int round = 0; round < kMaxRounds; ++round) {
    context.ThrowIfCancelled();
    CompleteTracks(options.max_error_sigmas, options.threads, scene);
    TriangulateMissing(ForTriangulation(options), options.threads, scene);
    if (use_priors) DropHiddenPoints(options.threads, scene);
    const AdjustReport report =
        AdjustChosen(options, ForEverything(options, use_priors, scene), scene);
    FilterScene(options, scene);
    const double noise = MeasureNoise(scene);
    const bool same_observations =
        std::abs(report.num_observations - last_observations) <= 0.001 * report.num_observations;
    const bool same_noise = std::abs(noise - last_noise) <= 0.01 * noise;
    if (!report.usable || (same_observations && same_noise)) return;
    last_observations = report.num_observations;
    last_noise = noise;
  }
}

AdjustReport Converge(const MapperOptions& options, bool use_priors, const StageContext& context,
                      Scene& scene) {
  context.ThrowIfCancelled();
  AdjustOptions adjust = ForEverything(options, use_priors, scene);
  adjust.max_iterations = 100;
  adjust.tolerance = 1e-6;
  const AdjustReport report = AdjustChosen(options, adjust, scene);
  FilterScene(options, scene);
  return report;
}

AdjustReport RefineAll(const MapperOptions& options, bool use_priors, const StageContext& context,
                       Scene& scene) {
  Settle(options, use_priors, context, scene);
  return Converge(options, use_priors, context, scene);
}

namespace {

// Photos that sure pairs tie together, as these pairs.
struct Component {
  int num_photos = 0;
  std::vector<VerifiedPair> pairs;
};

// Largest first.
std::vector<Component> Components(size_t num_photos, const std::vector<VerifiedPair>& pairs) {
  DisjointSets groups(num_photos);
  for (const VerifiedPair& pair : pairs) {
    if (pair.pair.matches.size() < kSureMatches) continue;
    groups.Join(pair.pair.first, pair.pair.second);
  }
  std::vector<Component> components(num_photos);
  for (size_t i = 0; i < num_photos; ++i) ++components[groups.Find(static_cast<int>(i))].num_photos;
  for (const VerifiedPair& pair : pairs) {
    if (pair.pair.matches.size() < kSureMatches) continue;
    components[groups.Find(pair.pair.first)].pairs.push_back(pair);
  }
  std::erase_if(components, [](const Component& c) { return c.num_photos < 2; });
  std::stable_sort(components.begin(), components.end(),
                   [](const auto& a, const auto& b) { return a.num_photos > b.num_photos; });
  return components;
}

struct GrowInput {
  const MapperOptions& options;
  const StageContext& context;
  const std::vector<SceneCamera>& cameras;  // at the start
};

// Grows from initial pairs of a component until one explains most of it. Keeps the largest result
// in `best`; returns the number of pairs tried.
int GrowComponent(const GrowInput& input, const Component& component, Scene& scene, Grown& best) {
  const MapperOptions& options = input.options;
  std::vector<bool> registered(scene.photos.size(), false);  // from any pair so far
  int num_tried = 0;
  Reset(input.cameras, scene);
  for (const InitialPair& pair : FindInitialPairs(scene, component.pairs, options.max_error_sigmas,
                                                  options.max_initial_pairs)) {
    if (registered[pair.first] && registered[pair.second])
      continue;  // it would give the same again
    ++num_tried;
    Reset(input.cameras, scene);
    if (!StartFrom(options, pair, scene)) continue;
    Grow(options, input.context, scene);
    for (size_t i = 0; i < registered.size(); ++i) {
      registered[i] = registered[i] || scene.photos[i].pose;
    }
    if (NumRegistered(scene) > best.num_registered) best = Remember(scene);
    if (NumRegistered(scene) >= 0.9 * component.num_photos) break;
  }
  return num_tried;
}

}  // namespace

std::map<int, std::string> ExplainUnregistered(const MapperOptions& options,
                                               const std::vector<VerifiedPair>& pairs,
                                               const Scene& scene) {
  std::map<int, std::string> why;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (!scene.photos[i].pose) why[i] = WhyUnregistered(options, scene, pairs, i);
  }
  return why;
}

void GrowOn(const MapperOptions& options, const StageContext& context, Scene& scene) {
  context.progress->Begin("placing photos", scene.photos.size());
  context.progress->Advance(NumRegistered(scene));
  Grow(options, context, scene);
}

MapReport Reconstruct(const MapperOptions& options, const std::vector<VerifiedPair>& pairs,
                      const StageContext& context, Scene& scene) {
  assert(IsConsistent(scene) && scene.tracks_of_photo.size() == scene.photos.size());
  const std::vector<SceneCamera> cameras = scene.cameras;
  Grown best = Remember(scene);
  MapReport report;
  context.progress->Begin("placing photos", scene.photos.size());
  for (const Component& component : Components(scene.photos.size(), pairs)) {
    if (component.num_photos <= best.num_registered) break;  // the largest comes first
    report.num_initial_pairs_tried +=
        GrowComponent({options, context, cameras}, component, scene, best);
  }
  Recall(best, scene);
  if (NumRegistered(scene) >= 2) {
    Settle(options, options.use_priors, context, scene);
    Grow(options, context, scene);  // photos that only fit now
  }
  report.num_registered = NumRegistered(scene);
  return report;
}

}  // namespace stucco
