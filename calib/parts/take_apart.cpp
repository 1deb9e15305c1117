// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/parts/take_apart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "calib/mapping/wrong_poses.h"
#include "calib/parts/parts.h"
#include "calib/records/georeference.h"
#include "survey/degree.h"
#include "survey/disjoint_sets.h"
#include "survey/median.h"

namespace stucco {
namespace {

constexpr size_t kLeastPhotos = 5;
// What is placed to this shows no step in a picture, whatever it shares.
constexpr double kSure_px = 1;
// Of a part's points; neighbours meet at their borders.
constexpr double kLittleShared = 0.1;
// Loosely tied are photos that are so many times less sure than the middle one.
constexpr double kLoose = 5;

std::vector<int> PosedPhotos(const Scene& scene) {
  std::vector<int> photos;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (scene.photos[i].pose) photos.push_back(i);
  }
  return photos;
}

Eigen::Vector3d MiddlePoint(const Scene& scene, int photo) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::vector<int> tracks = TracksSeenBy(scene, photo);
  for (const int track : tracks) sum += *scene.tracks[track].position;
  return tracks.empty() ? scene.photos[photo].pose->Center()
                        : Eigen::Vector3d(sum / static_cast<double>(tracks.size()));
}

class Separator {
 public:
  Separator(const PartsInput& input, SceneSigmas& sigmas, Scene& scene)
      : input_(input), sigmas_(sigmas), scene_(scene) {}

  SceneParts Run() {
    result_.part_of_photo.assign(scene_.photos.size(), -1);
    std::vector<std::vector<int>> groups = TiedGroups(scene_, input_.mapper.min_inliers);
    if (!groups.empty()) {
      SetFirst(groups[0]);
      groups.erase(groups.begin());
    }
    if (!groups.empty()) sigmas_.poses = SigmasOf(First(), HasErrors()).poses;
    const std::vector<int> loose = LooselyTied();
    if (!loose.empty()) {
      for (auto& group : TiedGroups(SceneOf(scene_, loose), input_.mapper.min_inliers)) {
        groups.push_back(std::move(group));
      }
      for (const int photo : loose) result_.part_of_photo[photo] = -1;
      first_.reset();
      sigmas_.poses = SigmasOf(First(), HasErrors()).poses;
    }
    for (Scene& part : Detach(groups)) AddHeld(std::move(part));
    GrowOthers();
    return std::move(result_);
  }

 private:
  bool HasErrors() const { return input_.errors != nullptr; }

  void SetFirst(const std::vector<int>& photos) {
    for (const int photo : photos) result_.part_of_photo[photo] = 0;
  }

  std::vector<int> FirstPhotos() const {
    std::vector<int> photos;
    for (int i = 0; i < static_cast<int>(scene_.photos.size()); ++i) {
      if (result_.part_of_photo[i] == 0) photos.push_back(i);
    }
    return photos;
  }

  // The largest part alone, which most surveys never need.
  const Scene& First() {
    if (!first_) first_ = SceneOf(scene_, FirstPhotos());
    return *first_;
  }

  // Photos of the first part that could be elsewhere: beyond what their matches may be off by.
  std::vector<int> LooselyTied() const {
    const std::vector<int> photos = FirstPhotos();
    std::vector<double> all;
    for (const int photo : photos) {
      const double sigma_px = sigmas_.poses[photo].picture_px;
      if (sigma_px >= 0) all.push_back(sigma_px);
    }
    const double usual = Median(std::move(all)).value_or(0);
    std::vector<int> loose;
    for (const int photo : photos) {
      const double limit_px =
          input_.mapper.max_error_sigmas * scene_.photos[photo].keypoint_sigma_px;
      const double sigma_px = sigmas_.poses[photo].picture_px;
      if (sigma_px > limit_px && sigma_px > kLoose * usual) loose.push_back(photo);
    }
    return loose;
  }

  // Takes groups out of the scene. Returns those that are large enough to be parts.
  std::vector<Scene> Detach(const std::vector<std::vector<int>>& groups) {
    std::vector<Scene> parts;
    std::vector<int> all;
    for (const std::vector<int>& group : groups) {
      all.insert(all.end(), group.begin(), group.end());
      if (group.size() >= kLeastPhotos) {
        parts.push_back(SceneOf(scene_, group));
      } else {
        for (const int photo : group) result_.taken[photo] = WhyTaken(group.size());
      }
    }
    if (!all.empty()) TakePoses(all, scene_);
    return parts;
  }

  std::string WhyTaken(size_t num_photos) const {
    return fmt::format(
        "what it has in common with the others does not hold it{}; take photos between it and them",
        num_photos == 1 ? std::string()
                        : fmt::format(", and only {} photos hang together", num_photos));
  }

  SceneSigmas SigmasOf(const Scene& part, bool use_priors) const {
    SigmaOptions options;
    options.use_priors = use_priors;
    options.tracks = TracksToAdjust(input_.mapper, part);
    options.threads = input_.mapper.threads;
    return EstimateSigmas(options, part);
  }

