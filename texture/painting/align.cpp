// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/align.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "survey/median.h"

namespace stucco {
namespace {

constexpr int kPatchRadius = 10;  // of the correlated window, texels
constexpr int kSpotsAcross = 24;  // corners sought along the longer side
constexpr double kLeastCorrelation = 0.75;
constexpr double kBackTolerance_px = 0.75;  // forward and backward match must agree
constexpr double kLeastContrast = 4;  // standard deviation of a window worth matching, grey levels
constexpr size_t kFewestMatches = 8;
constexpr double kMatchSigma_px = 0.3;
constexpr int kRounds = 10;
constexpr double kHeld = 1e12;  // weight of a term that stays zero

cv::Rect AreaOf(const GreyPicture& picture) {
  return {picture.x, picture.y, picture.width, picture.height};
}

// The part of a picture's layer that lies in `area` of the raster.
cv::Mat Part(const std::vector<uint8_t>& layer, const GreyPicture& picture, const cv::Rect& area) {
  const cv::Mat whole(picture.height, picture.width, CV_8UC1, const_cast<uint8_t*>(layer.data()));
  return whole(area - cv::Point(picture.x, picture.y));
}

// The smallest rectangle around what a picture shows.
GridArea ShownArea(const GreyPicture& picture) {
  if (picture.valid.empty()) return {};
  const cv::Rect shown = cv::boundingRect(Part(picture.valid, picture, AreaOf(picture)));
  const Eigen::Vector2d low(picture.x + shown.x, picture.y + shown.y);
  return {low, low + Eigen::Vector2d(shown.width, shown.height)};
}

// Vertex of the parabola through three values at -1, 0, 1.
double Peak(double left, double middle, double right) {
  const double bend = left - 2 * middle + right;
  return bend < 0 ? std::clamp(0.5 * (left - right) / bend, -0.5, 0.5) : 0.0;
}

// What one picture shows of the area that it has in common with another.
struct Overlap {
  cv::Mat grey;
  cv::Mat valid;
};

// Where the window around `at` of one picture is in another, searched around `around`.
std::optional<Eigen::Vector2d> FindWindow(const cv::Mat& from, const Overlap& to,
                                          const cv::Point& at, const cv::Point& around, int reach) {
  const int size = 2 * kPatchRadius + 1;
  const cv::Rect bounds(0, 0, to.grey.cols, to.grey.rows);
  const cv::Rect window(at.x - kPatchRadius, at.y - kPatchRadius, size, size);
  const cv::Rect search(around.x - kPatchRadius - reach, around.y - kPatchRadius - reach,
                        size + 2 * reach, size + 2 * reach);
  const cv::Rect clipped = search & bounds;
  if ((window & bounds) != window || clipped.width < size || clipped.height < size) {
    return std::nullopt;
  }
  cv::Mat score;
  cv::matchTemplate(to.grey(clipped), from(window), score, cv::TM_CCOEFF_NORMED);
  double best = 0;
  cv::Point place;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &place);
  if (!(best >= kLeastCorrelation)) return std::nullopt;
  // A maximum on the rim may go on outside.
  if (place.x == 0 || place.y == 0 || place.x == score.cols - 1 || place.y == score.rows - 1) {
    return std::nullopt;
  }
  const cv::Rect found(clipped.x + place.x, clipped.y + place.y, size, size);
  if (cv::countNonZero(to.valid(found)) < size * size) return std::nullopt;
  const float* row = score.ptr<float>(place.y) + place.x;
  const double dx = Peak(row[-1], row[0], row[1]);
  const double dy =
      Peak(score.at<float>(place.y - 1, place.x), row[0], score.at<float>(place.y + 1, place.x));
  return Eigen::Vector2d(found.x + kPatchRadius + dx, found.y + kPatchRadius + dy);
}

// The strongest corner of every square of a grid over the picture whose window is valid in both.
std::vector<cv::Point> FindSpots(const cv::Mat& grey, const cv::Mat& both_valid) {
  cv::Mat usable;
  cv::erode(both_valid, usable, cv::Mat::ones(2 * kPatchRadius + 1, 2 * kPatchRadius + 1, CV_8UC1),
            cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::Mat strength;
  cv::cornerMinEigenVal(grey, strength, 5);
  const int square =
      std::max(kPatchRadius, (std::max(grey.cols, grey.rows) + kSpotsAcross - 1) / kSpotsAcross);
  std::vector<cv::Point> spots;
  for (int y = 0; y < grey.rows; y += square) {
    for (int x = 0; x < grey.cols; x += square) {
      const cv::Rect area = cv::Rect(x, y, square, square) & cv::Rect(0, 0, grey.cols, grey.rows);
      double best = 0;
      cv::Point place(-1, -1);
      cv::minMaxLoc(strength(area), nullptr, &best, nullptr, &place, usable(area));
      if (place.x < 0 || !(best > 0)) continue;
      const cv::Point spot = place + area.tl();
      cv::Scalar mean;
      cv::Scalar deviation;
      cv::meanStdDev(grey(cv::Rect(spot.x - kPatchRadius, spot.y - kPatchRadius,
                                   2 * kPatchRadius + 1, 2 * kPatchRadius + 1)),
                     mean, deviation);
      if (deviation[0] >= kLeastContrast) spots.push_back(spot);
    }
  }
  return spots;
}

// The rows of GridShift::At for a place: shift = basis * terms.
Eigen::Matrix<double, 2, 8> Basis(const GridShift& frame, const Eigen::Vector2d& x) {
  const Eigen::Vector2d q = (x - frame.center) / frame.radius;
  Eigen::Matrix<double, 2, 8> basis;
  basis.row(0) << 1, 0, q.x(), q.y(), 0, 0, q.x() * q.x(), q.x() * q.y();
  basis.row(1) << 0, 1, 0, 0, q.x(), q.y(), q.x() * q.y(), q.y() * q.y();
  return basis;
}

Eigen::Vector2d Residual(const GridMatch& match, std::span<const GridShift> shifts) {
  const Eigen::Vector2d place = (match.in_a + match.in_b) / 2;
  return match.in_a - match.in_b - (shifts[match.a].At(place) - shifts[match.b].At(place));
}

double MedianResidual(std::span<const GridMatch> matches, std::span<const GridShift> shifts) {
  std::vector<double> lengths;
  for (const GridMatch& match : matches) lengths.push_back(Residual(match, shifts).norm());
  return Median(std::move(lengths)).value_or(-1);
}

// Prior deviations of the terms, from the largest shift that is believed.
Eigen::Matrix<double, 8, 1> PriorSigma(double limit_px) {
  Eigen::Matrix<double, 8, 1> sigma;
  sigma << limit_px / 2, limit_px / 2, limit_px / 3, limit_px / 3, limit_px / 3, limit_px / 3,
      limit_px / 6, limit_px / 6;
  return sigma;
}

// `terms_of` says how many terms each picture has; the others are held at zero.
std::vector<GridShift> SolveShifts(std::span<const GridMatch> matches,
                                   std::vector<GridShift> shifts, std::span<const int> terms_of,
                                   double limit_px) {
  constexpr int kTerms = 8;
  const auto count = static_cast<Eigen::Index>(shifts.size());
  const Eigen::Matrix<double, 8, 1> sigma = PriorSigma(limit_px);
  for (int round = 0; round < kRounds; ++round) {
    // The kernel's width falls from the largest shift to a texel: far starts still converge.
    const double width = std::max(1.0, limit_px * std::pow(0.6, round));
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count * kTerms, count * kTerms);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count * kTerms);
    for (Eigen::Index i = 0; i < count * kTerms; ++i) {
      const bool is_free = i % kTerms < terms_of[i / kTerms];
      normal(i, i) = is_free ? 1 / (sigma[i % kTerms] * sigma[i % kTerms]) : kHeld;
    }
    for (const GridMatch& match : matches) {
      const double length = Residual(match, shifts).norm() / width;
      const double root = 1 / (1 + length * length);
      const double weight = root * root / (kMatchSigma_px * kMatchSigma_px);
      const Eigen::Matrix<double, 2, 8> basis =
          Basis(shifts[match.a], (match.in_a + match.in_b) / 2);
      const Eigen::Vector2d wanted = match.in_a - match.in_b;
      const Eigen::Matrix<double, 8, 8> block = weight * basis.transpose() * basis;
      const Eigen::Matrix<double, 8, 1> pull = weight * basis.transpose() * wanted;
      const Eigen::Index a = match.a * kTerms;
      const Eigen::Index b = match.b * kTerms;
      normal.block(a, a, kTerms, kTerms) += block;
      normal.block(b, b, kTerms, kTerms) += block;
      normal.block(a, b, kTerms, kTerms) -= block;
      normal.block(b, a, kTerms, kTerms) -= block;
      right.segment(a, kTerms) += pull;
      right.segment(b, kTerms) -= pull;
    }
    const Eigen::VectorXd solution = normal.ldlt().solve(right);
    for (Eigen::Index i = 0; i < count; ++i) {
      shifts[i].terms.setZero();
      shifts[i].terms.head(terms_of[i]) = solution.segment(i * kTerms, terms_of[i]);
    }
  }
  return shifts;
}

