// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/which_bay.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "calib/features/best_two.h"
#include "calib/features/descriptors.h"

namespace stucco {
namespace {

using Eigen::Vector2d;

// How often what is as far off as a rival may be the right one.
constexpr double kRuledOut = 1e-3;
// One place in two photos differs by 0.25 to 0.35 at the median.
constexpr double kAlike_rad = 0.45;
constexpr double kUnlike_rad = 0.6;  // what counts where nothing alike is found
constexpr double kUndecided_rad = 0.08;
// Of what two bays show: keypoints that both have cannot tell which is which.
constexpr double kTwin_rad = 0.3;
constexpr double kLikeBlob = 2;
constexpr double kCell_m = 0.1;
constexpr int kSmooth_cells = 5;
// Of places that are one; relief and the keypoints' own errors.
constexpr double kSamePlace_m = 0.2;
constexpr double kOtherShift_m = 0.5;
constexpr int kMostShifts = 24;
constexpr double kScaleWeight = 10;  // square metres of keypoints
constexpr int kLeastVotes = 40;
constexpr double kAhead = 4;

// A keypoint of one of the others that looks like one of the first.
struct Like {
  Vector2d place;
  double angle_rad = 0;
  const int16_t* descriptor = nullptr;
  float scale_m = 0;
};
using Likes = std::vector<std::vector<Like>>;  // by keypoint of the first

Vector2d PlaceOf(const OnWall& at) {
  return {at.along_m, at.z_m};
}

Vector2d MiddleOf(const WallKeypoints& keypoints) {
  Vector2d sum = Vector2d::Zero();
  for (const OnWall& at : keypoints.places) sum += PlaceOf(at);
  return sum / std::max(1.0, static_cast<double>(keypoints.places.size()));
}

// What the others show, ready to be looked up by place.
class ShownByOthers {
 public:
  explicit ShownByOthers(const std::vector<const WallKeypoints*>& others) : others_(others) {
    columns_.reserve(others.size());
    for (const WallKeypoints* other : others) columns_.push_back(SortAlong(*other));
  }

  // Those of like size within the reach, along the wall and up.
  void FindLike(const int16_t* descriptor, const OnWall& about, double reach_m,
                std::vector<Like>& likes) const {
    std::vector<int32_t> products;
    for (size_t o = 0; o < others_.size(); ++o) {
      const AlongOrder& columns = columns_[o];
      const auto column = [&](double at) {
        return std::ranges::lower_bound(columns.along_m, at) - columns.along_m.begin();
      };
      const auto begin = column(about.along_m - reach_m);
      const auto end = column(about.along_m + reach_m);
      products.resize(end - begin);
      const int16_t* rows = columns.descriptors.data() + begin * kDescriptorSize;
      DotProducts(descriptor, rows, static_cast<int>(end - begin), products.data());
      for (auto c = begin; c < end; ++c) {
        const OnWall& there = others_[o]->places[columns.index[c]];
        const double size = there.scale_m / about.scale_m;
        if (std::abs(there.z_m - about.z_m) > reach_m || size > kLikeBlob || size * kLikeBlob < 1)
          continue;
        const double angle = DescriptorAngle(products[c - begin]);
        if (angle >= kAlike_rad) continue;
        likes.push_back(
            {PlaceOf(there), angle, rows + (c - begin) * kDescriptorSize, there.scale_m});
      }
    }
  }

  // Whether they show the same there as what is elsewhere.
  bool ShowTwin(const Like& elsewhere, const Vector2d& place) const {
    std::vector<Like> likes;
    FindLike(elsewhere.descriptor,
             {static_cast<float>(place.x()), static_cast<float>(place.y()), elsewhere.scale_m},
             kSamePlace_m, likes);
    return std::ranges::any_of(likes, [](const Like& each) { return each.angle_rad < kTwin_rad; });
  }

 private:
  const std::vector<const WallKeypoints*>& others_;
  std::vector<AlongOrder> columns_;
};

// The most alike of those near a place.
const Like* BestNear(const std::vector<Like>& likes, const Vector2d& place, double near_m) {
  const Like* best = nullptr;
  for (const Like& like : likes) {
    if ((like.place - place).norm() > near_m) continue;
    if (best == nullptr || like.angle_rad < best->angle_rad) best = &like;
  }
  return best;
}

// Votes for shifts on the wall.
class ShiftVotes {
 public:
  explicit ShiftVotes(double reach_m)
      : half_(static_cast<int>(std::ceil(reach_m / kCell_m))),
        votes_(2 * half_ + 1, 2 * half_ + 1, CV_32F, cv::Scalar(0)) {}

