// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/plane_sweep.h"

#include <algorithm>
#include <array>
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
constexpr int kWindow = 5;            // cells a side
constexpr float kNoise = 16;          // grey levels squared: plain surfaces look alike anywhere
constexpr double kBestShare = 0.5;    // of the pairs at a place; something may hide it from others
constexpr float kLonePairs = 0.5f;    // pairs that agree by chance
constexpr float kPlainPairs = 0.25f;  // what a pair weighs that says nothing
constexpr float kAlong = 0.1f;        // share of slopes along the way of a pair that weighs half

// Means over the windows of a raster, cut off at its rim.
class WindowMeans {
 public:
  WindowMeans(int width, int height)
      : cells_per_window_(Sums(cv::Mat::ones(height, width, CV_32F))) {}

  cv::Mat Of(const cv::Mat& values) const { return Sums(values) / cells_per_window_; }

 private:
  static cv::Mat Sums(const cv::Mat& values) {
    cv::Mat sums;
    cv::boxFilter(values, sums, CV_32F, {kWindow, kWindow}, {-1, -1}, false, cv::BORDER_CONSTANT);
    return sums;
  }

  cv::Mat cells_per_window_;
};

// What a photo shows on a plane, with the moments of each window; rasters of floats.
struct Shown {
  cv::Mat grey;
  cv::Mat valid;  // bytes: whether it shows the whole window
  cv::Mat mean;
  cv::Mat variance;
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
  Sweep(const TexelGrid& raster, const std::vector<SweepPhoto>& photos)
      : raster_(raster), photos_(photos), means_(raster.width, raster.height) {}

  std::optional<PlaneSweep> Run() {
    PlaneSweep out;
    for (const SweepPhoto& photo : photos_) out.slants.push_back(SlantOf(*photo.photo, raster_));
    const double most = PairPhotos(out.slants);
    if (pairs_.empty()) return {};
    out.raster = raster_;
    out.step = std::max(raster_.texel / most, (kHighest_m + kDeepest_m) / kMostPlanes);
    out.plane = static_cast<int>(kDeepest_m / out.step);
    out.planes = out.plane + static_cast<int>(kHighest_m / out.step) + 1;
    out.best.resize(raster_.size() * out.planes);
    out.all.resize(out.best.size());
    out.squarest.resize(out.best.size());
    out.closest.resize(out.best.size());
    out.pairs.resize(raster_.size());
    for (int label = 0; label < out.planes; ++label) Measure(label, out);
    return out;
  }

 private:
  // The pairs that look from different sides; the largest parallax among them.
  double PairPhotos(std::span<const Eigen::Vector2d> slant) {
    double most = 0;
    for (size_t a = 0; a < slant.size(); ++a) {
      for (size_t b = a + 1; b < slant.size(); ++b) {
        const double parallax = (slant[a] - slant[b]).norm();
        if (parallax < kLeastParallax) continue;
        pairs_.push_back({a, b, ((slant[a] - slant[b]) / parallax).cast<float>(),
                          static_cast<float>(std::min(slant[a].norm(), slant[b].norm()))});
        most = std::max(most, parallax);
      }
    }
    return most;
  }

  Shown Show(const SweepPhoto& photo, const TexelGrid& plane) const {
    Shown out;
    Bring(photo, plane, out);
    out.mean = means_.Of(out.grey);
    out.variance = means_.Of(out.grey.mul(out.grey)) - out.mean.mul(out.mean);
    const cv::Mat difference = (cv::Mat_<float>(1, 3) << -0.5f, 0, 0.5f);
    cv::Mat along_u;
    cv::Mat along_v;
    cv::filter2D(out.grey, along_u, CV_32F, difference);
    cv::filter2D(out.grey, along_v, CV_32F, difference.t());
    out.slopes = {means_.Of(along_u.mul(along_u)), means_.Of(along_u.mul(along_v)),
                  means_.Of(along_v.mul(along_v))};
    cv::erode(out.valid, out.valid, cv::Mat::ones(kWindow, kWindow, CV_8U));
    return out;
  }

