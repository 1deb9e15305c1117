// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/find_relief.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "texture/semi_global.h"

namespace stucco {
namespace {

constexpr double kDeepest_m = 0.5;
constexpr double kHighest_m = 1.6;
constexpr double kCell_m = 0.04;
constexpr double kMostCells = 150'000;
constexpr int kLeastTexels = 2;  // of a cell, a side
constexpr size_t kMostPhotos = 8;
constexpr int kPhotoSide = 1600;  // photos are read this small
constexpr double kMostLabels = 48;
constexpr int kLattice = 4;    // cells between exact projections
constexpr int kSightStep = 4;  // cells of a cell that sights are asked for
constexpr int kWindow = 2;     // cells around one
constexpr float kNoise = 16;   // grey levels squared: plain surfaces look alike anywhere
// Photos from nearly the same side show the same on any plane: difference of the way along the
// facet per way before it.
constexpr double kLeastParallax = 0.15;
constexpr double kBestShare = 0.5;  // of the pairs at a place; something may hide it from others
constexpr float kLonePairs = 0.5f;  // pairs that agree by chance
// Costs of labels, of a correlation: of any place off the plane, of a metre, of neighbours.
constexpr float kOffPlane = 0.02f;
constexpr float kNextStep = 0.3f;
constexpr float kJump = 0.6f;
// Of what is off the plane. Plain surfaces do not count: they look alike on any plane, and get
// theirs from what is around them.
constexpr float kTelling = 0.2f;        // mean correlation there or on the plane
constexpr double kLeastTelling = 0.25;  // of the region
constexpr double kLeastGain = 0.1;      // of the mean correlation of all pairs
constexpr int kAround = 4;              // cells in which that must hold too
// What stands before the plane belongs to the facet when three photos show it and none the facet
// behind it; else it is a lamp, a car, a branch.
constexpr int kFewestPairs = 3;
constexpr float kBehind = 0.6f;      // correlation of a pair that shows the facet
constexpr double kMostBehind = 0.3;  // of a region
constexpr double kLeastCorrelation = 0.4;
constexpr double kLeastArea_m2 = 0.2;

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
};

// A photo that takes part: its brightness, about as fine as the raster.
struct Side {
  const SurveyPhoto* photo = nullptr;
  cv::Mat grey;               // floats
  Eigen::Vector2d scale;      // its pixels per pixel of the photo
  std::vector<uint8_t> sees;  // by cell
};

Side OpenSide(const SurveyPhoto& photo, const TexelGrid& raster, PhotoCache& cache) {
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
  Side side{&photo, {}, {}, {}};
  cv::Mat bytes;
  cv::cvtColor(rgb, bytes, cv::COLOR_RGB2GRAY);
  bytes.convertTo(side.grey, CV_32F);
  side.scale = {static_cast<double>(image.width_px) / pyramid->full_width_px,
                static_cast<double>(image.height_px) / pyramid->full_height_px};
  return side;
}

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

class Sweep {
 public:
  Sweep(const TexelGrid& raster, std::vector<Side> sides)
      : raster_(raster), sides_(std::move(sides)), sums_(raster.width, raster.height) {
    const Eigen::Vector3d middle = raster.At(raster.width / 2.0, raster.height / 2.0);
    std::vector<Eigen::Vector2d> slant;  // way along the facet per way before it
    for (const Side& side : sides_) {
      const Eigen::Vector3d way = side.photo->cam_from_world.Center() - middle;
      slant.push_back(Eigen::Vector2d(way.dot(raster.u_axis), way.dot(raster.v_axis)) /
                      way.dot(raster.normal));
    }
    double most = 0;
    for (size_t a = 0; a < slant.size(); ++a) {
      for (size_t b = a + 1; b < slant.size(); ++b) {
        const double parallax = (slant[a] - slant[b]).norm();
        if (parallax < kLeastParallax) continue;
        pairs_.emplace_back(a, b);
        most = std::max(most, parallax);
      }
    }
    if (pairs_.empty()) return;
    step_ = std::max(raster.texel / most, (kHighest_m + kDeepest_m) / kMostLabels);
    first_ = -static_cast<int>(kDeepest_m / step_);
    last_ = static_cast<int>(kHighest_m / step_);
  }

  bool CanTell() const { return !pairs_.empty(); }
  double step() const { return step_; }
  const TexelGrid& raster() const { return raster_; }
  int plane() const { return -first_; }  // the label of the facet's own plane

  int labels() const { return last_ - first_ + 1; }

  // How well photos agree, by label: [cell * labels + label], -1 to 1; 0 where no pair shows it.
  struct Agreement {
    std::vector<float> best;  // of the best pairs
    std::vector<float> all;
    // On the facet's own plane, by cell: the pairs that show it, and the best of them.
    std::vector<uint8_t> pairs;
    std::vector<float> behind;
  };

