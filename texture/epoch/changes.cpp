// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/epoch/changes.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "texture/light/colour.h"

namespace stucco {
namespace {

constexpr int kBlock = kChangeBlock;
constexpr int kPart = 4;  // of a block, a side
constexpr int kParts = kBlock / kPart;
constexpr double kLeastShown = 0.5;  // of a block's texels, by both
// Shade of eaves is believed down to a third of the encoded brightness: panes may be darker.
constexpr double kDeepestShade = 1.1;
// Logarithms of encoded colours, so that light is an offset; the offset keeps noise of black small.
constexpr double kDarkOffset = 8;
// The same white in the sun (5500 K) and under the sky alone (10000 K and more) differs by about
// 0.2 in this measure: logarithms of encoded red, green and blue less their mean.
constexpr double kOtherHue = 0.3;
// In the same measure, brightness included: a pane in a wall, a frame around it.
constexpr double kOtherThing = 0.5;
// Parts of a block that differ by less than this have no pattern (standard deviation of the
// logarithms): plaster, noise, the edge of a soft shadow.
constexpr double kContrast = 0.12;
constexpr double kSamePattern = 0.3;  // correlation
// Parts of a block with another hue that make its pattern one that no shadow draws.
constexpr int kPartsOfOtherHue = kParts * kParts / 4;
// What stands out of a facet covers less than this share of it from one side and not from another.
constexpr double kCoveredByRelief = 0.25;
// How far relief may look shifted, texels, and how well a block and what is around it must then
// agree.
constexpr int kReach = 24;
constexpr int kAround = 4;
constexpr double kFoundAgain = 0.7;
constexpr int kFewestNeighbours = 3;  // of the eight around a block that changed too

using Pattern = std::array<double, kParts * kParts>;

struct Block {
  bool shown = false;
  bool comparable = false;
  Eigen::Vector3d difference = Eigen::Vector3d::Zero();  // of log colours, after less before
  Eigen::Vector3f colour_before = Eigen::Vector3f::Zero();
  Pattern before = {};  // log brightness of its parts
  Pattern after = {};
  int parts_of_other_hue = 0;
};

// kColourAslant: in blocks that may not be compared but for their colour.
enum class Change : uint8_t { kNone, kColour, kPattern, kShade, kColourAslant };

// Means of a rectangle of texels that both show.
struct Means {
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  Eigen::Vector3d after = Eigen::Vector3d::Zero();
  int count = 0;
  int comparable = 0;
};

Eigen::Vector3d LogColour(const Eigen::Vector3d& mean) {
  return (mean.array() + kDarkOffset).log();
}

class Comparison {
 public:
  Comparison(const FacetPicture& before, const FacetPicture& after, std::span<const uint8_t> mask,
             std::span<const uint8_t> comparable)
      : before_(before),
        after_(after),
        mask_(mask),
        comparable_(comparable),
        width_(before.picture.width_px) {
    columns_ = (width_ + kBlock - 1) / kBlock;
    rows_ = (before.picture.height_px + kBlock - 1) / kBlock;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) blocks_.push_back(Look(column, row));
    }
  }

  FacetChanges Find() const {
    FacetChanges changes;
    size_t area = 0;
    size_t both = 0;
    size_t compared = 0;
    for (size_t i = 0; i < mask_.size(); ++i) {
      area += mask_[i] != 0;
      both += BothShow(i);
      compared += BothShow(i) && comparable_[i] != 0;
    }
    changes.block_columns = columns_;
    changes.outdated.assign(blocks_.size(), Eigen::Vector3f::Zero());
    if (area == 0) return changes;
    changes.compared = static_cast<double>(compared) / static_cast<double>(area);
    std::vector<Change> found = Together(Judge());
    size_t shown = 0;
    size_t aslant = 0;
    size_t colour_aslant = 0;
    size_t colour = 0;
    size_t pattern = 0;
    size_t shade = 0;
    for (size_t i = 0; i < blocks_.size(); ++i) {
      shown += blocks_[i].shown;
      aslant += blocks_[i].shown && !blocks_[i].comparable;
      colour_aslant += found[i] == Change::kColourAslant;
      colour += found[i] == Change::kColour;
      pattern += found[i] == Change::kPattern;
      shade += found[i] == Change::kShade;
    }
    if (shown == 0) return changes;
    if (static_cast<double>(colour_aslant) >= kCoveredByRelief * static_cast<double>(aslant)) {
      colour += colour_aslant;
    } else {
      std::ranges::replace(found, Change::kColourAslant, Change::kNone);
    }
    const double per_block = static_cast<double>(both) / static_cast<double>(area * shown);
    changes.repainted = per_block * static_cast<double>(colour);
    changes.other = per_block * static_cast<double>(pattern);
    changes.shaded = per_block * static_cast<double>(shade);
    changes.boxes = Boxes(found, per_block);
    changes.outdated = Outdated(found);
    return changes;
  }

