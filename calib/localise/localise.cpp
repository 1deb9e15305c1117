// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/localise/localise.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "calib/features/descriptors.h"
#include "calib/features/matches.h"
#include "calib/localise/place_in_model.h"
#include "calib/localise/point_keypoints.h"
#include "calib/matching/choose_pairs.h"
#include "calib/matching/detect_photos.h"
#include "calib/matching/photo_set.h"
#include "calib/scene/as_model.h"
#include "calib/scene/tracks.h"
#include "calib/two_view/verify.h"
#include "survey/error.h"
#include "survey/parallel.h"
#include "survey/survey_photo.h"

namespace stucco {
namespace {

// Photos of the model that a photo is matched with: all of a small model, else so many of the most
// alike and so many of the nearest.
constexpr size_t kMatchAll = 30;
constexpr size_t kMostAlike = 15;
constexpr size_t kNearest = 10;

// Photos with their features, ready to be matched.
struct FeatureSet {
  std::vector<const CapturedPhoto*> photos;
  Captures captures;  // their cameras
  StageContext context;
  DetectedFeatures detected;
};

Features FeaturesOf(const CalibOptions& options, const FeatureSet& set, int photo) {
  const Guidance none;
  const PhotoSet photos{set.captures, set.photos, none};
  return FeaturesOfPhoto({options, photos, set.context}, set.detected, photo);
}

FeatureSet Detect(const CalibOptions& options, std::vector<const CapturedPhoto*> photos,
                  const Captures& captures, const StageContext& context) {
  FeatureSet set{std::move(photos), {captures.cameras, {}, {}}, context, {}};
  const Guidance none;
  set.detected = DetectAll(options, {set.captures, set.photos, none}, context);
  return set;
}

// Those whose features are in a checkpoint or can be found again, by id.
std::vector<SurveyPhoto> PhotosWithFeatures(const CalibOptions& options, const FinishedModel& model,
                                            const StageContext& context) {
  std::vector<SurveyPhoto> photos = JoinPhotos(model.reconstruction, model.captures);
  std::erase_if(photos, [](const SurveyPhoto& photo) { return !photo.captured.usable; });
  const size_t gone = std::erase_if(photos, [&](const SurveyPhoto& photo) {
    std::error_code error;
    return !std::filesystem::exists(model.photos / photo.path(), error) &&
           !context.units->Load("features", FeaturesKey(options, photo.captured));
  });
  if (photos.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: the photos of the survey are not there, nor what calibration "
                            "found in them: nothing new photos could be compared with",
                            model.photos.string()),
                "put the survey's photos back, or its folder .stucco/units/calib");
  }
  if (gone > 0) {
    context.progress->Warn(fmt::format(
        "{} of the survey's photos are gone, and what calibration found in them: new photos are "
        "compared with the other {}",
        gone, photos.size()));
  }
  return photos;
}

// By camera of the new photos: as the model knows it, else as its metadata say.
std::vector<SceneCamera> CamerasFor(const CalibOptions& options, const FinishedModel& model,
                                    const std::vector<SurveyPhoto>& photos,
                                    const Captures& captures) {
  std::map<std::string, const Camera*> known;
  for (const SurveyPhoto& photo : photos) {
    known.try_emplace(model.captures.cameras[photo.captured.camera].key, &photo.camera);
  }
  const CameraModel wished =
      CameraModelFromName(options.camera_model).value_or(CameraModel::kOpenCv);
  std::vector<SceneCamera> cameras;
  for (const CapturedCamera& captured : captures.cameras) {
    SceneCamera& camera = cameras.emplace_back();
    camera.focal_sigma_ratio = FocalSigmaRatio(captured);
    const auto calibrated = known.find(captured.key);
    if (calibrated == known.end()) {
      camera.intrinsics = AsModel(captured.intrinsics, wished);
    } else {
      const bool full = calibrated->second->model == CameraModel::kFullOpenCv;
      camera.intrinsics =
          AsModel(*calibrated->second, full ? CameraModel::kFullOpenCv : CameraModel::kOpenCv);
      // Without metadata cameras of one size look the same: a beginning, no more.
      if (camera.focal_sigma_ratio < kGuessedFocal) camera.focal_sigma_ratio = 0;
    }
    camera.prior = camera.intrinsics;
  }
  return cameras;
}

