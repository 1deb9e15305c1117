// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/ground_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "survey/error.h"
#include "survey/escape.h"
#include "survey/text.h"

namespace stucco {
namespace {

constexpr size_t kNumbers = 5;  // coordinates and pixel, before the photo's name
constexpr size_t kHeight = 2;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr char kForm[] =
    "a line is \"x y z pixel_x pixel_y photo [name] [check]\", with blanks or tabs between";

std::vector<std::string_view> Split(std::string_view line, std::string_view separators) {
  std::vector<std::string_view> fields;
  while (!line.empty()) {
    const size_t end = std::min(line.find_first_of(separators), line.size());
    const std::string_view field = Trim(line.substr(0, end));
    if (!field.empty()) fields.push_back(field);
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return fields;
}

// Names with blanks can be read where tabs part the fields.
std::vector<std::string_view> FieldsOf(std::string_view line) {
  std::vector<std::string_view> fields = Split(line, "\t");
  return fields.size() > kNumbers ? fields : Split(line, " \t");
}

std::optional<PointRole> RoleIn(std::string_view field) {
  const std::string word = LowerCase(field);
  if (word == "check") return PointRole::kCheck;
  if (word == "control") return PointRole::kControl;
  return std::nullopt;
}

PointRole RoleByName(std::string_view name) {
  const std::string lower = LowerCase(name);
  const bool is_check = lower.starts_with("chk") || lower.starts_with("check");
  return is_check ? PointRole::kCheck : PointRole::kControl;
}

struct PointLine {
  Eigen::Vector3d coordinates = Eigen::Vector3d::Zero();
  PointMarking marking;
  std::string name;  // empty: none
  std::optional<PointRole> role;
  std::string problem;  // why it is none
};

PointLine ReadLine(std::string_view line, int number) {
  PointLine result;
  result.marking.line = number;
  const std::vector<std::string_view> fields = FieldsOf(line);
  if (fields.size() <= kNumbers) {
    result.problem = fmt::format("has {} fields, at least 6 are needed; {}", fields.size(), kForm);
    return result;
  }
  double numbers[kNumbers] = {};
  for (size_t i = 0; i < kNumbers; ++i) {
    const auto value = ParseNumber<double>(fields[i]);
    if (i == kHeight && value && std::isnan(*value)) {
      result.problem = "has no height, and a point without one holds nothing; give its height";
    } else if (!value || !std::isfinite(*value)) {
      result.problem =
          fmt::format("\"{}\" is no number; decimals need a point, and {}", fields[i], kForm);
    }
    if (!result.problem.empty()) return result;
    numbers[i] = *value;
  }
  result.coordinates = {numbers[0], numbers[1], numbers[2]};
  result.marking.pixel = {numbers[3], numbers[4]};
  result.marking.photo = fields[kNumbers];
  for (size_t i = kNumbers + 1; i < fields.size(); ++i) {
    if (const auto role = RoleIn(fields[i])) {
      if (!result.role) result.role = role;
    } else if (result.name.empty()) {
      result.name = fields[i];
    }
  }
  return result;
}

// Builds points from lines, each of which is one marking.
class ListBuilder {
 public:
  explicit ListBuilder(std::string file) : file_(std::move(file)) {}

  void Add(std::string_view text, int number) {
    const PointLine line = ReadLine(text, number);
    if (!line.problem.empty()) return Refuse(number, line.problem);
    const auto known =
        std::ranges::find_if(points_, [&](const BuiltPoint& point) { return IsOf(line, point); });
    if (known == points_.end()) {
      AddPoint(line);
    } else {
      AddMarking(line, *known);
    }
  }

  GroundControlList Build(std::string crs) {
    GroundControlList list{std::move(crs), {}, std::move(problems_)};
    for (BuiltPoint& built : points_) {
      built.point.role = built.role.value_or(RoleByName(built.point.name));
      list.points.push_back(std::move(built.point));
    }
    return list;
  }

 private:
  struct BuiltPoint {
    SurveyedPoint point;
    bool is_named = false;
    std::optional<PointRole> role;
  };

  // Points without a name are the same where their coordinates are.
  static bool IsOf(const PointLine& line, const BuiltPoint& built) {
    if (line.name.empty()) {
      return !built.is_named && built.point.coordinates == line.coordinates;
    }
    return built.is_named && built.point.name == line.name;
  }

  void AddPoint(const PointLine& line) {
    BuiltPoint& built = points_.emplace_back();
    built.is_named = !line.name.empty();
    built.point.name = built.is_named ? line.name : fmt::format("line-{}", line.marking.line);
    built.point.coordinates = line.coordinates;
    built.point.markings.push_back(line.marking);
    built.role = line.role;
  }

  void AddMarking(const PointLine& line, BuiltPoint& built) {
    SurveyedPoint& point = built.point;
    const int first = point.markings.front().line;
    if (point.coordinates != line.coordinates) {
      return Refuse(line.marking.line,
                    fmt::format("point {} has other coordinates in line {}; correct one of them, "
                                "or give another name",
                                point.name, first));
    }
    const auto same = std::ranges::find_if(point.markings, [&](const PointMarking& marking) {
      return marking.photo == line.marking.photo;
    });
    if (same != point.markings.end()) {
      return Refuse(line.marking.line,
                    fmt::format("point {} is marked in {} by line {} already; delete one of them",
                                point.name, line.marking.photo, same->line));
    }
    point.markings.push_back(line.marking);
    if (line.role && built.role && *line.role != *built.role) {
      // The careful choice: a check point can spoil nothing.
      built.role = PointRole::kCheck;
      problems_.push_back(fmt::format(
          "{}, line {}: point {} is control and check in different lines; it is a check point",
          file_, line.marking.line, point.name));
    } else if (line.role) {
      built.role = line.role;
    }
  }

  void Refuse(int number, const std::string& why) {
    problems_.push_back(fmt::format("{}, line {}: {}", file_, number, why));
  }

  std::string file_;
  std::vector<BuiltPoint> points_;
  std::vector<std::string> problems_;
};

}  // namespace

GroundControlList ParseGroundControl(std::string_view text, const std::string& file) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  ListBuilder builder(file);
  std::string crs;
  for (int number = 1; !text.empty(); ++number) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string line = CleanUtf8(Trim(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.starts_with('#')) continue;
    if (!crs.empty()) {
      builder.Add(line, number);
    } else if (ReadLine(line, number).problem.empty()) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}, line {}: is a point, but the first line has to name the "
                              "coordinate system",
                              file, number),
                  "begin the file with a line such as EPSG:25832 or WGS84 UTM 32N");
    } else {
      crs = line;
    }
  }
  GroundControlList list = builder.Build(crs);
  if (list.points.empty()) {
    throw Error(ErrorKind::kBadInput,
                list.problems.empty()
                    ? fmt::format("{}: has no points", file)
                    : fmt::format("{}: no line is a point; {}", file, list.problems.front()),
                kForm);
  }
  return list;
}

std::string GroundControlText(const GroundControlList& list) {
  std::string text = list.crs + "\n";
  for (const SurveyedPoint& point : list.points) {
    for (const PointMarking& marking : point.markings) {
      assert(marking.photo.find_first_of(" \t") == std::string::npos);
      text += fmt::format("{:.12g} {:.12g} {:.4f} {:.2f} {:.2f} {} {} {}\n", point.coordinates.x(),
                          point.coordinates.y(), point.coordinates.z(), marking.pixel.x(),
                          marking.pixel.y(), marking.photo, point.name,
                          point.role == PointRole::kCheck ? "check" : "control");
    }
  }
  return text;
}

}  // namespace stucco