  void AddHeld(Scene part_scene) {
    ScenePart part;
    part.scene = std::move(part_scene);
    part.sigmas = SigmasOf(part.scene, HasErrors());
    if (HasErrors()) Place(part);
    Add(std::move(part));
  }

  void Place(ScenePart& part) {
    const PartPlace place = PlaceOfPart(input_.records, input_.errors, part.scene, First());
    if (place.surface_sigma_m < 0) return;
    part.place = place;
  }

  static bool Joins(const ScenePart& part) {
    return part.place &&
           (part.place->surface_sigma_px <= kSure_px || part.place->shared_surface < kLittleShared);
  }

  void Add(ScenePart part) {
    const int index = static_cast<int>(result_.others.size()) + 1;
    const std::vector<int> photos = PosedPhotos(part.scene);
    for (const int photo : photos) {
      result_.part_of_photo[photo] = index;
      result_.taken.erase(photo);
    }
    if (Joins(part)) {
      Join(part, photos);
    } else {
      part.model = ++num_apart_;
    }
    part.why = Explain(part, photos);
    input_.context.progress->Warn(part.why);
    result_.others.push_back(std::move(part));
  }

  // Puts the part's poses and points into the scene.
  void Join(const ScenePart& part, const std::vector<int>& photos) {
    for (const int photo : photos) {
      scene_.photos[photo].pose = part.scene.photos[photo].pose;
      sigmas_.poses[photo] = part.sigmas.poses[photo];
    }
    for (const SceneTrack& from : part.scene.tracks) {
      if (!from.position) continue;
      const SceneElement& first = from.elements.front();
      const int index = scene_.tracks_of_photo[first.photo][first.keypoint];
      if (index < 0 || scene_.tracks[index].position) continue;
      SceneTrack& to = scene_.tracks[index];
      to.position = from.position;
      for (SceneElement& e : to.elements) {
        e.used = std::ranges::any_of(from.elements, [&](const SceneElement& own) {
          return own.used && own.photo == e.photo && own.keypoint == e.keypoint;
        });
      }
    }
  }

  // Photos that have no pose so far, group by group of those that overlap.
  void GrowOthers() {
    std::vector<bool> tried(scene_.photos.size(), false);
    while (true) {
      std::vector<int> left;
      for (int i = 0; i < static_cast<int>(scene_.photos.size()); ++i) {
        if (result_.part_of_photo[i] < 0 && !tried[i]) left.push_back(i);
      }
      const std::vector<int> group = LargestOverlapping(left);
      if (group.size() < kLeastPhotos) return;
      ScenePart part;
      part.scene = Grow(group);
      const std::vector<int> grown = PosedPhotos(part.scene);
      if (grown.size() < kLeastPhotos) {
        for (const int photo : group) tried[photo] = true;
        continue;
      }
      part.sigmas = SigmasOf(part.scene, false);
      BringIntoFrame(part);
      Add(std::move(part));
    }
  }

  std::vector<VerifiedPair> PairsAmong(const std::vector<int>& photos) const {
    std::vector<bool> is_in(scene_.photos.size(), false);
    for (const int photo : photos) is_in[photo] = true;
    std::vector<VerifiedPair> pairs;
    for (const VerifiedPair& pair : input_.pairs) {
      if (is_in[pair.pair.first] && is_in[pair.pair.second]) pairs.push_back(pair);
    }
    return pairs;
  }

  std::vector<int> LargestOverlapping(const std::vector<int>& photos) const {
    DisjointSets sets(scene_.photos.size());
    for (const VerifiedPair& pair : PairsAmong(photos)) {
      sets.Join(pair.pair.first, pair.pair.second);
    }
    std::map<int, std::vector<int>> groups;
    for (const int photo : photos) groups[sets.Find(photo)].push_back(photo);
    std::vector<int> largest;
    for (auto& [first, group] : groups) {
      if (group.size() > largest.size()) largest = std::move(group);
    }
    return largest;
  }

  // What the largest part of these photos gives; their lens is known where the first part has it.
  Scene Grow(const std::vector<int>& photos) const {
    Scene part = SceneOf(scene_, photos);
    for (const int posed : PosedPhotos(scene_)) {
      SceneCamera& camera = part.cameras[scene_.photos[posed].camera];
      camera.prior = camera.intrinsics;
      camera.focal_sigma_ratio = 0;
    }
    MapperOptions alone = input_.mapper;
    alone.use_priors = false;
    Reconstruct(alone, PairsAmong(photos), input_.context, part);
    const auto groups = TiedGroups(part, alone.min_inliers);
    if (groups.empty() || groups[0].size() < kLeastPhotos) return SceneOf(part, {});
    part = SceneOf(part, groups[0]);
    RefineAll(alone, false, input_.context, part);
    return part;
  }

