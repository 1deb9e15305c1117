// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/plane_sweep.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <span>

namespace stucco {
namespace {

constexpr double kDeepest_m = 0.5;
constexpr double kHighest_m = 1.6;
constexpr double kMostPlanes = 48;
constexpr int kPhotoSide = 1600;      // photos are read this small
constexpr int kLattice = 4;           // cells between exact projections
constexpr int kCore = 3;              // cells a side, next to one
constexpr float kNoise = 16;          // grey levels squared: plain surfaces look alike anywhere
constexpr double kBestShare = 0.5;    // of the pairs at a place; something may hide it from others
constexpr float kLonePairs = 0.5f;    // pairs that agree by chance
constexpr float kPlainPairs = 0.25f;  // what a pair weighs that says nothing
constexpr float kAlong = 0.1f;        // share of slopes along the way of a pair that weighs half

// Means over the windows of a raster, cut off at its rim.
class WindowMeans {
 public:
  WindowMeans(int side, int width, int height)
      : side_(side), cells_per_window_(Sums(cv::Mat::ones(height, width, CV_32F))) {}

  cv::Mat Of(const cv::Mat& values) const { return Sums(values) / cells_per_window_; }

 private:
  cv::Mat Sums(const cv::Mat& values) const {
    cv::Mat sums;
    cv::boxFilter(values, sums, CV_32F, {side_, side_}, {-1, -1}, false, cv::BORDER_CONSTANT);
    return sums;
  }

  int side_;
  cv::Mat cells_per_window_;
};

// What a photo shows on a plane, with the moments of each window; rasters of floats.
struct Shown {
  cv::Mat grey;
  cv::Mat valid;  // bytes: whether it shows the whole window
  cv::Mat mean;
  cv::Mat variance;
  cv::Mat plain;  // bytes: Plain
  // Of the slopes of grey, products: along u, across, along v.
  std::array<cv::Mat, 3> slopes;

  // The share of a window's slopes that runs along a direction.
  float Along(const Eigen::Vector2f& way, int cell) const {
    const float uu = slopes[0].at<float>(cell);
    const float uv = slopes[1].at<float>(cell);
    const float vv = slopes[2].at<float>(cell);
    const float along =
        way.x() * way.x() * uu + 2 * way.x() * way.y() * uv + way.y() * way.y() * vv;
    return std::max(0.0f, along) / (uu + vv + kNoise);
  }
};

// Bilinear; false outside.
bool SampleGrey(const cv::Mat& grey, float x, float y, float& value) {
  if (!(x >= 0 && y >= 0 && x < static_cast<float>(grey.cols - 1) &&
        y < static_cast<float>(grey.rows - 1))) {
    return false;
  }
  const auto column = static_cast<int>(x);
  const auto row = static_cast<int>(y);
  const float s = x - static_cast<float>(column);
  const float t = y - static_cast<float>(row);
  const float* above = grey.ptr<float>(row) + column;
  const float* below = grey.ptr<float>(row + 1) + column;
  value = (1 - t) * ((1 - s) * above[0] + s * above[1]) + t * ((1 - s) * below[0] + s * below[1]);
  return true;
}

// Two photos, and the way along the raster that what one shows moves against the other's from plane
// to plane.
struct Pair {
  size_t a = 0;
  size_t b = 0;
  Eigen::Vector2f way;
  float slant = 0;  // of the squarer photo
};

// What a pair says of a cell. Edges along the way that things move look alike on any plane: there,
// a pair weighs little.
struct Vote {
  float value = 0;  // correlation times weight
  float weight = 0;
  float slant = 0;  // of the squarer photo
  Plain plain = Plain::kNot;
};

float MeanVote(std::span<const Vote> votes) {
  float sum = 0;
  float weights = kLonePairs + kPlainPairs * static_cast<float>(votes.size());
  for (const Vote& vote : votes) {
    sum += vote.value;
    weights += vote.weight;
  }
  return sum / weights;
}

// Pixels of a photo at every few cells of a plane; far outside where it does not see them.
cv::Mat ProjectLattice(const SweepPhoto& photo, const TexelGrid& plane) {
  const int columns = (plane.width + kLattice - 1) / kLattice + 1;
  const int rows = (plane.height + kLattice - 1) / kLattice + 1;
  cv::Mat out(rows, columns, CV_32FC2);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto pixel = ProjectIntoPhoto(*photo.photo, plane.At(i * kLattice, j * kLattice));
      const float nowhere = -1e6f;
      out.at<cv::Vec2f>(j, i) = pixel ? cv::Vec2f(static_cast<float>(pixel->x() * photo.scale.x()),
                                                  static_cast<float>(pixel->y() * photo.scale.y()))
                                      : cv::Vec2f(nowhere, nowhere);
    }
  }
  return out;
}

