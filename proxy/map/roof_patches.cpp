// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/roof_patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace stucco {
namespace {

constexpr size_t kRectangleCorners = 4;
constexpr double kLeastSide = 4;  // of a patch, levels of detail
constexpr double kLow_m = 0.6;
constexpr double kSmall_m2 = 6;
// A parapet and what smears its points over the roof behind it.
constexpr double kLevel = 0.1;      // slope of a roof that has one
constexpr double kParapet_m = 1.2;  // its height
constexpr double kParapetWidth_m = 1;
constexpr double kParapetSlope_m = 2.5;  // width of a strip that rises to it
constexpr double kSameHeight_m = 0.3;
constexpr double kOutwards = 0.7;  // cosine
constexpr double kReach = 3;       // a rectangle may go so many levels of detail beyond its patch
constexpr double kCorner = 1.5;    // what a corner less is worth, times the level of detail squared

// Connected cells of one label.
struct Patch {
  std::vector<int> cells;  // ascending
  int label = 0;
  int around = -1;      // the label that most of its border meets; -1: there is no other
  double border_m = 0;  // where it ends with the footprint
  Eigen::Vector2d border_middle = Eigen::Vector2d::Zero();

  bool AtBorder() const { return border_m > 0; }
};

// A line across the patch, and on which side of it the cells that matter lie.
struct Side {
  double at = 0;             // along the direction across it
  std::vector<bool> beyond;  // by cell that matters: farther along that direction
};

class Tidier {
 public:
  Tidier(const PatchInput& input, std::vector<int>& labels)
      : input_(input), labels_(labels), none_(static_cast<int>(input.roofs.size())) {
    const CellProblem& problem = input.problem;
    links_of_cell_.resize(problem.data.size());
    for (size_t l = 0; l < problem.links.size(); ++l) {
      links_of_cell_[problem.links[l].a].push_back(l);
      links_of_cell_[problem.links[l].b].push_back(l);
    }
    border_of_cell_.resize(problem.data.size());
    for (const Arrangement::Edge& edge : input.arrangement.edges) {
      const int left = CellOf(edge.left);
      const int right = CellOf(edge.right);
      if (left >= 0 && right >= 0) length_of_link_.push_back(LengthOf(edge));
      if (left >= 0 && right < 0) border_of_cell_[left].push_back(&edge);
      if (right >= 0 && left < 0) border_of_cell_[right].push_back(&edge);
    }
    assert(length_of_link_.size() == problem.links.size());
  }

  void Run() {
    std::vector<bool> done(labels_.size(), false);
    for (size_t cell = 0; cell < labels_.size(); ++cell) {
      if (done[cell]) continue;
      const Patch patch = PatchAt(static_cast<int>(cell));
      for (const int c : patch.cells) done[c] = true;
      if (patch.around < 0 || patch.around == none_ || patch.label == none_) continue;
      if (MayGo(patch) && (IsSlight(patch) || IsRim(patch) || IsNotWorthIt(patch))) {
        for (const int c : patch.cells) labels_[c] = patch.around;
      } else if (!patch.AtBorder()) {
        Square(patch);
      }
    }
  }

 private:
  double LengthOf(const Arrangement::Edge& edge) const {
    return (input_.arrangement.vertices[edge.to] - input_.arrangement.vertices[edge.from]).norm();
  }

  int CellOf(int face) const { return face < 0 ? -1 : input_.cell_of_face[face]; }

  Eigen::Vector2d MiddleOf(int cell) const {
    return InnerPoint(input_.arrangement, input_.face_of_cell[cell]);
  }

  int Other(size_t link, int cell) const {
    const CellProblem::Link& ends = input_.problem.links[link];
    return ends.a == cell ? ends.b : ends.a;
  }

  Patch PatchAt(int start) const {
    Patch patch;
    patch.label = labels_[start];
    std::vector<bool> reached(labels_.size(), false);
    std::vector<int> open = {start};
    reached[start] = true;
    std::map<int, double> border_m;  // by label beyond it
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      patch.cells.push_back(cell);
      for (const Arrangement::Edge* edge : border_of_cell_[cell]) {
        const double length = LengthOf(*edge);
        patch.border_m += length;
        patch.border_middle +=
            length / 2 *
            (input_.arrangement.vertices[edge->from] + input_.arrangement.vertices[edge->to]);
      }
      for (const size_t link : links_of_cell_[cell]) {
        const int next = Other(link, cell);
        if (labels_[next] != patch.label) {
          border_m[labels_[next]] += length_of_link_[link];
        } else if (!reached[next]) {
          reached[next] = true;
          open.push_back(next);
        }
      }
    }
    std::ranges::sort(patch.cells);
    if (patch.AtBorder()) patch.border_middle /= patch.border_m;
    if (border_m.empty()) return patch;
    patch.around =
        std::ranges::max_element(border_m, {}, [](const auto& b) { return b.second; })->first;
    return patch;
  }