  Agreement Measure() {
    Agreement out;
    out.best.resize(raster_.size() * labels());
    out.all.resize(out.best.size());
    out.pairs.resize(raster_.size());
    out.behind.resize(raster_.size());
    for (int label = 0; label < labels(); ++label) MeasureAt(label, out);
    return out;
  }

 private:
  Shown Show(const Side& side, const TexelGrid& plane) {
    // Exact every few cells, between them by interpolation.
    const int columns = (plane.width + kLattice - 1) / kLattice + 1;
    const int rows = (plane.height + kLattice - 1) / kLattice + 1;
    cv::Mat lattice(rows, columns, CV_32FC2);
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        const auto pixel = ProjectIntoPhoto(*side.photo, plane.At(i * kLattice, j * kLattice));
        const float nowhere = -1e6f;
        lattice.at<cv::Vec2f>(j, i) =
            pixel ? cv::Vec2f(static_cast<float>(pixel->x() * side.scale.x()),
                              static_cast<float>(pixel->y() * side.scale.y()))
                  : cv::Vec2f(nowhere, nowhere);
      }
    }
    Shown out;
    out.grey.resize(plane.size());
    out.valid.resize(plane.size());
    for (int y = 0; y < plane.height; ++y) {
      const float t = (static_cast<float>(y % kLattice) + 0.5f) / kLattice;
      for (int x = 0; x < plane.width; ++x) {
        const size_t i = static_cast<size_t>(y) * plane.width + x;
        if (!side.sees[i]) continue;
        const float s = (static_cast<float>(x % kLattice) + 0.5f) / kLattice;
        const auto* above = lattice.ptr<cv::Vec2f>(y / kLattice) + x / kLattice;
        const auto* below = lattice.ptr<cv::Vec2f>(y / kLattice + 1) + x / kLattice;
        const cv::Vec2f at =
            (1 - t) * ((1 - s) * above[0] + s * above[1]) + t * ((1 - s) * below[0] + s * below[1]);
        out.valid[i] = SampleGrey(side.grey, at[0] - 0.5f, at[1] - 0.5f, out.grey[i]);
      }
    }
    out.mean = WindowMeans([&](size_t i) { return out.grey[i]; });
    out.variance = WindowMeans([&](size_t i) { return out.grey[i] * out.grey[i]; });
    for (size_t i = 0; i < out.mean.size(); ++i) out.variance[i] -= out.mean[i] * out.mean[i];
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

  void MeasureAt(int label, Agreement& out) {
    TexelGrid plane = raster_;
    plane.origin += (first_ + label) * step_ * raster_.normal;
    std::vector<Shown> shown;
    for (const Side& side : sides_) shown.push_back(Show(side, plane));
    std::vector<float> of_pairs(raster_.size() * pairs_.size());
    std::vector<uint8_t> counts(raster_.size(), 0);
    for (const auto& [a, b] : pairs_) {
      const Shown& one = shown[a];
      const Shown& other = shown[b];
      const std::vector<float> products =
          WindowMeans([&](size_t i) { return one.grey[i] * other.grey[i]; });
      for (size_t i = 0; i < products.size(); ++i) {
        if (!one.valid[i] || !other.valid[i]) continue;
        const float covariance = products[i] - one.mean[i] * other.mean[i];
        const float scale = (one.variance[i] + kNoise) * (other.variance[i] + kNoise);
        of_pairs[i * pairs_.size() + counts[i]++] = covariance / std::sqrt(scale);
      }
    }
    for (size_t i = 0; i < raster_.size(); ++i) {
      if (counts[i] == 0) continue;
      const auto values = of_pairs.begin() + static_cast<std::ptrdiff_t>(i * pairs_.size());
      const auto mean = [&](int count) {
        return std::accumulate(values, values + count, 0.0f) /
               (static_cast<float>(count) + kLonePairs);
      };
      const int best = std::max(1, static_cast<int>(std::lround(kBestShare * counts[i])));
      std::partial_sort(values, values + best, values + counts[i], std::greater<>());
      out.best[i * labels() + label] = mean(best);
      out.all[i * labels() + label] = mean(counts[i]);
      if (label != -first_) continue;
      out.pairs[i] = counts[i];
      out.behind[i] = values[0];
    }
  }

  const TexelGrid& raster_;
  std::vector<Side> sides_;
  std::vector<std::pair<size_t, size_t>> pairs_;
  WindowSums sums_;
  double step_ = 0;
  int first_ = 0;
  int last_ = 0;
};

