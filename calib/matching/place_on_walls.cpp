// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/place_on_walls.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <numeric>

#include "calib/matching/which_bay.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

// Of a photo that was placed on a wall, per axis.
constexpr double kPlacedSigma_m = 0.15;
// Walls at the edge of a photo show too little to place it by: these have as much of what the wall
// that fills it has.
constexpr double kOfMost = 0.5;
// Sixteen to one where four are asked for: no need to wait for more.
constexpr double kSure = 2;
constexpr double kOfSurest = 0.75;
// A wall in as many steps at the most: each goes on by half a photo or so.
constexpr int kMostSteps = 40;

struct Range {
  double from_m = std::numeric_limits<double>::infinity();
  double to_m = -std::numeric_limits<double>::infinity();
};

Range AlongOf(const WallKeypoints& keypoints) {
  Range range;
  for (const OnWall& at : keypoints.places) {
    range.from_m = std::min<double>(range.from_m, at.along_m);
    range.to_m = std::max<double>(range.to_m, at.along_m);
  }
  return range;
}

class Placing {
 public:
  explicit Placing(const AgainInput& input)
      : set_(input.set),
        context_(input.context),
        poses_(input.poses),
        input_{input.options, input.set, input.features, input.repeating, poses_, input.context},
        shown_(poses_.size()),
        asked_(poses_.size()) {}

  std::vector<std::optional<KnownPose>> Run() {
    std::vector<int> all(poses_.size());
    std::iota(all.begin(), all.end(), 0);
    Look(all);
    std::vector<int> open = all;
    std::erase_if(open, [&](int i) { return shown_[i].empty() || !poses_[i]->is_recorded; });
    for (int step = 0; step < kMostSteps && !open.empty(); ++step) {
      const std::vector<int> placed = PlaceSurest(open);
      if (placed.empty()) break;
      Look(placed);
      std::erase_if(open, [&](int i) { return std::ranges::binary_search(placed, i); });
    }
    return poses_;
  }

 private:
  void Look(const std::vector<int>& photos) {
    ParallelFor(photos.size(), context_.threads,
                [&](size_t k) { shown_[photos[k]] = ShowWalls(input_, photos[k]); });
  }

  struct Place {
    Pose cam_from_plan;
    double sureness = 1;
  };
  // Which bay of a wall a photo shows.
  struct Question {
    int wall = 0;
    Eigen::Vector2d sigma_m = Eigen::Vector2d::Zero();
    std::vector<int> others;
  };
  struct Asked {
    size_t num_others = 0;
    std::optional<Place> place;
  };

  // Those that could be placed most surely, ascending: the others are asked again once these show
  // the wall too, from where they do, which may be the right side.
  std::vector<int> PlaceSurest(const std::vector<int>& open) {
    std::vector<std::optional<Place>> told(open.size());
    ParallelFor(open.size(), context_.threads, [&](size_t k) {
      context_.ThrowIfCancelled();
      told[k] = FindPlace(open[k]);
    });
    double surest = 0;
    for (const auto& place : told) {
      if (place) surest = std::max(surest, std::min(kSure, place->sureness));
    }
    std::vector<int> placed;
    for (size_t k = 0; k < open.size(); ++k) {
      if (!told[k] || told[k]->sureness < kOfSurest * surest) continue;
      KnownPose& known = *poses_[open[k]];
      known = {told[k]->cam_from_plan, {kPlacedSigma_m, kPlacedSigma_m}, known.sigma_rad, false};
      placed.push_back(open[k]);
    }
    return placed;
  }

  // Asks again only where others have come since: these stay where they are.
  std::optional<Place> FindPlace(int photo) {
    size_t most = 0;
    for (const auto& [wall, shown] : shown_[photo]) most = std::max(most, shown.of_photo.size());
    std::vector<Question> questions;
    size_t num_others = 0;
    for (const auto& [wall, shown] : shown_[photo]) {
      if (shown.of_photo.size() < kOfMost * most) continue;
      questions.push_back(AskOn(photo, wall, shown));
      num_others += questions.back().others.size();
    }
    if (num_others != asked_[photo].num_others) {
      asked_[photo] = {num_others, Answer(photo, questions)};
    }
    return asked_[photo].place;
  }

  std::optional<Place> Answer(int photo, const std::vector<Question>& questions) const {
    for (const Question& question : questions) {
      if (question.others.empty()) continue;
      if (const auto told = TellOn(photo, question)) {
        return Place{Moved(photo, question.wall, told->from), told->sureness};
      }
    }
    return std::nullopt;
  }

  Question AskOn(int photo, int wall, const Shown& shown) const {
    const Eigen::Vector2d sigma_m =
        (PlaceVariances(*poses_[photo], shown.distance_m).array() + kOffWall_m * kOffWall_m).sqrt();
    return {wall, sigma_m, OthersOn(wall, shown, sigma_m[0])};
  }

  std::optional<ToldBay> TellOn(int photo, const Question& question) const {
    const auto& [wall, sigma_m, others] = question;
    BayQuestion bay{shown_[photo].at(wall).on_wall, {}, sigma_m, [&](const Eigen::Vector2d& place) {
                      return std::ranges::any_of(question.others, [&](int other) {
                        return ShowsPlace(input_, other, question.wall, place);
                      });
                    }};
    bay.others.reserve(others.size());
    for (const int other : others) bay.others.push_back(&shown_[other].at(wall).on_wall);
    return TellBay(bay);
  }

  // Photos whose poses are sure, of the same stretch.
  std::vector<int> OthersOn(int wall, const Shown& shown, double sigma_m) const {
    const Range own = AlongOf(shown.on_wall);
    std::vector<int> others;
    for (int i = 0; i < static_cast<int>(shown_.size()); ++i) {
      const auto found = shown_[i].find(wall);
      if (found == shown_[i].end() || poses_[i]->is_recorded) continue;
      const Range range = AlongOf(found->second.on_wall);
      if (range.from_m < own.to_m + sigma_m && range.to_m > own.from_m - sigma_m) {
        others.push_back(i);
      }
    }
    return others;
  }

  // The pose, with the same angles, that puts what the photo shows where it was told to be: places
  // scale about the foot of the camera on the wall as its distance does.
  Pose Moved(int photo, int wall, const WallFromWall& told) const {
    const PlannedFacade& facade = set_.guidance.facades[wall];
    const Pose& pose = poses_[photo]->cam_from_plan;
    const Eigen::Vector3d center = pose.Center();
    const Eigen::Vector2d from_a = center.head<2>() - facade.a_m;
    const Eigen::Vector3d foot(from_a.dot(facade.along()), center.z(), 1);
    const Eigen::Vector2d moved = told * foot;
    const Eigen::Vector2d level = facade.a_m + moved.x() * facade.along() +
                                  told(0, 0) * from_a.dot(facade.outwards()) * facade.outwards();
    return {pose.rotation, -(pose.rotation * Eigen::Vector3d(level.x(), level.y(), moved.y()))};
  }

  const PhotoSet& set_;
  const StageContext& context_;
  std::vector<std::optional<KnownPose>> poses_;
  const AgainInput input_;
  std::vector<ShownWalls> shown_;  // by photo
  std::vector<Asked> asked_;       // by photo
};

}  // namespace

std::vector<std::optional<KnownPose>> PlaceOnWalls(const AgainInput& input) {
  return Placing(input).Run();
}

}  // namespace stucco
