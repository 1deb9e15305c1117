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

// For the classes of texts, and the pattern of no-fly areas.
inline constexpr char kMapStyle[] = R"svg(<style>
text{font-family:"Helvetica Neue",Helvetica,Arial,"DejaVu Sans",sans-serif;fill:#1f2328}
.title{font-size:27px;font-weight:600}
.figures{font-size:16px;fill:#3d444d}
.warning{font-size:13.5px;fill:#b3261e}
.heading{font-size:15px;font-weight:600}
.entry{font-size:13.5px}
.note{font-size:12px;fill:#59636e}
.tick{font-size:12px;text-anchor:middle}
.name{font-size:9px;text-anchor:middle;fill:#54545c}
.home{font-size:12px;font-weight:700;text-anchor:middle}
.small{font-size:9.5px}
</style>
<defs><pattern id="nofly" width="9" height="9"
 patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
<rect width="9" height="9" fill="#c0392b" fill-opacity="0.10"/>
<path d="M0 0V9" stroke="#c0392b" stroke-width="2.4" stroke-opacity="0.55"/></pattern></defs>
)svg";

// Every page; pixels.
inline constexpr double kPageWidth = 1600;
inline constexpr double kMargin = 24;
inline constexpr double kTallestMap = 1250;

// Trees, cranes, wires.
inline constexpr char kObstacleLook[] =
    "fill=\"#cfe3c4\" fill-rule=\"evenodd\" stroke=\"#7f9c70\" stroke-width=\"0.5\"";

// Link photos, and those that too few should match.
inline constexpr char kLinkLook[] =
    "fill=\"#7b3294\" fill-opacity=\"0.45\" stroke=\"#7b3294\" stroke-width=\"0.5\"";
inline constexpr char kLooseLook[] =
    "class=\"loose\" fill=\"none\" stroke=\"#e6007e\" stroke-width=\"1.4\"";

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