TexelGrid SweepRaster(const TexelGrid& grid) {
  const double needed =
      std::max(kCell_m / grid.texel, std::sqrt(static_cast<double>(grid.size()) / kMostCells));
  return Coarsened(grid, std::max(kLeastTexels, static_cast<int>(std::ceil(needed))));
}

// Where a photo sees the facet's plane freely, by cell of the raster.
std::vector<uint8_t> SeenCells(const Facet& facet, const TexelGrid& raster, int photo,
                               const ViewLimits& limits, const PaintScene& scene) {
  FacetRaster coarse{Coarsened(raster, kSightStep), {}, 1};
  coarse.inside.assign(coarse.grid.size(), 1);
  const RasterView view = MeasureView(scene.sights, photo, facet, coarse, limits);
  std::vector<uint8_t> out(raster.size());
  for (size_t i = 0; i < out.size(); ++i) {
    const size_t column = i % raster.width / kSightStep;
    const size_t row = i / raster.width / kSightStep;
    out[i] = view.texels[row * coarse.grid.width + column].sight != Sight::kNot;
  }
  return out;
}

// What telling cells say of their labels against the plane.
struct Evidence {
  double cells = 0;
  double gain = 0;  // sums
  double correlation = 0;

  void Add(const Sweep& sweep, const Sweep::Agreement& agreement, size_t cell, int label) {
    const auto of = [&](const std::vector<float>& values, int l) {
      return values[cell * sweep.labels() + l];
    };
    const float here = of(agreement.best, label);
    if (std::max(here, of(agreement.best, sweep.plane())) < kTelling) return;
    cells += 1;
    correlation += here;
    gain += of(agreement.all, label) - of(agreement.all, sweep.plane());
  }
};

Evidence EvidenceAround(const Sweep& sweep, const Sweep::Agreement& agreement,
                        const std::vector<int>& labels, size_t cell) {
  const TexelGrid& raster = sweep.raster();
  const int x = static_cast<int>(cell) % raster.width;
  const int y = static_cast<int>(cell) / raster.width;
  Evidence around;
  for (int j = std::max(0, y - kAround); j <= std::min(raster.height - 1, y + kAround); ++j) {
    for (int i = std::max(0, x - kAround); i <= std::min(raster.width - 1, x + kAround); ++i) {
      const size_t other = static_cast<size_t>(j) * raster.width + i;
      if (std::abs(labels[other] - labels[cell]) > 1) continue;
      around.Add(sweep, agreement, other, labels[other]);
    }
  }
  return around;
}

// Whether heights fall through the cell, steadily and steeper than walls ever do. Such slopes are
// fitted where a balcony hides the wall behind it from some photos.
bool IsOnSlope(const TexelGrid& raster, const std::vector<int>& labels, size_t cell) {
  constexpr int kReach = 2;
  constexpr int kFewest = 4;
  const int x = static_cast<int>(cell) % raster.width;
  const int y = static_cast<int>(cell) / raster.width;
  int higher = 0;
  int lower = 0;
  for (int j = std::max(0, y - kReach); j <= std::min(raster.height - 1, y + kReach); ++j) {
    for (int i = std::max(0, x - kReach); i <= std::min(raster.width - 1, x + kReach); ++i) {
      const int rise = labels[static_cast<size_t>(j) * raster.width + i] - labels[cell];
      higher += rise >= kReach && rise <= 2 * kReach;
      lower += rise <= -kReach && rise >= -2 * kReach;
    }
  }
  return std::min(higher, lower) >= kFewest;
}

// Puts cells onto the plane where those around them gain too little off it, and slopes.
void DropDoubtful(const Sweep& sweep, const Sweep::Agreement& agreement, std::vector<int>& labels) {
  const std::vector<int> found = labels;
  for (size_t cell = 0; cell < found.size(); ++cell) {
    if (found[cell] == sweep.plane()) continue;
    const Evidence around = EvidenceAround(sweep, agreement, found, cell);
    if (around.gain < kLeastGain * around.cells || IsOnSlope(sweep.raster(), found, cell)) {
      labels[cell] = sweep.plane();
    }
  }
}

// A connected region off the plane, heights changing by a step at most.
struct Region {
  std::vector<size_t> cells;
  bool ends = true;  // within what was looked through
  Evidence evidence;
  double raised = 0;  // cells
  double shown = 0;   // of them, by enough pairs
  double behind = 0;  // of them, those before what a pair shows of the plane

  bool IsSure(size_t least_cells) const {
    const bool attached = 2 * shown >= raised && behind <= kMostBehind * raised;
    return ends && attached && cells.size() >= least_cells &&
           evidence.cells >= kLeastTelling * static_cast<double>(cells.size()) &&
           evidence.gain >= kLeastGain * evidence.cells &&
           evidence.correlation >= kLeastCorrelation * evidence.cells;
  }
};

