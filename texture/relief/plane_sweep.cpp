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
constexpr int kWindow = 2;            // cells around one
constexpr float kNoise = 16;          // grey levels squared: plain surfaces look alike anywhere
constexpr double kBestShare = 0.5;    // of the pairs at a place; something may hide it from others
constexpr float kLonePairs = 0.5f;    // pairs that agree by chance
constexpr float kPlainPairs = 0.25f;  // what a pair weighs that says nothing
constexpr float kAlong = 0.1f;        // share of slopes along the way of a pair that weighs half

// Sums over windows of a raster.
class WindowSums {
 public:
  WindowSums(int width, int height) : width_(width), height_(height) {
    table_.resize((static_cast<size_t>(width) + 1) * (static_cast<size_t>(height) + 1), 0);
  }

  template <typename Value>
  void Fill(const Value& value) {
    for (int y = 0; y < height_; ++y) {
      double row = 0;
      for (int x = 0; x < width_; ++x) {
        row += value(static_cast<size_t>(y) * width_ + x);
        At(x + 1, y + 1) = At(x + 1, y) + row;
      }
    }
  }

  double Around(int x, int y) const {
    const int left = std::max(0, x - kWindow);
    const int right = std::min(width_, x + kWindow + 1);
    const int top = std::max(0, y - kWindow);
    const int bottom = std::min(height_, y + kWindow + 1);
    return At(right, bottom) - At(left, bottom) - At(right, top) + At(left, top);
  }

 private:
  double& At(int x, int y) { return table_[static_cast<size_t>(y) * (width_ + 1) + x]; }
  double At(int x, int y) const { return table_[static_cast<size_t>(y) * (width_ + 1) + x]; }

  int width_;
  int height_;
  std::vector<double> table_;
};

// What a photo shows on a plane, with the moments of each window.
struct Shown {
  std::vector<float> grey;
  std::vector<uint8_t> valid;
  std::vector<float> mean;
  std::vector<float> variance;
  // Of the slopes of grey, products: along u, across, along v.
  std::array<std::vector<float>, 3> slopes;

  // The share of a window's slopes that runs along a direction.
  float Along(const Eigen::Vector2f& way, size_t cell) const {
    const float uu = slopes[0][cell];
    const float uv = slopes[1][cell];
    const float vv = slopes[2][cell];
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
  float correlation = 0;
  float weight = 0;
  float slant = 0;  // of the squarer photo
};

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

// The photo on the plane, projected exactly every few cells and between them by interpolation.
Shown Bring(const SweepPhoto& photo, const TexelGrid& plane) {
  const cv::Mat lattice = ProjectLattice(photo, plane);
  Shown out;
  out.grey.resize(plane.size());
  out.valid.resize(plane.size());
  for (int y = 0; y < plane.height; ++y) {
    const float t = (static_cast<float>(y % kLattice) + 0.5f) / kLattice;
    for (int x = 0; x < plane.width; ++x) {
      const size_t i = static_cast<size_t>(y) * plane.width + x;
      if (!photo.sees[i]) continue;
      const float s = (static_cast<float>(x % kLattice) + 0.5f) / kLattice;
      const auto* above = lattice.ptr<cv::Vec2f>(y / kLattice) + x / kLattice;
      const auto* below = lattice.ptr<cv::Vec2f>(y / kLattice + 1) + x / kLattice;
      const cv::Vec2f at =
          (1 - t) * ((1 - s) * above[0] + s * above[1]) + t * ((1 - s) * below[0] + s * below[1]);
      out.valid[i] = SampleGrey(photo.grey, at[0] - 0.5f, at[1] - 0.5f, out.grey[i]);
    }
  }
  return out;
}

class Sweep {
 public:
  Sweep(const TexelGrid& raster, const std::vector<SweepPhoto>& photos)
      : raster_(raster), photos_(photos), sums_(raster.width, raster.height) {}

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