 private:
  bool BothShow(size_t i) const {
    return mask_[i] != 0 && IsPainted(before_.labels[i]) && IsPainted(after_.labels[i]);
  }

  Means MeansOf(int x, int y, int side) const {
    Means means;
    for (int row = y; row < std::min(y + side, before_.picture.height_px); ++row) {
      for (int column = x; column < std::min(x + side, width_); ++column) {
        const size_t texel = static_cast<size_t>(row) * width_ + column;
        if (!BothShow(texel)) continue;
        means.comparable += comparable_[texel] != 0;
        const uint8_t* a = before_.picture.Pixel(column, row);
        const uint8_t* b = after_.picture.Pixel(column, row);
        means.before += Eigen::Vector3d(a[0], a[1], a[2]);
        means.after += Eigen::Vector3d(b[0], b[1], b[2]);
        ++means.count;
      }
    }
    if (means.count > 0) {
      means.before /= means.count;
      means.after /= means.count;
    }
    return means;
  }

  Block Look(int column, int row) const {
    Block block;
    const Means all = MeansOf(column * kBlock, row * kBlock, kBlock);
    if (all.count < kLeastShown * kBlock * kBlock) return block;
    block.shown = true;
    block.comparable = 2 * all.comparable >= all.count;
    block.difference = LogColour(all.after) - LogColour(all.before);
    block.colour_before = all.before.cast<float>();
    for (int part = 0; part < kParts * kParts; ++part) {
      Means means = MeansOf(column * kBlock + part % kParts * kPart,
                            row * kBlock + part / kParts * kPart, kPart);
      if (means.count == 0) means = all;
      const Eigen::Vector3d before = LogColour(means.before);
      const Eigen::Vector3d after = LogColour(means.after);
      block.before[part] = before.mean();
      block.after[part] = after.mean();
      block.parts_of_other_hue += HueOf(after - before).norm() > kOtherHue;
    }
    return block;
  }

  // Block by block, light taken off.
  std::vector<Change> Judge() const {
    std::vector<Change> found(blocks_.size(), Change::kNone);
    for (size_t i = 0; i < blocks_.size(); ++i) {
      if (!blocks_[i].shown) continue;
      const bool other_colour = HueOf(blocks_[i].difference).norm() > kOtherHue;
      if (!blocks_[i].comparable) {
        if (other_colour) found[i] = Change::kColourAslant;
      } else if (!GoTogether(blocks_[i].before, blocks_[i].after) &&
                 !IsFoundAgain(static_cast<int>(i))) {
        const bool other_hue = blocks_[i].parts_of_other_hue >= kPartsOfOtherHue;
        found[i] = other_hue ? Change::kPattern : Change::kShade;
      } else if (other_colour) {
        found[i] = Change::kColour;
      }
    }
    return found;
  }

  static bool GoTogether(const Pattern& before, const Pattern& after) {
    const Eigen::Map<const Eigen::ArrayXd> b(before.data(), kParts * kParts);
    const Eigen::Map<const Eigen::ArrayXd> a(after.data(), kParts * kParts);
    const Eigen::ArrayXd of_b = b - b.mean();
    const Eigen::ArrayXd of_a = a - a.mean();
    const double spread_b = std::sqrt(of_b.square().mean());
    const double spread_a = std::sqrt(of_a.square().mean());
    if (std::max(spread_a, spread_b) < kContrast) return true;
    return (of_a * of_b).mean() >= kSamePattern * spread_a * spread_b;
  }

  // Whether what a block shows now was there before, some texels beside.
  bool IsFoundAgain(int index) const {
    const cv::Rect whole(0, 0, width_, before_.picture.height_px);
    const cv::Rect block =
        cv::Rect(index % columns_ * kBlock - kAround, index / columns_ * kBlock - kAround,
                 kBlock + 2 * kAround, kBlock + 2 * kAround) &
        whole;
    const cv::Rect search = cv::Rect(block.x - kReach, block.y - kReach, block.width + 2 * kReach,
                                     block.height + 2 * kReach) &
                            whole;
    cv::Mat score;
    cv::matchTemplate(Grey(before_, search), Grey(after_, block), score, cv::TM_CCOEFF_NORMED);
    double best = 0;
    cv::minMaxLoc(score, nullptr, &best);
    return best >= kFoundAgain;
  }

  static cv::Mat Grey(const FacetPicture& facet, const cv::Rect& area) {
    const cv::Mat rgb(facet.picture.height_px, facet.picture.width_px, CV_8UC3,
                      const_cast<uint8_t*>(facet.picture.data.data()));
    cv::Mat grey;
    cv::cvtColor(rgb(area), grey, cv::COLOR_RGB2GRAY);
    return grey;
  }