  void Add(const Vector2d& shift) {
    const cv::Point cell = CellOf(shift);
    if (cv::Rect(0, 0, votes_.cols, votes_.rows).contains(cell)) votes_.at<float>(cell) += 1;
  }
  void Smooth() {
    cv::boxFilter(votes_, votes_, -1, {kSmooth_cells, kSmooth_cells}, {-1, -1}, false,
                  cv::BORDER_CONSTANT);
  }
  std::optional<Vector2d> Most() const {
    double votes = 0;
    cv::Point cell;
    cv::minMaxLoc(votes_, nullptr, &votes, nullptr, &cell);
    if (votes <= 0) return std::nullopt;
    return kCell_m * Vector2d(cell.x - half_, cell.y - half_);
  }
  // All about there.
  void Forget(const Vector2d& shift) {
    cv::circle(votes_, CellOf(shift), static_cast<int>(kOtherShift_m / kCell_m), cv::Scalar(0),
               cv::FILLED);
  }

 private:
  cv::Point CellOf(const Vector2d& shift) const {
    return {static_cast<int>(std::lround(shift.x() / kCell_m)) + half_,
            static_cast<int>(std::lround(shift.y() / kCell_m)) + half_};
  }

  int half_;
  cv::Mat votes_;
};

// Least squares over what is near its like: shift and scale, held to the start's by some keypoints'
// weight. A pose that is off by a hand before a wall draws it larger or smaller by a hundredth or
// two; angles are known far better than places.
WallFromWall Fit(const BayQuestion& question, const Likes& likes, const Vector2d& shift) {
  const Vector2d middle = MiddleOf(question.first);
  double scale = 1;
  Vector2d moved = middle + shift;
  for (const double near_m : {0.5, 0.5, 0.4, 0.3, 0.2, 0.2}) {
    Eigen::Matrix3d normals = Eigen::Vector3d(kScaleWeight, 1e-3, 1e-3).asDiagonal();
    Eigen::Vector3d right(kScaleWeight, 1e-3 * moved.x(), 1e-3 * moved.y());
    for (size_t i = 0; i < likes.size(); ++i) {
      const Vector2d at = PlaceOf(question.first.places[i]) - middle;
      const Vector2d place = scale * at + moved;
      const Like* like = BestNear(likes[i], place, near_m);
      if (like == nullptr) continue;
      const double weight =
          1 / (1 + (like->place - place).squaredNorm() / (kSamePlace_m * kSamePlace_m / 4));
      for (const int axis : {0, 1}) {
        Eigen::Vector3d row(at[axis], 0, 0);
        row[axis + 1] = 1;
        normals += weight * row * row.transpose();
        right += weight * like->place[axis] * row;
      }
    }
    const Eigen::Vector3d solved = normals.ldlt().solve(right);
    scale = solved[0];
    moved = solved.tail<2>();
  }
  WallFromWall fitted;
  fitted << scale, 0, moved.x() - scale * middle.x(), 0, scale, moved.y() - scale * middle.y();
  return fitted;
}

// What a shift makes of the first photo's keypoints.
struct BayShift {
  WallFromWall from;
  Vector2d shift = Vector2d::Zero();  // of those that have their like there, the mean
  std::vector<Vector2d> places;       // by keypoint
  std::vector<const Like*> likes;     // by keypoint, of Likes; null: none
  std::vector<bool> shown;            // by keypoint: whether the others show its place
  int alike = 0;
};

BayShift Judge(const BayQuestion& question, const Likes& likes, const WallFromWall& from) {
  BayShift judged{from, Vector2d::Zero(), {}, {}, {}, 0};
  judged.places.reserve(likes.size());
  judged.likes.reserve(likes.size());
  judged.shown.reserve(likes.size());
  for (size_t i = 0; i < likes.size(); ++i) {
    const Vector2d at = PlaceOf(question.first.places[i]);
    const Vector2d place = from * at.homogeneous();
    const Like* like = BestNear(likes[i], place, kSamePlace_m);
    judged.places.push_back(place);
    judged.likes.push_back(like);
    judged.shown.push_back(question.others_show(place));
    if (like == nullptr) continue;
    ++judged.alike;
    judged.shift += place - at;
  }
  judged.shift /= std::max(1, judged.alike);
  return judged;
}

// In standard deviations.
double OffBy(const BayQuestion& question, const Vector2d& shift) {
  return shift.cwiseQuotient(question.sigma_m).norm();
}

// Of the farthest that what is told may have to be held against.
double RivalSigmas() {
  return std::sqrt(kReachSigmas * kReachSigmas - 2 * std::log(kRuledOut));
}

// All that many keypoints have their like at, about where the poses put these.
std::vector<BayShift> FindShifts(const BayQuestion& question, const Likes& likes, double reach_m) {
  ShiftVotes votes(reach_m);
  for (size_t i = 0; i < likes.size(); ++i) {
    for (const Like& like : likes[i]) votes.Add(like.place - PlaceOf(question.first.places[i]));
  }
  votes.Smooth();
  std::vector<BayShift> shifts;
  for (int i = 0; i < kMostShifts; ++i) {
    const auto most = votes.Most();
    if (!most) break;
    votes.Forget(*most);
    BayShift found = Judge(question, likes, Fit(question, likes, *most));
    // From near by the fit may come to the same shift.
    const bool same = std::ranges::any_of(shifts, [&](const BayShift& each) {
      return (each.shift - found.shift).norm() < kOtherShift_m;
    });
    if (!same && found.alike >= kLeastVotes / 2 && OffBy(question, found.shift) < RivalSigmas())
      shifts.push_back(std::move(found));
  }
  return shifts;
}

// Keypoints that side with one of two shifts.
struct Sides {
  int ahead = 0;
  int behind = 0;
};

double AngleOf(const Like* like) {
  return like != nullptr ? like->angle_rad : kUnlike_rad;
}

Sides Compare(const ShownByOthers& others, const BayShift& one, const BayShift& other) {
  Sides sides;
  for (size_t i = 0; i < one.likes.size(); ++i) {
    if (!one.shown[i] || !other.shown[i]) continue;
    const double nearer = AngleOf(other.likes[i]) - AngleOf(one.likes[i]);
    if (std::abs(nearer) <= kUndecided_rad) continue;
    const bool ahead = nearer > 0;
    if (others.ShowTwin(*(ahead ? one : other).likes[i], (ahead ? other : one).places[i])) continue;
    ++(ahead ? sides.ahead : sides.behind);
  }
  return sides;
}

// How much of what is asked of keypoints the poses leave to them: nothing where they rule the rival
// out by themselves.
double LeftToKeypoints(const BayQuestion& question, const BayShift& best, const BayShift& rival) {
  const double log_odds =
      (std::pow(OffBy(question, rival.shift), 2) - std::pow(OffBy(question, best.shift), 2)) / 2;
  return std::clamp(1 + log_odds / std::log(kRuledOut), 0.0, 1.0);
}

}  // namespace

std::optional<ToldBay> TellBay(const BayQuestion& question) {
  const double reach_m = RivalSigmas() * question.sigma_m.maxCoeff();
  const ShownByOthers others(question.others);
  Likes likes(question.first.places.size());
  for (size_t i = 0; i < likes.size(); ++i) {
    others.FindLike(question.first.descriptors.data() + i * kDescriptorSize,
                    question.first.places[i], reach_m + kOtherShift_m, likes[i]);
  }
  const std::vector<BayShift> shifts = FindShifts(question, likes, reach_m);
  const BayShift* best = nullptr;
  for (const BayShift& each : shifts) {
    if (OffBy(question, each.shift) > kReachSigmas) continue;
    if (best != nullptr) {
      const Sides sides = Compare(others, each, *best);
      if (sides.ahead <= sides.behind) continue;
    }
    best = &each;
  }
  if (best == nullptr || best->alike < kLeastVotes) return std::nullopt;
  ToldBay told{best->from, std::numeric_limits<double>::infinity()};
  for (const BayShift& rival : shifts) {
    if (&rival == best) continue;
    const double left = LeftToKeypoints(question, *best, rival);
    if (left == 0) continue;
    const Sides sides = Compare(others, *best, rival);
    if (sides.ahead < left * kLeastVotes) return std::nullopt;
    const double odds = sides.ahead / std::max(1.0, static_cast<double>(sides.behind));
    told.sureness = std::min(told.sureness, std::log(odds) / (left * std::log(kAhead)));
  }
  return told.sureness >= 1 ? std::optional(told) : std::nullopt;
}

}  // namespace stucco
