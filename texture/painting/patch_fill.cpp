// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/patch_fill.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <random>

namespace stucco {
namespace {

constexpr int kRadius = 3;
constexpr int kSmallestLevel = 40;  // shorter side of the coarsest level, texels
constexpr size_t kFewestSources = 200;
constexpr int kVotingRounds = 4;       // of matching and voting per level
constexpr int kSweeps = 3;             // of propagation and random search per round
constexpr float kTrustFalloff = 1.3f;  // per texel into the hole

struct Level {
  cv::Mat rgb;     // CV_32FC3
  cv::Mat hole;    // CV_8U
  cv::Mat source;  // CV_8U
};

Level Halved(const Level& fine) {
  Level out;
  const cv::Size size((fine.rgb.cols + 1) / 2, (fine.rgb.rows + 1) / 2);
  cv::resize(fine.rgb, out.rgb, size, 0, 0, cv::INTER_AREA);
  cv::Mat share;
  cv::resize(fine.hole, share, size, 0, 0, cv::INTER_AREA);
  out.hole = share > 0;
  cv::resize(fine.source, share, size, 0, 0, cv::INTER_AREA);
  out.source = (share == 255) & ~out.hole;
  return out;
}

// Nearest source patches of all patches that touch the hole of one level.
class Matcher {
 public:
  Matcher(Level& level, std::mt19937& random) : level_(level), random_(random) {
    const cv::Mat box = cv::Mat::ones(2 * kRadius + 1, 2 * kRadius + 1, CV_8U);
    cv::Mat touched;
    cv::dilate(level.hole, touched, box);
    // Beyond the facet nothing is missing: its borders, too, have patches to copy.
    const cv::Mat centers = level.source & ~touched;
    // Patches need a middle inside the facet.
    touched &= level.hole | level.source;
    cv::findNonZero(centers, sources_);
    cv::findNonZero(touched, targets_);
    is_source_ = centers;
    target_of_ = cv::Mat(level.rgb.size(), CV_32S, cv::Scalar(-1));
    for (size_t i = 0; i < targets_.size(); ++i) {
      target_of_.at<int>(targets_[i]) = static_cast<int>(i);
    }
    cv::Mat distance;
    cv::distanceTransform(level.hole, distance, cv::DIST_L2, 3);
    trust_.reserve(targets_.size());
    for (const cv::Point& target : targets_) {
      trust_.push_back(std::pow(kTrustFalloff, -distance.at<float>(target)));
    }
  }

  bool CanFill() const { return sources_.size() >= kFewestSources && !targets_.empty(); }

  // Starts from the coarser level's matches, or at random.
  void Start(const cv::Mat& coarse_match) {
    match_.resize(targets_.size());
    for (size_t i = 0; i < targets_.size(); ++i) {
      match_[i] = SourceBeside(targets_[i].y);
      if (coarse_match.empty()) continue;
      const cv::Point parent(targets_[i].x / 2, targets_[i].y / 2);
      const auto& from = coarse_match.at<cv::Vec2i>(parent);
      const cv::Point place(2 * from[0] + targets_[i].x % 2, 2 * from[1] + targets_[i].y % 2);
      if (from[0] >= 0 && IsSource(place)) match_[i] = place;
    }
    // What is in the hole so far is smooth, and would be matched with what is smooth.
    distance_.assign(targets_.size(), 0);
    Vote();
    Refresh();
  }

  void Round() {
    Refresh();
    for (int sweep = 0; sweep < kSweeps; ++sweep) Sweep(sweep % 2 == 0);
    Vote();
  }

  // Match of every target as Vec2i, (-1, -1) elsewhere.
  cv::Mat MatchField() const {
    cv::Mat field(level_.rgb.size(), CV_32SC2, cv::Scalar(-1, -1));
    for (size_t i = 0; i < targets_.size(); ++i) {
      field.at<cv::Vec2i>(targets_[i]) = cv::Vec2i(match_[i].x, match_[i].y);
    }
    return field;
  }

 private:
  bool IsSource(const cv::Point& at) const {
    return at.x >= 0 && at.y >= 0 && at.x < is_source_.cols && at.y < is_source_.rows &&
           is_source_.at<uint8_t>(at) != 0;
  }
  // One in the same row where there is any: on facades things lie in rows.
  cv::Point SourceBeside(int row) {
    const auto row_of = [](const cv::Point& at) { return at.y; };
    const auto first = std::ranges::lower_bound(sources_, row, {}, row_of);
    const auto last = std::ranges::upper_bound(sources_, row, {}, row_of);
    const auto count = static_cast<size_t>(last - first);
    return count > 0 ? first[random_() % count] : sources_[random_() % sources_.size()];
  }