// Indices of the `count` largest values, the first among equals; ascending.
std::vector<int> Largest(const std::vector<double>& values, size_t count) {
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater{}, [&](int i) { return values[i]; });
  order.resize(std::min(order.size(), count));
  return order;
}

// By new photo: the photos of the model to match it with.
std::vector<std::vector<int>> ChooseModelPhotos(const CalibOptions& options,
                                                const FeatureSet& model, const FeatureSet& added,
                                                int threads) {
  const size_t num_model = model.photos.size();
  std::vector<std::vector<int>> chosen(added.photos.size());
  if (num_model <= kMatchAll) {
    for (std::vector<int>& photos : chosen) {
      photos.resize(num_model);
      std::iota(photos.begin(), photos.end(), 0);
    }
    return chosen;
  }
  std::vector<const CapturedPhoto*> all = model.photos;
  all.insert(all.end(), added.photos.begin(), added.photos.end());
  const auto positions = RoughPositions(all);
  const auto signatures = Signatures(
      static_cast<int>(all.size()),
      [&](int i) {
        const int of_model = static_cast<int>(num_model);
        return i < of_model ? FeaturesOf(options, model, i)
                            : FeaturesOf(options, added, i - of_model);
      },
      threads);
  for (size_t i = 0; i < chosen.size(); ++i) {
    std::vector<double> alike;
    std::vector<double> nearness;
    for (size_t m = 0; m < num_model; ++m) {
      const std::vector<float>& own = signatures[num_model + i];
      alike.push_back(std::inner_product(own.begin(), own.end(), signatures[m].begin(), 0.0));
      if (positions[m] && positions[num_model + i]) {
        nearness.push_back(-(*positions[m] - *positions[num_model + i]).norm());
      }
    }
    std::set<int> photos;
    for (const int m : Largest(alike, kMostAlike)) photos.insert(m);
    if (nearness.size() == num_model) {
      for (const int m : Largest(nearness, kNearest)) photos.insert(m);
    }
    chosen[i].assign(photos.begin(), photos.end());
  }
  return chosen;
}

// What one photo of the model says of a new one.
struct PairMatches {
  bool verified = false;
  std::vector<PointVote> votes;
};

std::vector<Eigen::Vector2d> PixelsOf(const Features& features) {
  std::vector<Eigen::Vector2d> pixels;
  for (const Keypoint& k : features.keypoints) pixels.emplace_back(k.x, k.y);
  return pixels;
}

// All that localising works with.
struct Work {
  const CalibOptions& options;
  const FinishedModel& model;
  const std::vector<SurveyPhoto>& model_photos;
  const FeatureSet& old;
  const FeatureSet& added;
  const std::vector<SceneCamera>& cameras;  // of the new photos
};

PairMatches MatchPair(const Work& work, int added, int old) {
  const Features first = FeaturesOf(work.options, work.added, added);
  const Features second = FeaturesOf(work.options, work.old, old);
  const CapturedPhoto& photo = *work.added.photos[added];
  const SurveyPhoto& of_model = work.model_photos[old];
  const double old_scale = DetectionScale(work.options, *work.old.photos[old]);
  VerifyOptions verify;
  verify.max_error_px = 4 * std::max(DetectionScale(work.options, photo), old_scale);
  const SceneCamera& camera = work.cameras[photo.camera];
  if (camera.focal_sigma_ratio < kGuessedFocal) {
    verify.cameras = PairCameras{camera.intrinsics, of_model.camera, camera.focal_sigma_ratio};
  }
  const std::vector<Match> matches =
      MatchDescriptors(UnitDescriptors(first), UnitDescriptors(second), work.options.match_ratio);
  const auto pair = VerifyPair(PixelsOf(first), PixelsOf(second), matches, verify);
  if (!pair) return {};
  const std::vector<PointId> points = PointsOfKeypoints(
      second.keypoints, work.model.reconstruction.photos.at(of_model.id), old_scale);
  PairMatches result{true, {}};
  for (const Match& match : pair->inliers) {
    if (points[match.second].IsValid()) {
      result.votes.push_back({match.first, points[match.second]});
    }
  }
  return result;
}