Region RegionFrom(size_t seed, const Sweep& sweep, const Sweep::Agreement& agreement,
                  const std::vector<int>& labels, std::vector<uint8_t>& done) {
  Region region;
  region.cells.push_back(seed);
  done[seed] = 1;
  for (size_t k = 0; k < region.cells.size(); ++k) {
    const size_t cell = region.cells[k];
    const int label = labels[cell];
    region.ends &= label > 0 && label + 1 < sweep.labels();
    region.evidence.Add(sweep, agreement, cell, label);
    if (label > sweep.plane()) {
      region.raised += 1;
      region.shown += agreement.pairs[cell] >= kFewestPairs;
      const float here = agreement.best[cell * sweep.labels() + label];
      region.behind += agreement.behind[cell] >= std::max(kBehind, here);
    }
    const int width = sweep.raster().width;
    const int x = static_cast<int>(cell) % width;
    const int y = static_cast<int>(cell) / width;
    const auto visit = [&](size_t next) {
      if (done[next] || labels[next] == sweep.plane() || std::abs(labels[next] - label) > 1) return;
      done[next] = 1;
      region.cells.push_back(next);
    };
    if (x > 0) visit(cell - 1);
    if (x + 1 < width) visit(cell + 1);
    if (y > 0) visit(cell - width);
    if (y + 1 < sweep.raster().height) visit(cell + width);
  }
  return region;
}

// Puts regions that gain too little off the plane, match too badly or are too small back onto it,
// and those that reach the end of what was looked through: what is there may be farther off.
void KeepSureRegions(const Sweep& sweep, const Sweep::Agreement& agreement,
                     std::vector<int>& labels) {
  const double cell_m2 = sweep.raster().texel * sweep.raster().texel;
  std::vector<uint8_t> done(labels.size(), 0);
  for (size_t seed = 0; seed < labels.size(); ++seed) {
    if (done[seed] || labels[seed] == sweep.plane()) continue;
    const Region region = RegionFrom(seed, sweep, agreement, labels, done);
    if (region.IsSure(static_cast<size_t>(kLeastArea_m2 / cell_m2))) continue;
    for (const size_t cell : region.cells) labels[cell] = sweep.plane();
  }
}

LabelCosts CostsOf(const Sweep& sweep, const Sweep::Agreement& agreement) {
  LabelCosts out{sweep.raster().width, sweep.raster().height, sweep.labels(), agreement.best};
  for (size_t i = 0; i < out.costs.size(); ++i) {
    const bool off = static_cast<int>(i % out.labels) != sweep.plane();
    out.costs[i] = 1 - out.costs[i] + (off ? kOffPlane : 0);
  }
  return out;
}

}  // namespace

std::shared_ptr<const Relief> FindRelief(const Facet& facet, const TexelGrid& grid,
                                         std::span<const Candidate> candidates,
                                         const ViewLimits& limits, const PaintScene& scene) {
  const TexelGrid raster = SweepRaster(grid);
  std::vector<Side> sides;
  for (const Candidate& candidate : candidates.first(std::min(kMostPhotos, candidates.size()))) {
    const SurveyPhoto& photo = scene.sights.photos[candidate.photo];
    sides.push_back(OpenSide(photo, raster, *scene.cache));
    sides.back().sees = SeenCells(facet, raster, candidate.photo, limits, scene);
  }
  Sweep sweep(raster, std::move(sides));
  if (!sweep.CanTell()) return nullptr;
  const Sweep::Agreement agreement = sweep.Measure();
  std::vector<int> labels = MatchSemiGlobally(CostsOf(sweep, agreement), kNextStep, kJump);
  DropDoubtful(sweep, agreement, labels);
  KeepSureRegions(sweep, agreement, labels);
  auto relief = std::make_shared<Relief>();
  relief->cell = raster.texel;
  relief->width = raster.width;
  relief->height = raster.height;
  relief->step = sweep.step();
  relief->highest = (*std::ranges::max_element(labels) - sweep.plane()) * sweep.step();
  bool any = false;
  for (const int label : labels) {
    any |= label != sweep.plane();
    relief->heights.push_back(static_cast<float>((label - sweep.plane()) * sweep.step()));
  }
  if (!any) return nullptr;
  return relief;
}

uint64_t ReliefBytes(const TexelGrid& grid) {
  constexpr double kBytesPerLabel = 5 * sizeof(float);
  constexpr double kBytesPerPhoto = 40;
  const TexelGrid raster = SweepRaster(grid);
  return static_cast<uint64_t>(static_cast<double>(raster.size()) *
                               (kBytesPerLabel * kMostLabels + kBytesPerPhoto * kMostPhotos));
}

}  // namespace stucco