  // Mean squared distance over the part of the target patch that is on the facet, the larger the
  // less of it the source has.
  float Distance(const cv::Point& target, const cv::Point& source, float limit) const {
    float sum = 0;
    int asked = 0;
    int compared = 0;
    const float stop = limit * (2 * kRadius + 1) * (2 * kRadius + 1);
    const cv::Rect inside({}, level_.rgb.size());
    for (int dy = -kRadius; dy <= kRadius; ++dy) {
      for (int dx = -kRadius; dx <= kRadius; ++dx) {
        const cv::Point at(target.x + dx, target.y + dy);
        if (!inside.contains(at)) continue;
        if (!level_.hole.at<uint8_t>(at) && !level_.source.at<uint8_t>(at)) continue;
        ++asked;
        const cv::Point from(source.x + dx, source.y + dy);
        if (!inside.contains(from) || !level_.source.at<uint8_t>(from)) continue;
        const cv::Vec3f d = level_.rgb.at<cv::Vec3f>(at) - level_.rgb.at<cv::Vec3f>(from);
        sum += d.dot(d);
        ++compared;
      }
      if (sum > stop) return std::numeric_limits<float>::max();
    }
    return sum * static_cast<float>(asked) / static_cast<float>(compared * compared);
  }

  void Refresh() {
    distance_.resize(targets_.size());
    for (size_t i = 0; i < targets_.size(); ++i) {
      distance_[i] = Distance(targets_[i], match_[i], std::numeric_limits<float>::max() / 100);
    }
  }

  void Try(size_t i, const cv::Point& source) {
    if (!IsSource(source) || source == match_[i]) return;
    const float distance = Distance(targets_[i], source, distance_[i]);
    if (distance < distance_[i]) {
      distance_[i] = distance;
      match_[i] = source;
    }
  }

  void Sweep(bool forward) {
    const cv::Point steps[2] = {{forward ? -1 : 1, 0}, {0, forward ? -1 : 1}};
    for (size_t k = 0; k < targets_.size(); ++k) {
      const size_t i = forward ? k : targets_.size() - 1 - k;
      for (const cv::Point& step : steps) {
        const cv::Point next = targets_[i] + step;
        if (next.x < 0 || next.y < 0 || next.x >= target_of_.cols || next.y >= target_of_.rows) {
          continue;
        }
        const int neighbour = target_of_.at<int>(next);
        if (neighbour >= 0) Try(i, match_[neighbour] - step);
      }
      Try(i, SourceBeside(targets_[i].y));
      for (int reach = std::max(level_.rgb.cols, level_.rgb.rows); reach >= 1; reach /= 2) {
        const int span = 2 * reach + 1;
        const cv::Point jump(static_cast<int>(random_() % span) - reach,
                             static_cast<int>(random_() % span) - reach);
        Try(i, match_[i] + jump);
      }
    }
  }

  // Every texel of the hole becomes the trusted mean of what its patches would put there.
  void Vote() {
    cv::Mat sum(level_.rgb.size(), CV_32FC3, cv::Scalar::all(0));
    cv::Mat weight(level_.rgb.size(), CV_32F, cv::Scalar(0));
    const cv::Rect inside({}, level_.rgb.size());
    for (size_t i = 0; i < targets_.size(); ++i) {
      const float w = trust_[i] / (1 + distance_[i] / 100);
      for (int dy = -kRadius; dy <= kRadius; ++dy) {
        for (int dx = -kRadius; dx <= kRadius; ++dx) {
          const cv::Point at(targets_[i].x + dx, targets_[i].y + dy);
          const cv::Point from(match_[i].x + dx, match_[i].y + dy);
          if (!inside.contains(at) || !inside.contains(from)) continue;
          if (!level_.hole.at<uint8_t>(at) || !level_.source.at<uint8_t>(from)) continue;
          sum.at<cv::Vec3f>(at) += w * level_.rgb.at<cv::Vec3f>(from);
          weight.at<float>(at) += w;
        }
      }
    }
    for (const cv::Point& target : targets_) {
      if (weight.at<float>(target) > 0) {
        level_.rgb.at<cv::Vec3f>(target) = sum.at<cv::Vec3f>(target) / weight.at<float>(target);
      }
    }
  }