// Brings the photo onto the plane: projected exactly every few cells and between them by
// interpolation.
void Bring(const SweepPhoto& photo, const TexelGrid& plane, Shown& out) {
  const cv::Mat lattice = ProjectLattice(photo, plane);
  out.grey = cv::Mat::zeros(plane.height, plane.width, CV_32F);
  out.valid = cv::Mat::zeros(plane.height, plane.width, CV_8U);
  for (int y = 0; y < plane.height; ++y) {
    const float t = (static_cast<float>(y % kLattice) + 0.5f) / kLattice;
    for (int x = 0; x < plane.width; ++x) {
      if (!photo.sees[static_cast<size_t>(y) * plane.width + x]) continue;
      const float s = (static_cast<float>(x % kLattice) + 0.5f) / kLattice;
      const auto* above = lattice.ptr<cv::Vec2f>(y / kLattice) + x / kLattice;
      const auto* below = lattice.ptr<cv::Vec2f>(y / kLattice + 1) + x / kLattice;
      const cv::Vec2f at =
          (1 - t) * ((1 - s) * above[0] + s * above[1]) + t * ((1 - s) * below[0] + s * below[1]);
      out.valid.at<uint8_t>(y, x) =
          SampleGrey(photo.grey, at[0] - 0.5f, at[1] - 0.5f, out.grey.at<float>(y, x));
    }
  }
}

class Sweep {
 public:
  Sweep(const CellRectangle& cells, const std::vector<SweepPhoto>& photos, PlaneSweep& out)
      : cells_(cells),
        around_(WithRim(cells, out.raster)),
        part_(PartOf(out.raster, around_)),
        photos_(photos),
        means_(kSweepWindow, part_.width, part_.height),
        core_means_(kCore, part_.width, part_.height),
        out_(out) {
    PairPhotos();
  }

  void Run() {
    if (pairs_.empty()) return;
    for (int label = 0; label < out_.planes; ++label) Measure(label);
  }

 private:
  // The pairs that look from different sides.
  void PairPhotos() {
    std::vector<Eigen::Vector2d> slants;
    slants.reserve(photos_.size());
    for (const SweepPhoto& photo : photos_) slants.push_back(SlantOf(*photo.photo, part_));
    for (size_t a = 0; a < slants.size(); ++a) {
      for (size_t b = a + 1; b < slants.size(); ++b) {
        const double parallax = (slants[a] - slants[b]).norm();
        if (parallax < kLeastParallax) continue;
        pairs_.push_back({a, b, ((slants[a] - slants[b]) / parallax).cast<float>(),
                          static_cast<float>(std::min(slants[a].norm(), slants[b].norm()))});
      }
    }
  }

  Shown Show(const SweepPhoto& photo, const TexelGrid& plane) const {
    Shown out;
    Bring(photo, plane, out);
    out.mean = means_.Of(out.grey);
    const cv::Mat squares = out.grey.mul(out.grey);
    out.variance = means_.Of(squares) - out.mean.mul(out.mean);
    const cv::Mat core_mean = core_means_.Of(out.grey);
    const cv::Mat core_variance = core_means_.Of(squares) - core_mean.mul(core_mean);
    out.plain = (core_variance < kNoise) & static_cast<uint8_t>(Plain::kHere);
    out.plain.setTo(static_cast<uint8_t>(Plain::kAround), out.variance < kNoise);
    const cv::Mat difference = (cv::Mat_<float>(1, 3) << -0.5f, 0, 0.5f);
    cv::Mat along_u;
    cv::Mat along_v;
    cv::filter2D(out.grey, along_u, CV_32F, difference);
    cv::filter2D(out.grey, along_v, CV_32F, difference.t());
    out.slopes = {means_.Of(along_u.mul(along_u)), means_.Of(along_u.mul(along_v)),
                  means_.Of(along_v.mul(along_v))};
    cv::erode(out.valid, out.valid, cv::Mat::ones(kSweepWindow, kSweepWindow, CV_8U));
    return out;
  }