  void Measure(int label, PlaneSweep& out) const {
    TexelGrid plane = raster_;
    plane.origin += out.HeightOf(label) * raster_.normal;
    std::vector<Shown> shown;
    for (const SweepPhoto& photo : photos_) shown.push_back(Show(photo, plane));
    std::vector<cv::Mat> covariances;
    for (const Pair& pair : pairs_) {
      const Shown& a = shown[pair.a];
      const Shown& b = shown[pair.b];
      covariances.emplace_back(means_.Of(a.grey.mul(b.grey)) - a.mean.mul(b.mean));
    }
    std::vector<Vote> votes;
    for (int cell = 0; cell < static_cast<int>(raster_.size()); ++cell) {
      votes.clear();
      for (size_t i = 0; i < pairs_.size(); ++i) {
        const Shown& a = shown[pairs_[i].a];
        const Shown& b = shown[pairs_[i].b];
        if (!a.valid.at<uint8_t>(cell) || !b.valid.at<uint8_t>(cell)) continue;
        votes.push_back(VoteOf(pairs_[i], a, b, covariances[i].at<float>(cell), cell));
      }
      if (!votes.empty()) Summarise(label, cell, votes, out);
    }
  }

  static Vote VoteOf(const Pair& pair, const Shown& a, const Shown& b, float covariance, int cell) {
    const float variances =
        (a.variance.at<float>(cell) + kNoise) * (b.variance.at<float>(cell) + kNoise);
    const float along = std::min(a.Along(pair.way, cell), b.Along(pair.way, cell));
    const float weight = along / (along + kAlong);
    return {weight * covariance / std::sqrt(variances), weight, pair.slant};
  }

  // What the pairs that show a cell say of a plane; orders them.
  static void Summarise(int label, int cell, std::span<Vote> votes, PlaneSweep& out) {
    const size_t i = label * out.raster.size() + cell;
    out.all[i] = MeanVote(votes);
    const float squarest = std::ranges::min(votes, {}, &Vote::slant).slant;
    const auto others = std::partition(votes.begin(), votes.end(),
                                       [&](const Vote& vote) { return vote.slant == squarest; });
    out.squarest[i] = MeanVote(votes.first(static_cast<size_t>(others - votes.begin())));
    const auto half = std::max(1L, std::lround(kBestShare * static_cast<double>(votes.size())));
    std::ranges::nth_element(votes, votes.begin() + half - 1, std::greater<>(), &Vote::value);
    out.best[i] = MeanVote(votes.first(half));
    out.closest[i] = std::ranges::max(votes.first(half), {}, &Vote::value).value;
    if (label == out.plane) {
      out.pairs[cell] = static_cast<uint8_t>(std::min<size_t>(votes.size(), 255));
    }
  }

  const TexelGrid& raster_;
  const std::vector<SweepPhoto>& photos_;
  std::vector<Pair> pairs_;
  WindowMeans means_;
};

}  // namespace

Eigen::Vector2d SlantOf(const SurveyPhoto& photo, const TexelGrid& raster) {
  const Eigen::Vector3d way =
      photo.cam_from_world.Center() - raster.At(raster.width / 2.0, raster.height / 2.0);
  return Eigen::Vector2d(way.dot(raster.u_axis), way.dot(raster.v_axis)) / way.dot(raster.normal);
}

SweepPhoto OpenForSweep(const SurveyPhoto& photo, const TexelGrid& raster, PhotoCache& cache) {
  const std::shared_ptr<const PhotoPyramid> pyramid = cache.Get(photo.path(), kPhotoSide);
  const Image& finest = pyramid->levels.front();
  const double loaded = static_cast<double>(finest.width_px) / pyramid->full_width_px;
  const Eigen::Vector2d middle(raster.width / 2.0, raster.height / 2.0);
  const double distance =
      (photo.cam_from_world.Center() - raster.At(middle.x(), middle.y())).norm();
  const double pixels = loaded * photo.camera.FocalX() * raster.texel / distance;
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

std::optional<PlaneSweep> SweepPlanes(const TexelGrid& raster,
                                      const std::vector<SweepPhoto>& photos) {
  return Sweep(raster, photos).Run();
}

uint64_t PlaneSweepBytes(const TexelGrid& raster, size_t photos) {
  constexpr double kBytesPerPlane = 4 * sizeof(float);
  constexpr double kBytesPerPhoto = 40;
  return static_cast<uint64_t>(
      static_cast<double>(raster.size()) *
      (kBytesPerPlane * kMostPlanes + kBytesPerPhoto * static_cast<double>(photos)));
}

}  // namespace stucco
