// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/output/internal/svg.h"

#include <cmath>

#include "survey/utf8.h"

namespace stucco::plan::internal {
namespace {

std::string_view Escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

// Hundredths without needless characters: 12.5, -.75.
void AppendNumber(int hundredths, std::string& text) {
  if (hundredths < 0) text += '-';
  const int size = std::abs(hundredths);
  if (size >= 100 || size == 0) text += fmt::format("{}", size / 100);
  if (size % 100 == 0) return;
  text += size % 10 == 0 ? fmt::format(".{}", size % 100 / 10) : fmt::format(".{:02}", size % 100);
}

}  // namespace

std::string EscapeXml(std::string_view text) {
  std::string escaped;
  while (!text.empty()) {
    const size_t length = Utf8SequenceLength(text);
    const std::string_view sequence = text.substr(0, std::max<size_t>(length, 1));
    if (const std::string_view entity = Escaped(sequence[0]); !entity.empty()) {
      escaped += entity;
    } else {
      escaped += length > 0 && IsPrintableUtf8(sequence) ? sequence : std::string_view("?");
    }
    text.remove_prefix(sequence.size());
  }
  return escaped;
}

void PathData::Add(char command, const Eigen::Vector2d& point) {
  const Eigen::Array2i to = (100 * point.array()).round().cast<int>();
  const Eigen::Array2i step = to - at_;
  text_ += command;
  AppendNumber(step.x(), text_);
  if (step.y() >= 0) text_ += ' ';
  AppendNumber(step.y(), text_);
  at_ = to;
  if (command == 'm') start_ = to;
}

void PathData::Close() {
  text_ += 'z';
  at_ = start_;
}

void PathData::Dot(const Eigen::Vector2d& point) {
  MoveTo(point);
  text_ += "h0";
}

void PathData::Ring(const std::vector<Eigen::Vector2d>& points) {
  Polyline(points);
  if (!points.empty()) Close();
}

void PathData::Polyline(const std::vector<Eigen::Vector2d>& points) {
  for (size_t i = 0; i < points.size(); ++i) {
    if (i == 0) {
      MoveTo(points[i]);
    } else {
      LineTo(points[i]);
    }
  }
}

void Svg::Path(const PathData& data, std::string_view attributes) {
  if (!data.IsEmpty()) Add("<path {} d=\"{}\"/>", attributes, data.text());
}

void Svg::Text(const Eigen::Vector2d& at, std::string_view style, std::string_view text) {
  Add("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>", at.x(), at.y(), style, EscapeXml(text));
}

std::vector<Eigen::Vector2d> MapScale::Page(const std::vector<Eigen::Vector2d>& points) const {
  std::vector<Eigen::Vector2d> page;
  page.reserve(points.size());
  for (const Eigen::Vector2d& point : points) page.push_back(Page(point));
  return page;
}

}  // namespace stucco::plan::internal