// The new photos with what they seem to show of the model's points.
Scene MakeSceneOf(const Work& work, const std::vector<std::vector<PointVote>>& shown) {
  Scene scene;
  scene.cameras = work.cameras;
  std::map<PointId, std::vector<SceneElement>> elements;
  for (size_t i = 0; i < shown.size(); ++i) {
    ScenePhoto& photo = scene.photos.emplace_back();
    const CapturedPhoto& captured = *work.added.photos[i];
    photo.name = captured.path;
    photo.camera = captured.camera;
    photo.keypoints = PixelsOf(work.added.detected.plain[i]);
    photo.keypoint_sigma_px = DetectionScale(work.options, captured);
    for (const Keypoint& k : work.added.detected.plain[i].keypoints) {
      photo.blobs_px.push_back(k.scale);
    }
    for (const auto& [keypoint, point] : shown[i]) {
      elements[point].push_back({static_cast<int>(i), keypoint, false});
    }
  }
  for (auto& [point, seen_by] : elements) {
    scene.tracks.push_back(
        {std::move(seen_by), work.model.reconstruction.points.at(point).position});
  }
  IndexTracks(scene);
  return scene;
}

std::vector<const CapturedPhoto*> UsableOf(const Captures& captures) {
  std::vector<const CapturedPhoto*> usable;
  for (const CapturedPhoto& photo : captures.photos) {
    if (photo.usable) usable.push_back(&photo);
  }
  return usable;
}

// What is known before any is placed.
std::vector<EpochPhoto> DescribePhotos(const Captures& captures) {
  std::vector<EpochPhoto> photos;
  for (const CapturedPhoto& captured : captures.photos) {
    EpochPhoto& photo = photos.emplace_back();
    photo.path = captured.path;
    photo.hash = captured.hash;
    photo.why = captured.why;
  }
  return photos;
}

void WriteOutcome(const PlacedPhoto& placed, EpochPhoto& photo) {
  photo.why = placed.why;
  photo.points = placed.num_points;
  photo.inliers = placed.num_inliers;
  photo.position_sigma = placed.sigma.position;
  photo.picture_sigma_px = placed.sigma.picture_px;
}

}  // namespace

std::vector<EpochPhoto> LocalisePhotos(const CalibOptions& options, const FinishedModel& model,
                                       const Captures& captures, const StageContext& context) {
  const std::vector<SurveyPhoto> model_photos = PhotosWithFeatures(options, model, context);
  std::vector<const CapturedPhoto*> captured;
  captured.reserve(model_photos.size());
  for (const SurveyPhoto& photo : model_photos) captured.push_back(&photo.captured);
  StageContext of_model = context;
  of_model.photos = model.photos;
  const FeatureSet old = Detect(options, std::move(captured), model.captures, of_model);
  const FeatureSet added = Detect(options, UsableOf(captures), captures, context);
  const std::vector<SceneCamera> cameras = CamerasFor(options, model, model_photos, captures);
  const Work work{options, model, model_photos, old, added, cameras};

  std::vector<std::pair<int, int>> pairs;
  const auto chosen = ChooseModelPhotos(options, old, added, context.threads);
  for (size_t i = 0; i < chosen.size(); ++i) {
    for (const int m : chosen[i]) pairs.emplace_back(static_cast<int>(i), m);
  }
  std::vector<PairMatches> matches(pairs.size());
  context.progress->Begin("comparing with the survey's photos", pairs.size());
  ParallelFor(pairs.size(), context.threads, [&](size_t i) {
    context.ThrowIfCancelled();
    matches[i] = MatchPair(work, pairs[i].first, pairs[i].second);
    context.progress->Advance();
  });
  std::vector<std::vector<PointVote>> votes(added.photos.size());
  std::vector<int> matched(added.photos.size(), 0);
  for (size_t i = 0; i < pairs.size(); ++i) {
    std::vector<PointVote>& of_photo = votes[pairs[i].first];
    of_photo.insert(of_photo.end(), matches[i].votes.begin(), matches[i].votes.end());
    matched[pairs[i].first] += matches[i].verified;
  }
  for (std::vector<PointVote>& of_photo : votes) of_photo = MostVoted(of_photo);

  Scene scene = MakeSceneOf(work, votes);
  const std::vector<PlacedPhoto> placed = PlaceInModel(scene);
  std::vector<EpochPhoto> localised = DescribePhotos(captures);
  for (size_t i = 0; i < placed.size(); ++i) {
    EpochPhoto& photo = localised[added.photos[i] - captures.photos.data()];
    photo.matched_photos = matched[i];
    photo.cam_from_world = scene.photos[i].pose;
    photo.camera = scene.CameraOf(static_cast<int>(i));
    WriteOutcome(placed[i], photo);
  }
  return localised;
}

}  // namespace stucco
