// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "plan/output/colors.h"
#include "plan/output/stats.h"
#include "survey/plan.h"

namespace stucco::plan::internal {

// For text and attributes; what is no printable UTF-8 becomes "?".
std::string EscapeXml(std::string_view text);

// The data of a path element: many shapes of one look in one element keep files small. Pixels have
// two digits and are written relative to the point before.
class PathData {
 public:
  void MoveTo(const Eigen::Vector2d& point) { Add('m', point); }
  void LineTo(const Eigen::Vector2d& point) { Add('l', point); }
  void Close();
  void Dot(const Eigen::Vector2d& point);  // with round caps
  void Ring(const std::vector<Eigen::Vector2d>& points);
  void Polyline(const std::vector<Eigen::Vector2d>& points);
  const std::string& text() const { return text_; }
  bool IsEmpty() const { return text_.empty(); }

 private:
  void Add(char command, const Eigen::Vector2d& point);

  std::string text_;
  // In hundredths of a pixel, as written: rounding does not add up.
  Eigen::Array2i at_ = Eigen::Array2i::Zero();
  Eigen::Array2i start_ = Eigen::Array2i::Zero();
};

class Svg {
 public:
  template <typename... Args>
  void Add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
  }
  // Nothing for an empty path.
  void Path(const PathData& data, std::string_view attributes);
  void Text(const Eigen::Vector2d& at, std::string_view style, std::string_view text);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

// Trees, cranes, wires.
inline constexpr char kObstacleLook[] =
    "fill=\"#cfe3c4\" fill-rule=\"evenodd\" stroke=\"#7f9c70\" stroke-width=\"0.5\"";

// From the frame of the plan to the page, and what sizes suit the map.
struct MapScale {
  Eigen::Vector2d south_west_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d north_east_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d corner_px = Eigen::Vector2d::Zero();  // of the map, top left
  double px_per_m = 1;
  double stroke_px = 1;  // of a facade

  double Width() const { return (north_east_m.x() - south_west_m.x()) * px_per_m; }
  double Height() const { return (north_east_m.y() - south_west_m.y()) * px_per_m; }
  Eigen::Vector2d Page(const Eigen::Vector2d& point) const {
    return corner_px +
           px_per_m * Eigen::Vector2d(point.x() - south_west_m.x(), north_east_m.y() - point.y());
  }
  std::vector<Eigen::Vector2d> Page(const std::vector<Eigen::Vector2d>& points) const;
};

MapScale FitMap(const Plan& plan, const Eigen::Vector2d& corner_px,
                const Eigen::Vector2d& largest_px);
void DrawMap(const Plan& plan, const MapScale& scale, Svg& svg);
void DrawLegend(const Plan& plan, const PlanStats& stats, const Eigen::Vector2d& corner_px,
                Svg& svg);
void DrawScaleBar(const MapScale& scale, Svg& svg);

}  // namespace stucco::plan::internal