  // Itself and its neighbours.
  int NumChangedAround(const std::vector<Change>& found, int row, int column) const {
    int count = 0;
    for (int y = std::max(0, row - 1); y <= std::min(rows_ - 1, row + 1); ++y) {
      for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x) {
        const Change change = found[static_cast<size_t>(y) * columns_ + x];
        count += IsChange(change);
      }
    }
    return count;
  }

  // Without what stands alone.
  std::vector<Change> Together(const std::vector<Change>& found) const {
    std::vector<Change> kept = found;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        Change& change = kept[static_cast<size_t>(row) * columns_ + column];
        if (change == Change::kShade) continue;
        if (NumChangedAround(found, row, column) - 1 < kFewestNeighbours) change = Change::kNone;
      }
    }
    return kept;
  }

  static bool IsChange(Change change) {
    return change != Change::kNone && change != Change::kShade;
  }

  // Of each block that both show the colour it had, where it changed; of the others what the
  // nearest such one says. Requires one that both show.
  std::vector<Eigen::Vector3f> Outdated(const std::vector<Change>& found) const {
    cv::Mat hidden(rows_, columns_, CV_8U);
    for (size_t i = 0; i < blocks_.size(); ++i) hidden.data[i] = blocks_[i].shown ? 0 : 1;
    cv::Mat distances, nearest;  // nearest: by number of the blocks that both show
    cv::distanceTransform(hidden, distances, nearest, cv::DIST_L2, cv::DIST_MASK_5,
                          cv::DIST_LABEL_PIXEL);
    std::vector<Eigen::Vector3f> of_number(blocks_.size() + 1, Eigen::Vector3f::Zero());
    const auto number_of = [&](size_t block) {
      return nearest.at<int>(static_cast<int>(block) / columns_,
                             static_cast<int>(block) % columns_);
    };
    for (size_t i = 0; i < blocks_.size(); ++i) {
      if (blocks_[i].shown && IsChange(found[i]))
        of_number[number_of(i)] = blocks_[i].colour_before;
    }
    std::vector<Eigen::Vector3f> outdated(blocks_.size());
    for (size_t i = 0; i < blocks_.size(); ++i) outdated[i] = of_number[number_of(i)];
    return outdated;
  }

  // What changed and lies together: blocks with no more than one between them, as frames of windows
  // keep their colour where all around them is painted over.
  std::vector<ChangedBox> Boxes(const std::vector<Change>& found, double share_of_block) const {
    cv::Mat changed(rows_, columns_, CV_8U);
    for (size_t i = 0; i < found.size(); ++i) changed.data[i] = IsChange(found[i]) ? 1 : 0;
    cv::dilate(changed, changed, cv::Mat());
    cv::Mat places;
    const int count = cv::connectedComponents(changed, places, 8, CV_32S);
    std::vector<cv::Rect> rects(count);
    std::vector<int> blocks(count, 0), patterns(count, 0);
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const int i = row * columns_ + column;
        if (!IsChange(found[i])) continue;
        const int place = places.at<int>(row, column);
        rects[place] |= cv::Rect(column * kBlock, row * kBlock, kBlock, kBlock);
        ++blocks[place];
        patterns[place] += found[i] == Change::kPattern;
      }
    }
    std::vector<ChangedBox> boxes;
    for (int place = 1; place < count; ++place) {
      const cv::Rect rect = rects[place] & cv::Rect(0, 0, width_, before_.picture.height_px);
      boxes.push_back({rect.x, rect.y, rect.width, rect.height, share_of_block * blocks[place],
                       2 * patterns[place] > blocks[place]});
    }
    std::ranges::stable_sort(boxes, std::greater(), &ChangedBox::share);
    return boxes;
  }

  const FacetPicture& before_;
  const FacetPicture& after_;
  std::span<const uint8_t> mask_;
  std::span<const uint8_t> comparable_;
  int width_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace

std::vector<uint8_t> PaintedTexels(const FacetPicture& facet) {
  std::vector<uint8_t> painted;
  painted.reserve(facet.labels.size());
  for (const uint8_t label : facet.labels) painted.push_back(IsPainted(label));
  return painted;
}

bool FacetChanges::IsOutdated(int x, int y, const uint8_t* before) const {
  const Eigen::Vector3f& colour =
      outdated[static_cast<size_t>(y / kChangeBlock) * block_columns + x / kChangeBlock];
  if (colour.isZero()) return false;
  const Eigen::Vector3d own(before[0], before[1], before[2]);
  const Eigen::Vector3d differs = LogColour(own) - LogColour(colour.cast<double>());
  const bool is_in_shade =
      HueOf(differs).norm() < kOtherHue && differs.mean() < 0 && differs.mean() > -kDeepestShade;
  return differs.norm() < kOtherThing || is_in_shade;
}

FacetChanges FindChanges(const FacetPicture& before, const FacetPicture& after,
                         std::span<const uint8_t> mask, std::span<const uint8_t> comparable) {
  assert(before.labels.size() == mask.size() && after.labels.size() == mask.size());
  assert(before.picture.data.size() == 3 * mask.size() &&
         after.picture.data.size() == 3 * mask.size());
  assert(comparable.size() == mask.size());
  return Comparison(before, after, mask, comparable).Find();
}

}  // namespace stucco
