// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/numbers.h"

#include <fmt/format.h>

#include <cmath>

namespace stucco {

double RoundTo(double value, double unit_inverse) {
  return std::round(value * unit_inverse) / unit_inverse + 0.0;  // + 0.0 makes -0 a 0
}

std::string Percent(double share) {
  if (!std::isfinite(share)) return "-";
  const double percent = 100 * share;
  // Neither 99.7 % is all nor 0.3 % nothing.
  if (percent > 99 && percent < 100) return fmt::format("{:.1f} %", std::floor(percent * 10) / 10);
  if (percent > 0 && percent < 1) return fmt::format("{:.1f} %", std::ceil(percent * 10) / 10);
  return fmt::format("{:.0f} %", percent);
}

std::string Decimal(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string PixelSize(double size, bool metric) {
  if (!std::isfinite(size) || size <= 0) return "-";
  if (!metric) return fmt::format("{:.3g} units", size);
  return size < 0.01 ? fmt::format("{:.1f} mm", 1000 * size) : fmt::format("{:.2f} cm", 100 * size);
}

std::string Length(double length, bool metric) {
  if (!std::isfinite(length)) return "-";
  if (!metric) return fmt::format("{:.3g} units", length);
  const double magnitude = std::abs(length);
  if (magnitude < 0.01) return fmt::format("{:.1f} mm", 1000 * length);
  if (magnitude < 1) return fmt::format("{:.1f} cm", 100 * length);
  return fmt::format("{:.2f} m", length);
}

std::string Area(double area, bool metric) {
  if (!std::isfinite(area)) return "-";
  if (!metric) return fmt::format("{:.3g} units²", area);
  return area < 100 ? fmt::format("{:.1f} m²", area) : fmt::format("{:.0f} m²", area);
}

std::string Duration(double seconds) {
  if (!(seconds >= 0)) return "-";
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const int whole = static_cast<int>(std::lround(seconds));
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string Count(int count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace stucco