double LargestShift(const GridShift& shift, const GridArea& area) {
  double largest = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector2d place(corner % 2 ? area.high.x() : area.low.x(),
                                corner / 2 ? area.high.y() : area.low.y());
    largest = std::max(largest, shift.At(place).norm());
  }
  return largest;
}

// The matches of pairs that have enough of them.
std::vector<GridMatch> BelievedMatches(std::span<const GridMatch> matches) {
  std::map<std::pair<int, int>, size_t> count;
  for (const GridMatch& match : matches) ++count[{match.a, match.b}];
  std::vector<GridMatch> believed;
  for (const GridMatch& match : matches) {
    if (count[{match.a, match.b}] >= kFewestMatches) believed.push_back(match);
  }
  return believed;
}

// The picture that moves farthest beyond the limit, -1 where none does.
int FindTooFar(std::span<const GridShift> shifts, std::span<const GridArea> areas,
               double limit_px) {
  int found = -1;
  double farthest = limit_px;
  for (size_t i = 0; i < shifts.size(); ++i) {
    const double shift = LargestShift(shifts[i], areas[i]);
    if (shift <= farthest) continue;
    farthest = shift;
    found = static_cast<int>(i);
  }
  return found;
}

// Solves for the pictures that have terms, taking them from the one that moves farthest as long as
// one moves too far.
std::vector<GridShift> SolveTogether(std::vector<GridMatch> matches,
                                     std::span<const GridArea> areas,
                                     const std::vector<GridShift>& start, double limit_px,
                                     std::vector<int>& terms) {
  while (true) {
    std::erase_if(matches, [&](const GridMatch& m) { return terms[m.a] == 0 || terms[m.b] == 0; });
    std::vector<GridShift> shifts = SolveShifts(matches, start, terms, limit_px);
    const int too_far = FindTooFar(shifts, areas, limit_px);
    if (too_far < 0) return shifts;
    terms[too_far] = 0;
  }
}