  void Measure(int label) {
    TexelGrid plane = part_;
    plane.origin += out_.HeightOf(label) * part_.normal;
    std::vector<Shown> shown;
    shown.reserve(photos_.size());
    for (const SweepPhoto& photo : photos_) shown.push_back(Show(photo, plane));
    if (label == out_.plane) AverageGrey(shown);
    std::vector<cv::Mat> covariances;
    for (const Pair& pair : pairs_) {
      const Shown& a = shown[pair.a];
      const Shown& b = shown[pair.b];
      covariances.emplace_back(means_.Of(a.grey.mul(b.grey)) - a.mean.mul(b.mean));
    }
    std::vector<Vote> votes;
    for (int y = cells_.top; y < cells_.bottom; ++y) {
      for (int x = cells_.left; x < cells_.right; ++x) {
        const int cell = (y - around_.top) * part_.width + x - around_.left;
        votes.clear();
        for (size_t i = 0; i < pairs_.size(); ++i) {
          const Shown& a = shown[pairs_[i].a];
          const Shown& b = shown[pairs_[i].b];
          if (!a.valid.at<uint8_t>(cell) || !b.valid.at<uint8_t>(cell)) continue;
          votes.push_back(VoteOf(pairs_[i], a, b, covariances[i].at<float>(cell), cell));
        }
        if (votes.empty()) continue;
        Summarise(label, static_cast<size_t>(y) * out_.raster.width + x, votes);
      }
    }
  }

  void AverageGrey(const std::vector<Shown>& shown) {
    for (int y = cells_.top; y < cells_.bottom; ++y) {
      for (int x = cells_.left; x < cells_.right; ++x) {
        const int cell = (y - around_.top) * part_.width + x - around_.left;
        float sum = 0;
        float count = 0;
        for (const Shown& photo : shown) {
          if (!photo.valid.at<uint8_t>(cell)) continue;
          sum += photo.grey.at<float>(cell);
          count += 1;
        }
        if (count > 0) out_.grey[static_cast<size_t>(y) * out_.raster.width + x] = sum / count;
      }
    }
  }

  static Vote VoteOf(const Pair& pair, const Shown& a, const Shown& b, float covariance, int cell) {
    const float variances =
        (a.variance.at<float>(cell) + kNoise) * (b.variance.at<float>(cell) + kNoise);
    const float along = std::min(a.Along(pair.way, cell), b.Along(pair.way, cell));
    const float weight = along / (along + kAlong);
    const auto plain = Plain{std::max(a.plain.at<uint8_t>(cell), b.plain.at<uint8_t>(cell))};
    return {weight * covariance / std::sqrt(variances), weight, pair.slant, plain};
  }

  // What the pairs that show a cell say of a plane; orders them.
  void Summarise(int label, size_t cell, std::span<Vote> votes) {
    const size_t i = label * out_.raster.size() + cell;
    out_.all[i] = MeanVote(votes);
    out_.plain[i] = std::ranges::min(votes, {}, &Vote::plain).plain;
    const float squarest = std::ranges::min(votes, {}, &Vote::slant).slant;
    const auto others = std::partition(votes.begin(), votes.end(),
                                       [&](const Vote& vote) { return vote.slant == squarest; });
    out_.squarest[i] = MeanVote(votes.first(static_cast<size_t>(others - votes.begin())));
    const auto half = std::max(1L, std::lround(kBestShare * static_cast<double>(votes.size())));
    std::ranges::nth_element(votes, votes.begin() + half - 1, std::greater<>(), &Vote::value);
    out_.best[i] = MeanVote(votes.first(half));
    out_.closest[i] = std::ranges::max(votes.first(half), {}, &Vote::value).value;
    if (label == out_.plane) {
      out_.pairs[cell] = static_cast<uint8_t>(std::min<size_t>(votes.size(), 255));
    }
  }