  Level& level_;
  std::mt19937& random_;
  std::vector<cv::Point> sources_;
  std::vector<cv::Point> targets_;
  cv::Mat is_source_;
  cv::Mat target_of_;
  std::vector<float> trust_;
  std::vector<cv::Point> match_;
  std::vector<float> distance_;
};

// Halvings whose shorter side is at least kSmallestLevel, finest first.
std::vector<Level> MakeLevels(Level finest) {
  std::vector<Level> levels = {std::move(finest)};
  while (std::min(levels.back().rgb.cols, levels.back().rgb.rows) >= 2 * kSmallestLevel) {
    levels.push_back(Halved(levels.back()));
  }
  return levels;
}

// Fills the finest level; returns its field of matches, empty when nothing could be done.
cv::Mat Synthesize(std::vector<Level>& levels, uint32_t seed) {
  std::mt19937 random(seed);
  cv::Mat field;
  for (size_t k = levels.size(); k-- > 0;) {
    Level& level = levels[k];
    if (k + 1 < levels.size() && !field.empty()) {
      cv::Mat up;
      cv::resize(levels[k + 1].rgb, up, level.rgb.size(), 0, 0, cv::INTER_LINEAR);
      up.copyTo(level.rgb, level.hole);
    }
    Matcher matcher(level, random);
    if (!matcher.CanFill()) {
      field.release();
      continue;
    }
    matcher.Start(field);
    for (int round = 0; round < kVotingRounds; ++round) matcher.Round();
    field = matcher.MatchField();
  }
  return field;
}

// Brings the filled working picture back to full size, with the detail of the copied places.
void WriteBack(const Level& filled, const cv::Mat& field, const cv::Mat& hole, cv::Mat& full) {
  cv::Mat smooth;
  filled.rgb.convertTo(smooth, CV_8U);
  // Votes mix what patches say finer than themselves: that comes from the texel's own match alone.
  cv::GaussianBlur(smooth, smooth, {}, kRadius);
  cv::resize(smooth, smooth, full.size(), 0, 0, cv::INTER_CUBIC);
  const double sx = static_cast<double>(filled.rgb.cols) / full.cols;
  const double sy = static_cast<double>(filled.rgb.rows) / full.rows;
  const cv::Mat original = full.clone();
  for (int y = 0; y < full.rows; ++y) {
    for (int x = 0; x < full.cols; ++x) {
      if (!hole.at<uint8_t>(y, x)) continue;
      cv::Vec3i value = smooth.at<cv::Vec3b>(y, x);
      const cv::Point small(std::min(filled.rgb.cols - 1, static_cast<int>(x * sx)),
                            std::min(filled.rgb.rows - 1, static_cast<int>(y * sy)));
      const auto& from = field.at<cv::Vec2i>(small);
      const int fx = x + static_cast<int>(std::lround((from[0] - small.x) / sx));
      const int fy = y + static_cast<int>(std::lround((from[1] - small.y) / sy));
      if (from[0] >= 0 && fx >= 0 && fy >= 0 && fx < full.cols && fy < full.rows &&
          !hole.at<uint8_t>(fy, fx)) {
        value +=
            cv::Vec3i(original.at<cv::Vec3b>(fy, fx)) - cv::Vec3i(smooth.at<cv::Vec3b>(fy, fx));
      }
      full.at<cv::Vec3b>(y, x) = value;  // saturates
    }
  }
}

}  // namespace

void FillWithPatches(Image& picture, const std::vector<uint8_t>& hole,
                     const std::vector<uint8_t>& source, int max_side_px, uint32_t seed) {
  cv::Mat full(picture.height_px, picture.width_px, CV_8UC3, picture.data.data());
  const cv::Size size = full.size();
  const cv::Mat hole_mask = cv::Mat(size, CV_8U, const_cast<uint8_t*>(hole.data())) != 0;
  const cv::Mat source_mask = cv::Mat(size, CV_8U, const_cast<uint8_t*>(source.data())) != 0;
  const double scale =
      std::min(1.0, static_cast<double>(max_side_px) / std::max(size.width, size.height));
  const cv::Size small(std::max(1, static_cast<int>(std::lround(size.width * scale))),
                       std::max(1, static_cast<int>(std::lround(size.height * scale))));
  Level finest;
  cv::resize(full, finest.rgb, small, 0, 0, cv::INTER_AREA);
  finest.rgb.convertTo(finest.rgb, CV_32F);
  cv::Mat share;
  cv::resize(hole_mask, share, small, 0, 0, cv::INTER_AREA);
  finest.hole = share > 0;
  cv::resize(source_mask, share, small, 0, 0, cv::INTER_AREA);
  finest.source = (share == 255) & ~finest.hole;
  std::vector<Level> levels = MakeLevels(std::move(finest));
  const cv::Mat field = Synthesize(levels, seed);
  if (!field.empty()) WriteBack(levels.front(), field, hole_mask, full);
}

}  // namespace stucco
