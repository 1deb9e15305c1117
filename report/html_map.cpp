// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "report/internal/html_sections.h"
#include "survey/escape.h"
#include "survey/numbers.h"

namespace stucco::internal {
namespace {

constexpr double kWidth = 520;
constexpr double kHighest = 380;
constexpr double kMargin = 24;

using Points2 = std::vector<Eigen::Vector2d>;

// Looks down on the world: east right and north up where these are known, else the model's longer
// side lies across.
class GroundPlan {
 public:
  explicit GroundPlan(const SurveyData& data) {
    const Eigen::Vector3d up = data.proxy->up.normalized();
    const bool knows_north = data.georef && data.georef->frame == "enu";
    right_ = knows_north ? Eigen::Vector3d::UnitX() : up.unitOrthogonal();
    right_ = (right_ - right_.dot(up) * up).normalized();
    ahead_ = up.cross(right_);
    const Points2 outline = FacetPoints(*data.proxy);
    if (!knows_north) TurnLongerSideAcross(outline);
    Frame(FacetPoints(*data.proxy), data.photos);
  }

  bool IsDrawable() const { return std::isfinite(scale_) && scale_ > 0; }
  double scale() const { return scale_; }
  double height() const { return height_; }

  // World -> picture, y downwards.
  Eigen::Vector2d operator()(const Eigen::Vector3d& point) const {
    const Eigen::Vector2d flat = Flat(point);
    return {kMargin + (flat.x() - low_.x()) * scale_,
            height_ - kMargin - (flat.y() - low_.y()) * scale_};
  }

 private:
  Eigen::Vector2d Flat(const Eigen::Vector3d& point) const {
    return {right_.dot(point), ahead_.dot(point)};
  }

  Points2 FacetPoints(const Proxy& proxy) const {
    Points2 all;
    Points2 without_ground;
    for (const Building& building : proxy.buildings) {
      for (const Facet& facet : building.facets) {
        for (const Eigen::Vector3d& vertex : facet.outer) {
          all.push_back(Flat(vertex));
          if (facet.facet_class != FacetClass::kGround) without_ground.push_back(all.back());
        }
      }
    }
    return without_ground.empty() ? all : without_ground;
  }

  void TurnLongerSideAcross(const Points2& points) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& point : points) mean += point / static_cast<double>(points.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const auto& point : points) spread += (point - mean) * (point - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    const Eigen::Vector2d along = axes.eigenvectors().col(1);
    const Eigen::Vector3d turned = along.x() * right_ + along.y() * ahead_;
    const Eigen::Vector3d up = right_.cross(ahead_);
    right_ = turned.normalized();
    ahead_ = up.cross(right_);
  }