  // Where the part's positions say that it is.
  void BringIntoFrame(ScenePart& part) {
    const auto fit = FitToPriors(part.scene, UpFromGimbal(input_.captures, part.scene));
    if (!fit || fit->holds == FitHolds::kScale) return;
    Transform(fit->enu_from_scene, part.scene);
    if (HasErrors()) {
      ApplyRecords(input_.records, *input_.errors, part.scene);
      Converge(input_.mapper, true, input_.context, part.scene);
      part.sigmas = SigmasOf(part.scene, true);
      // What was put together wrongly does not lie as its records do; it is no good in this frame.
      if (!ContradictingPoses(part.scene).empty()) return;
    }
    Place(part);
  }

  std::string Explain(const ScenePart& part, const std::vector<int>& photos) const {
    std::string text =
        fmt::format("{} photos ({} ... {}) hang together, but hardly on the others", photos.size(),
                    scene_.photos[photos.front()].name, scene_.photos[photos.back()].name);
    if (!part.place) {
      text += fmt::format(
          ", and their records do not place them: they are a model of their own, calib/sparse/{}, "
          "in "
          "a frame and scale of its own",
          part.model);
    } else {
      text +=
          fmt::format("; their records place them to {:.2f} m and {:.2f} degrees ({:.1f} pixels)",
                      part.place->position_sigma_m, part.place->rotation_sigma_rad / kDegree,
                      part.place->surface_sigma_px);
      if (part.model > 0) {
        text += fmt::format(
            ", and {:.0f} % of what they show the others show, too, so that walls would come out "
            "double: they are a model of their own, calib/sparse/{}, which is not painted",
            100 * part.place->shared_surface, part.model);
      }
    }
    return text + "; " + Remedy(part, photos);
  }

  std::string Remedy(const ScenePart& part, const std::vector<int>& photos) const {
    std::pair<int, int> nearest(-1, -1);
    if (part.place) {
      nearest = NearestPhotos(part.scene, photos);
    } else {
      nearest = BestPair(photos);
    }
    if (nearest.first < 0) return "photos that overlap with both would join them";
    return fmt::format("photos between {} and {} would join them", Label(nearest.first),
                       Label(nearest.second));
  }

  // A photo of the part and one of the first that look at places next to each other.
  std::pair<int, int> NearestPhotos(const Scene& part, const std::vector<int>& photos) const {
    std::vector<std::pair<int, Eigen::Vector3d>> middles;
    for (const int photo : FirstPhotos()) {
      middles.emplace_back(photo, MiddlePoint(scene_, photo));
    }
    std::pair<int, int> nearest(-1, -1);
    double least = std::numeric_limits<double>::infinity();
    for (const int photo : photos) {
      const Eigen::Vector3d middle = MiddlePoint(part, photo);
      for (const auto& [other, place] : middles) {
        const double distance = (place - middle).norm();
        if (distance >= least) continue;
        least = distance;
        nearest = {photo, other};
      }
    }
    return nearest;
  }

  // The pair of a photo of the part and one of the first that most matches agree on.
  std::pair<int, int> BestPair(const std::vector<int>& photos) const {
    std::pair<int, int> best(-1, -1);
    size_t most = 0;
    for (const VerifiedPair& pair : input_.pairs) {
      auto [own, other] = std::pair(pair.pair.first, pair.pair.second);
      if (!std::ranges::binary_search(photos, own)) std::swap(own, other);
      if (!std::ranges::binary_search(photos, own) || result_.part_of_photo[other] != 0) continue;
      if (pair.pair.matches.size() <= most) continue;
      most = pair.pair.matches.size();
      best = {own, other};
    }
    return best;
  }

  // With the facade that the plan means it for.
  std::string Label(int photo) const {
    const std::string& name = scene_.photos[photo].name;
    if (!input_.plan) return name;
    for (const PlannedView& view : input_.plan->views) {
      if (view.id != input_.captures[photo]->view || view.targets.empty()) continue;
      return fmt::format("{} (of {})", name, view.targets.front().facade);
    }
    return name;
  }

  const PartsInput& input_;
  SceneSigmas& sigmas_;
  Scene& scene_;
  std::optional<Scene> first_;  // the largest part alone
  int num_apart_ = 0;
  SceneParts result_;
};

}  // namespace

SceneParts TakeApart(const PartsInput& input, SceneSigmas& sigmas, Scene& scene) {
  assert(IsConsistent(scene));
  assert(input.records.size() == scene.photos.size());
  assert(sigmas.poses.size() == scene.photos.size());
  return Separator(input, sigmas, scene).Run();
}

std::map<int, std::string> WhyApart(const SceneParts& parts) {
  std::map<int, std::string> why = parts.taken;
  for (size_t photo = 0; photo < parts.part_of_photo.size(); ++photo) {
    const int part = parts.part_of_photo[photo];
    if (part <= 0 || parts.others[part - 1].model == 0) continue;
    why[static_cast<int>(photo)] = fmt::format(
        "it is in a model apart from the others, calib/sparse/{}", parts.others[part - 1].model);
  }
  return why;
}

}  // namespace stucco