// The matches of a picture that was left out with those that have terms, whose shifts are applied.
std::vector<GridMatch> MatchesAgainst(std::span<const GridMatch> matches, int picture,
                                      std::span<const int> terms,
                                      std::span<const GridShift> shifts) {
  std::vector<GridMatch> own;
  for (GridMatch match : matches) {
    const int other = match.a == picture ? match.b : match.a;
    if ((match.a != picture && match.b != picture) || terms[other] == 0) continue;
    const Eigen::Vector2d moved = shifts[other].At((match.in_a + match.in_b) / 2);
    (match.a == other ? match.in_a : match.in_b) -= moved;
    own.push_back(match);
  }
  return own;
}

// The shift of one picture by its own matches, in six or two terms; identity where neither keeps to
// the limit. `start` are identities.
GridShift FitAlone(std::span<const GridMatch> own, int picture, const GridArea& area,
                   const std::vector<GridShift>& start, double limit_px) {
  if (own.empty()) return start[picture];
  for (int count : {6, 2}) {
    std::vector<int> terms(start.size(), 0);
    terms[picture] = count;
    const std::vector<GridShift> fitted = SolveShifts(own, start, terms, limit_px);
    if (!(LargestShift(fitted[picture], area) <= limit_px)) continue;
    if (MedianResidual(own, fitted) < MedianResidual(own, start)) return fitted[picture];
  }
  return start[picture];
}

// Shifts of `count` terms, fewer for pictures that would move too far; nothing where most pictures
// do: then it is the terms that are wrong, not the pictures. `start` are identities.
std::optional<std::vector<GridShift>> FitShifts(const std::vector<GridMatch>& matches,
                                                std::span<const GridArea> areas,
                                                const std::vector<GridShift>& start,
                                                double limit_px, int count) {
  std::vector<int> terms(areas.size(), count);
  std::vector<GridShift> shifts = SolveTogether(matches, areas, start, limit_px, terms);
  const auto left_out = std::count(terms.begin(), terms.end(), 0);
  if (2 * static_cast<size_t>(left_out) >= areas.size() && count > 2) return std::nullopt;
  for (size_t i = 0; i < areas.size(); ++i) {
    if (terms[i] != 0) continue;
    const int picture = static_cast<int>(i);
    const std::vector<GridMatch> own = MatchesAgainst(matches, picture, terms, shifts);
    shifts[i] = FitAlone(own, picture, areas[i], start, limit_px);
  }
  return shifts;
}