  Shown Show(const SweepPhoto& photo, const TexelGrid& plane) {
    Shown out = Bring(photo, plane);
    out.mean = WindowMeans([&](size_t i) { return out.grey[i]; });
    out.variance = WindowMeans([&](size_t i) { return out.grey[i] * out.grey[i]; });
    for (size_t i = 0; i < out.mean.size(); ++i) out.variance[i] -= out.mean[i] * out.mean[i];
    const auto slope = [&](size_t i, size_t stride, bool inside) {
      return inside ? (out.grey[i + stride] - out.grey[i - stride]) / 2 : 0.0f;
    };
    const size_t width = plane.width;
    const auto along_u = [&](size_t i) {
      return slope(i, 1, i % width > 0 && i % width + 1 < width);
    };
    const auto along_v = [&](size_t i) {
      return slope(i, width, i >= width && i + width < plane.size());
    };
    out.slopes = {WindowMeans([&](size_t i) { return along_u(i) * along_u(i); }),
                  WindowMeans([&](size_t i) { return along_u(i) * along_v(i); }),
                  WindowMeans([&](size_t i) { return along_v(i) * along_v(i); })};
    const std::vector<float> share = WindowMeans([&](size_t i) { return out.valid[i]; });
    for (size_t i = 0; i < out.valid.size(); ++i) out.valid[i] = share[i] > 0.999f;
    return out;
  }

  template <typename Value>
  std::vector<float> WindowMeans(const Value& value) {
    sums_.Fill(value);
    std::vector<float> out(raster_.size());
    for (int y = 0; y < raster_.height; ++y) {
      const int rows = std::min(raster_.height, y + kWindow + 1) - std::max(0, y - kWindow);
      for (int x = 0; x < raster_.width; ++x) {
        const int columns = std::min(raster_.width, x + kWindow + 1) - std::max(0, x - kWindow);
        out[static_cast<size_t>(y) * raster_.width + x] =
            static_cast<float>(sums_.Around(x, y) / (rows * columns));
      }
    }
    return out;
  }

  void Measure(int label, PlaneSweep& out) {
    TexelGrid plane = raster_;
    plane.origin += out.HeightOf(label) * raster_.normal;
    std::vector<Shown> shown;
    for (const SweepPhoto& photo : photos_) shown.push_back(Show(photo, plane));
    std::vector<Vote> votes(raster_.size() * pairs_.size());
    std::vector<uint8_t> counts(raster_.size(), 0);
    for (const Pair& pair : pairs_) {
      const Shown& a = shown[pair.a];
      const Shown& b = shown[pair.b];
      const std::vector<float> products =
          WindowMeans([&](size_t i) { return a.grey[i] * b.grey[i]; });
      for (size_t i = 0; i < products.size(); ++i) {
        if (!a.valid[i] || !b.valid[i]) continue;
        const float covariance = products[i] - a.mean[i] * b.mean[i];
        const float scale = (a.variance[i] + kNoise) * (b.variance[i] + kNoise);
        const float along = std::min(a.Along(pair.way, i), b.Along(pair.way, i));
        votes[i * pairs_.size() + counts[i]++] = {covariance / std::sqrt(scale),
                                                  along / (along + kAlong), pair.slant};
      }
    }
    for (size_t i = 0; i < raster_.size(); ++i) {
      if (counts[i] == 0) continue;
      Summarise(label, i, std::span(votes).subspan(i * pairs_.size(), counts[i]), out);
    }
  }

  // What the pairs that show a cell say of a plane; sorts them.
  static void Summarise(int label, size_t cell, std::span<Vote> votes, PlaneSweep& out) {
    const size_t i = label * out.raster.size() + cell;
    std::ranges::sort(votes, {}, &Vote::slant);
    const auto others = std::ranges::upper_bound(votes, votes.front().slant, {}, &Vote::slant);
    out.squarest[i] = MeanVote(votes.first(static_cast<size_t>(others - votes.begin())));
    std::ranges::sort(votes, std::greater<>(),
                      [](const Vote& vote) { return vote.weight * vote.correlation; });
    const auto half =
        static_cast<size_t>(std::lround(kBestShare * static_cast<double>(votes.size())));
    out.best[i] = MeanVote(votes.first(std::max<size_t>(1, half)));
    out.all[i] = MeanVote(votes);
    out.closest[i] = votes.front().weight * votes.front().correlation;
    if (label == out.plane) {
      out.pairs[cell] = static_cast<uint8_t>(std::min<size_t>(votes.size(), 255));
    }
  }

  static float MeanVote(std::span<const Vote> votes) {
    float sum = 0;
    float weights = kLonePairs + kPlainPairs * static_cast<float>(votes.size());
    for (const Vote& vote : votes) {
      sum += vote.weight * vote.correlation;
      weights += vote.weight;
    }
    return sum / weights;
  }

  const TexelGrid& raster_;
  const std::vector<SweepPhoto>& photos_;
  std::vector<Pair> pairs_;
  WindowSums sums_;
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