  Eigen::Vector2d CentroidOf(const Patch& patch) const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double area = 0;
    for (const int cell : patch.cells) {
      const double of_cell = SignedArea(RingOf(input_.arrangement, input_.face_of_cell[cell]));
      sum += of_cell * MiddleOf(cell);
      area += of_cell;
    }
    return sum / area;
  }

  double AreaOf(const Patch& patch) const {
    double area = 0;
    for (const int cell : patch.cells) {
      area += SignedArea(RingOf(input_.arrangement, input_.face_of_cell[cell]));
    }
    return area;
  }

  bool MayGo(const Patch& patch) const {
    return std::ranges::all_of(patch.cells, [&](int cell) {
      return input_.problem.data[cell][patch.around] < input_.forbidden;
    });
  }

  // How far the patch lies above what is around it: least and most over its corners.
  std::pair<double, double> StepOf(const Patch& patch) const {
    std::pair<double, double> step(std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity());
    for (const int cell : patch.cells) {
      for (const int v : input_.arrangement.faces[input_.face_of_cell[cell]]) {
        const Eigen::Vector2d& p = input_.arrangement.vertices[v];
        const double above = input_.roofs[patch.label].At(p) - input_.roofs[patch.around].At(p);
        step = {std::min(step.first, above), std::max(step.second, above)};
      }
    }
    return step;
  }

  bool IsSlight(const Patch& patch) const {
    const double area = AreaOf(patch);
    if (area < std::pow(kLeastSide * input_.level_of_detail, 2)) return true;
    if (area > kSmall_m2) return false;
    const auto [low, high] = StepOf(patch);
    return std::max(-low, high) < kLow_m;
  }

  // Whether it is a parapet of the level roof around it: a strip along the footprint's border, a
  // little above the roof, or rising from it to there.
  bool IsRim(const Patch& patch) const {
    if (!patch.AtBorder() || input_.roofs[patch.around].slope.norm() > kLevel) return false;
    const auto [low, high] = StepOf(patch);
    if (low < -kSameHeight_m || high > kParapet_m) return false;
    const double width = AreaOf(patch) / patch.border_m;
    const Eigen::Vector2d& slope = input_.roofs[patch.label].slope;
    if (slope.norm() < kLevel) return width < kParapetWidth_m;
    const Eigen::Vector2d outwards = patch.border_middle - CentroidOf(patch);
    return width < kParapetSlope_m &&
           slope.dot(outwards) > kOutwards * slope.norm() * outwards.norm();
  }

  // Corners of what cells of this label make of `cells`.
  size_t CornersOf(const std::vector<int>& cells, const std::vector<int>& labels, int label) const {
    std::vector<bool> inside(input_.arrangement.faces.size(), false);
    for (const int cell : cells) {
      inside[input_.face_of_cell[cell]] = labels[cell] == label;
    }
    size_t corners = 0;
    for (const Polygon& polygon : UnionOf(input_.arrangement, inside)) {
      for (const Ring& ring : polygon.rings) corners += ring.size();
    }
    return corners;
  }

  // Whether the corners that it has more than a rectangle cost more than the patch explains.
  bool IsNotWorthIt(const Patch& patch) const {
    const size_t corners = CornersOf(patch.cells, labels_, patch.label);
    if (corners <= kRectangleCorners) return false;
    std::vector<int> without = labels_;
    for (const int cell : patch.cells) without[cell] = patch.around;
    const double cost = kCorner * std::pow(input_.level_of_detail, 2) *
                        static_cast<double>(corners - kRectangleCorners);
    return CostOf(patch.cells, without) < CostOf(patch.cells, labels_) + cost;
  }

  // What the labels cost on these cells and where they meet others.
  double CostOf(const std::vector<int>& cells, const std::vector<int>& labels) const {
    const CellProblem& problem = input_.problem;
    std::vector<size_t> links;
    double cost = 0;
    for (const int cell : cells) {
      cost += problem.data[cell][labels[cell]];
      links.insert(links.end(), links_of_cell_[cell].begin(), links_of_cell_[cell].end());
    }
    std::ranges::sort(links);
    links.erase(std::unique(links.begin(), links.end()), links.end());
    for (const size_t link : links) {
      cost += problem.border(link, labels[problem.links[link].a], labels[problem.links[link].b]);
    }
    return cost;
  }

  // Along one direction: the patch and what lies within reach of it.
  struct Span {
    double from = std::numeric_limits<double>::infinity();
    double to = -std::numeric_limits<double>::infinity();
  };

  Span SpanOf(const Patch& patch, const Eigen::Vector2d& direction) const {
    Span span;
    for (const int cell : patch.cells) {
      for (const int v : input_.arrangement.faces[input_.face_of_cell[cell]]) {
        const double at = direction.dot(input_.arrangement.vertices[v]);
        span.from = std::min(span.from, at);
        span.to = std::max(span.to, at);
      }
    }
    span.from -= kReach * input_.level_of_detail;
    span.to += kReach * input_.level_of_detail;
    return span;
  }

  // Lines across `direction` within the span, nearest the beginning first.
  std::vector<Side> SidesAcross(const Eigen::Vector2d& direction, const Span& span,
                                const Eigen::Vector2d& middle,
                                const std::vector<int>& cells) const {
    constexpr double kAlong = 0.02;  // sine of the angle to the axis
    std::vector<Side> sides;
    for (const CutLine& line : input_.lines) {
      if (std::abs(line.direction.dot(direction)) > kAlong) continue;
      Eigen::Vector2d normal(line.direction.y(), -line.direction.x());
      if (normal.dot(direction) < 0) normal = -normal;
      const double before = normal.dot(line.point - middle);
      Side side;
      side.at = direction.dot(middle) + before;
      if (side.at < span.from || side.at > span.to) continue;
      for (const int cell : cells) {
        side.beyond.push_back(normal.dot(MiddleOf(cell) - line.point) > 0);
      }
      sides.push_back(std::move(side));
    }
    std::ranges::stable_sort(sides, {}, &Side::at);
    return sides;
  }

  std::vector<int> CellsWithin(const Span& along, const Span& across,
                               const std::array<Eigen::Vector2d, 2>& axes) const {
    std::vector<int> cells;
    for (size_t cell = 0; cell < labels_.size(); ++cell) {
      const Eigen::Vector2d middle = MiddleOf(static_cast<int>(cell));
      const double u = axes[0].dot(middle);
      const double v = axes[1].dot(middle);
      if (u < along.from || u > along.to || v < across.from || v > across.to) continue;
      cells.push_back(static_cast<int>(cell));
    }
    return cells;
  }

  // The patch within the rectangle, and nowhere else.
  std::vector<int> Squared(const Patch& patch, const std::vector<int>& cells,
                           const std::array<const Side*, 4>& sides) const {
    std::vector<int> labels = labels_;
    for (const int cell : patch.cells) labels[cell] = patch.around;
    for (size_t i = 0; i < cells.size(); ++i) {
      const bool inside = sides[0]->beyond[i] && !sides[1]->beyond[i] && sides[2]->beyond[i] &&
                          !sides[3]->beyond[i];
      if (inside && labels[cells[i]] != none_) labels[cells[i]] = patch.label;
    }
    return labels;
  }

  void Square(const Patch& patch) {
    const size_t corners = CornersOf(patch.cells, labels_, patch.label);
    if (corners <= kRectangleCorners) return;
    const Eigen::Vector2d u = input_.axis;
    const std::array<Eigen::Vector2d, 2> axes = {u, Eigen::Vector2d(-u.y(), u.x())};
    const Span along = SpanOf(patch, axes[0]);
    const Span across = SpanOf(patch, axes[1]);
    const std::vector<int> cells = CellsWithin(along, across, axes);
    const Eigen::Vector2d middle =
        axes[0] * ((along.from + along.to) / 2) + axes[1] * ((across.from + across.to) / 2);
    const std::vector<Side> us = SidesAcross(axes[0], along, middle, cells);
    const std::vector<Side> vs = SidesAcross(axes[1], across, middle, cells);
    double least = std::numeric_limits<double>::infinity();
    std::vector<int> best;
    ForEachRectangle(us, vs, [&](const std::array<const Side*, 4>& sides) {
      std::vector<int> labels = Squared(patch, cells, sides);
      const double cost = CostOf(cells, labels);
      if (cost >= least) return;
      least = cost;
      best = std::move(labels);
    });
    if (best.empty()) return;
    const size_t left = CornersOf(cells, best, patch.label);
    if (left == 0 || left >= corners) return;
    const double saved =
        kCorner * std::pow(input_.level_of_detail, 2) * static_cast<double>(corners - left);
    if (least < CostOf(cells, labels_) + saved) labels_ = std::move(best);
  }

  template <typename Visit>
  static void ForEachRectangle(const std::vector<Side>& us, const std::vector<Side>& vs,
                               const Visit& visit) {
    for (size_t a = 0; a < us.size(); ++a) {
      for (size_t b = a + 1; b < us.size(); ++b) {
        for (size_t c = 0; c < vs.size(); ++c) {
          for (size_t d = c + 1; d < vs.size(); ++d) visit({&us[a], &us[b], &vs[c], &vs[d]});
        }
      }
    }
  }

  const PatchInput& input_;
  std::vector<int>& labels_;
  const int none_;  // the label of no roof
  std::vector<std::vector<size_t>> links_of_cell_;
  std::vector<double> length_of_link_;
  std::vector<std::vector<const Arrangement::Edge*>> border_of_cell_;  // of the footprint
};

}  // namespace

void TidyPatches(const PatchInput& input, std::vector<int>& labels) {
  assert(labels.size() == input.problem.data.size());
  Tidier(input, labels).Run();
}

}  // namespace stucco