// The median distance of each half of the matches after the shifts that the other half asks for:
// what was fitted says nothing of how well. Each pair's matches go to the halves by turns. -1 where
// a half allows no such shifts.
double HeldOutResidual(std::span<const GridMatch> matches, std::span<const GridArea> areas,
                       const std::vector<GridShift>& start, double limit_px, int count) {
  std::vector<GridMatch> halves[2];
  std::map<std::pair<int, int>, int> count_of_pair;
  for (const GridMatch& match : matches) {
    halves[count_of_pair[{match.a, match.b}]++ % 2].push_back(match);
  }
  std::vector<double> lengths;
  for (int fitted = 0; fitted < 2; ++fitted) {
    const auto shifts = FitShifts(halves[fitted], areas, start, limit_px, count);
    if (!shifts) return -1;
    for (const GridMatch& match : halves[1 - fitted]) {
      lengths.push_back(Residual(match, *shifts).norm());
    }
  }
  return Median(std::move(lengths)).value_or(-1);
}

}  // namespace

std::vector<GridMatch> MatchPictures(std::span<const GreyPicture> pictures, int a, int b,
                                     int reach) {
  const cv::Rect common = AreaOf(pictures[a]) & AreaOf(pictures[b]);
  if (common.empty()) return {};
  const Overlap in_a{Part(pictures[a].grey, pictures[a], common),
                     Part(pictures[a].valid, pictures[a], common)};
  const Overlap in_b{Part(pictures[b].grey, pictures[b], common),
                     Part(pictures[b].valid, pictures[b], common)};
  std::vector<GridMatch> matches;
  for (const cv::Point& spot : FindSpots(in_a.grey, in_a.valid & in_b.valid)) {
    const auto there = FindWindow(in_a.grey, in_b, spot, spot, reach);
    if (!there) continue;
    const cv::Point near(static_cast<int>(std::lround(there->x())),
                         static_cast<int>(std::lround(there->y())));
    const auto back = FindWindow(in_b.grey, in_a, near, spot, reach);
    if (!back) continue;
    const Eigen::Vector2d from(spot.x, spot.y);
    const Eigen::Vector2d rounding = *there - Eigen::Vector2d(near.x, near.y);
    if (!((*back + rounding - from).norm() <= kBackTolerance_px)) continue;
    // Raster positions count from the texel's corner.
    const Eigen::Vector2d first(common.x + 0.5, common.y + 0.5);
    matches.push_back({a, b, from + first, *there + first});
  }
  return matches;
}

Alignment SolveAlignment(std::span<const GridMatch> matches, std::span<const GridArea> areas,
                         const Eigen::Vector2d& raster_size, double limit_px) {
  Alignment out;
  GridShift identity;
  identity.center = raster_size / 2;
  identity.radius = std::max(1.0, raster_size.maxCoeff() / 2);
  out.shifts.assign(areas.size(), identity);
  const std::vector<GridMatch> believed = BelievedMatches(matches);
  if (believed.empty()) return out;
  out.before_px = MedianResidual(believed, out.shifts);
  out.after_px = out.before_px;
  if (!(limit_px > 0)) return out;

  for (int count : {8, 6, 2}) {
    const auto shifts = FitShifts(believed, areas, out.shifts, limit_px, count);
    if (!shifts) continue;
    const double after = HeldOutResidual(believed, areas, out.shifts, limit_px, count);
    if (!(after >= 0 && after < out.before_px)) continue;
    out.shifts = *shifts;
    out.after_px = after;
    break;
  }
  return out;
}

Alignment AlignPictures(std::span<const GreyPicture> pictures, const Eigen::Vector2d& raster_size,
                        double limit_px) {
  std::vector<GridMatch> matches;
  // Two pictures may both be off by the limit, in opposite directions.
  const int reach = std::max(4, static_cast<int>(std::ceil(2 * limit_px)) + 1);
  for (int a = 0; a < static_cast<int>(pictures.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(pictures.size()); ++b) {
      const auto pair = MatchPictures(pictures, a, b, reach);
      matches.insert(matches.end(), pair.begin(), pair.end());
    }
  }
  std::vector<GridArea> areas;
  for (const GreyPicture& picture : pictures) areas.push_back(ShownArea(picture));
  return SolveAlignment(matches, areas, raster_size, limit_px);
}

}  // namespace stucco