  CellRectangle cells_;
  CellRectangle around_;
  TexelGrid part_;
  const std::vector<SweepPhoto>& photos_;
  std::vector<Pair> pairs_;
  WindowMeans means_;
  WindowMeans core_means_;
  PlaneSweep& out_;
};

}  // namespace

Eigen::Vector2d SlantOf(const SurveyPhoto& photo, const TexelGrid& raster) {
  const Eigen::Vector3d way =
      photo.cam_from_world.Center() - raster.At(raster.width / 2.0, raster.height / 2.0);
  return Eigen::Vector2d(way.dot(raster.u_axis), way.dot(raster.v_axis)) / way.dot(raster.normal);
}

double LargestParallax(std::span<const Eigen::Vector2d> slants) {
  double largest = 0;
  for (size_t a = 0; a < slants.size(); ++a) {
    for (size_t b = a + 1; b < slants.size(); ++b) {
      const double parallax = (slants[a] - slants[b]).norm();
      if (parallax >= kLeastParallax) largest = std::max(largest, parallax);
    }
  }
  return largest;
}

CellRectangle WithRim(const CellRectangle& cells, const TexelGrid& raster) {
  // As far as half a window for the values, and as far again for where all of a window is shown.
  return {std::max(0, cells.left - kSweepWindow), std::max(0, cells.top - kSweepWindow),
          std::min(raster.width, cells.right + kSweepWindow),
          std::min(raster.height, cells.bottom + kSweepWindow)};
}

TexelGrid PartOf(const TexelGrid& raster, const CellRectangle& cells) {
  TexelGrid part = raster;
  part.origin = raster.At(cells.left, cells.top);
  part.width = cells.right - cells.left;
  part.height = cells.bottom - cells.top;
  return part;
}

SweepPhoto OpenForSweep(const SurveyPhoto& photo, const TexelGrid& part, PhotoCache& cache) {
  const std::shared_ptr<const PhotoPyramid> pyramid = cache.Get(photo.path(), kPhotoSide);
  const Image& finest = pyramid->levels.front();
  const double loaded = static_cast<double>(finest.width_px) / pyramid->full_width_px;
  const Eigen::Vector2d middle(part.width / 2.0, part.height / 2.0);
  const double distance = (photo.cam_from_world.Center() - part.At(middle.x(), middle.y())).norm();
  const double pixels = loaded * photo.camera.FocalX() * part.texel / distance;
  const int last = static_cast<int>(pyramid->levels.size()) - 1;
  const int level = std::clamp(static_cast<int>(std::log2(std::max(1.0, pixels))), 0, last);
  const Image& image = pyramid->levels[level];
  const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3,
                    const_cast<uint8_t*>(image.data.data()));
  SweepPhoto side{&photo, {}, {}, {}};
  cv::Mat bytes;
  cv::cvtColor(rgb, bytes, cv::COLOR_RGB2GRAY);
  bytes.convertTo(side.grey, CV_32F);
  side.scale = {static_cast<double>(image.width_px) / pyramid->full_width_px,
                static_cast<double>(image.height_px) / pyramid->full_height_px};
  return side;
}

PlaneSweep StartSweep(const TexelGrid& raster, double parallax) {
  assert(parallax > 0);
  PlaneSweep out;
  out.raster = raster;
  out.step = std::max(raster.texel / parallax, (kHighest_m + kDeepest_m) / kMostPlanes);
  out.plane = static_cast<int>(kDeepest_m / out.step);
  out.planes = out.plane + static_cast<int>(kHighest_m / out.step) + 1;
  for (auto* values : {&out.best, &out.all, &out.squarest, &out.closest}) {
    values->resize(raster.size() * out.planes);
  }
  out.plain.resize(out.all.size());
  out.pairs.resize(raster.size());
  out.grey.assign(raster.size(), -1);
  return out;
}

void SweepPart(const CellRectangle& cells, const std::vector<SweepPhoto>& photos,
               PlaneSweep& sweep) {
  Sweep(cells, photos, sweep).Run();
}

uint64_t PlaneSweepBytes(const TexelGrid& raster) {
  constexpr double kBytesPerPlane = 4 * sizeof(float) + 1;
  return static_cast<uint64_t>(static_cast<double>(raster.size()) * kBytesPerPlane * kMostPlanes);
}

}  // namespace stucco