  // The facets, and the cameras that are not far away from them.
  void Frame(const Points2& points, const std::vector<SurveyPhoto>& photos) {
    if (points.empty()) return;
    Eigen::Vector2d low = points.front();
    Eigen::Vector2d high = points.front();
    for (const auto& point : points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    const double reach = 1.5 * (high - low).maxCoeff();
    const Eigen::Vector2d facets_low = low;
    const Eigen::Vector2d facets_high = high;
    for (const SurveyPhoto& photo : photos) {
      const Eigen::Vector2d at = Flat(photo.cam_from_world.Center());
      const bool near = (at.array() > facets_low.array() - reach).all() &&
                        (at.array() < facets_high.array() + reach).all();
      if (!near) continue;
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    const Eigen::Vector2d size = high - low;
    scale_ = std::min((kWidth - 2 * kMargin) / std::max(size.x(), 1e-12),
                      (kHighest - 2 * kMargin) / std::max(size.y(), 1e-12));
    height_ = std::max(120.0, size.y() * scale_ + 2 * kMargin);
    // A model narrower than the picture stands in its middle.
    low.x() -= ((kWidth - 2 * kMargin) / scale_ - size.x()) / 2;
    low.y() -= ((height_ - 2 * kMargin) / scale_ - size.y()) / 2;
    low_ = low;
  }

  Eigen::Vector3d right_;
  Eigen::Vector3d ahead_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  double scale_ = 0;
  double height_ = 0;
};

std::string Outline(const Facet& facet, const GroundPlan& plan) {
  std::string points;
  for (const Eigen::Vector3d& vertex : facet.outer) {
    const Eigen::Vector2d at = plan(vertex);
    points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", at.x(), at.y());
  }
  return points;
}

// A wall from above is the line between its two farthest vertices.
std::pair<Eigen::Vector2d, Eigen::Vector2d> WallLine(const Facet& facet, const GroundPlan& plan,
                                                     const Eigen::Vector3d& up) {
  const Eigen::Vector3d along = up.cross(facet.normal);
  const auto [low, high] = std::minmax_element(
      facet.outer.begin(), facet.outer.end(),
      [&](const auto& a, const auto& b) { return along.dot(a) < along.dot(b); });
  return {plan(*low), plan(*high)};
}

std::string WallElement(const PageContent& page, size_t index, const GroundPlan& plan) {
  const FacetRow& row = page.rows[index];
  const auto [a, b] = WallLine(*row.facet, plan, page.data.proxy->up);
  return fmt::format(
      "<g class=\"wall {}\" data-open=\"{}\"><title>{}: {}</title>"
      "<path class=\"touch\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>"
      "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/></g>",
      Name(row.verdict), index, EscapeHtml(row.id), VerdictLabel(row.verdict), a.x(), a.y(), b.x(),
      b.y(), a.x(), a.y(), b.x(), b.y());
}

// 1, 2 or 5 times a power of ten, about a quarter of the picture wide.
std::string ScaleBar(const GroundPlan& plan, bool metric) {
  const double wanted = kWidth / 4 / plan.scale();
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  const double step = wanted / power >= 5 ? 5 : wanted / power >= 2 ? 2 : 1;
  const double length = step * power;
  const double width = length * plan.scale();
  const double y = plan.height() - 8;
  return fmt::format(
      "<path class=\"scale\" d=\"M8 {0:.1f}v-5h{1:.1f}v5\"/><text x=\"{2:.1f}\" "
      "y=\"{0:.1f}\">{3:g} "
      "{4}</text>",
      y, width, width + 14, length, metric ? "m" : "units");
}

}  // namespace

std::string SiteMap(const PageContent& page) {
  if (!page.data.proxy || page.data.proxy->buildings.empty()) return "";
  const GroundPlan plan(page.data);
  if (!plan.IsDrawable()) return "";
  std::string roofs;
  std::string walls;
  for (size_t i = 0; i < page.rows.size(); ++i) {
    const Facet* facet = page.rows[i].facet;
    if (facet == nullptr || facet->outer.empty()) continue;
    if (facet->facet_class == FacetClass::kWall) {
      walls += WallElement(page, i, plan);
    } else if (facet->facet_class == FacetClass::kRoof) {
      roofs += fmt::format("<polygon points=\"{}\"/>", Outline(*facet, plan));
    }
  }
  std::string cameras;
  for (const SurveyPhoto& photo : page.data.photos) {
    const Eigen::Vector2d at = plan(photo.cam_from_world.Center());
    if (at.x() < 0 || at.x() > kWidth || at.y() < 0 || at.y() > plan.height()) continue;
    cameras += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\"/>", at.x(), at.y());
  }
  const bool knows_north = page.data.georef && page.data.georef->frame == "enu";
  return fmt::format(
      "<figure class=\"map\"><svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"The site "
      "from above: walls in the colour of their verdict\"><g class=\"roofs\">{}</g>"
      "<g class=\"cameras\">{}</g><g class=\"walls\">{}</g>{}{}</svg><figcaption>From above{}: "
      "walls in the colour of their verdict{}. Click a wall to open it.</figcaption></figure>",
      kWidth, plan.height(), roofs, cameras, walls, ScaleBar(plan, page.data.metric),
      knows_north ? "<path class=\"north\" d=\"M502 34v-22m-5 7l5-7l5 7\"/><text x=\"497\" "
                    "y=\"48\">N</text>"
                  : "",
      knows_north ? ", north is up" : "", cameras.empty() ? "" : ", dots are camera positions");
}

}  // namespace stucco::internal
