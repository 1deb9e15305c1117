// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/camera/preset.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <cmath>
#include <optional>
#include <regex>

#include "plan/camera/internal/presets.h"
#include "survey/error.h"
#include "survey/options.h"

namespace stucco::plan {
namespace {

constexpr double kMetresPerMm = 1e-3;
constexpr char kReference[] = "mavic-3e";

double FlightMinutes(const toml::table& preset) {
  return preset["flight_min"].value_or(0.0);
}

CameraPreset PresetFromToml(const std::string& name, const toml::table& preset,
                            const toml::table& reference) {
  CameraPreset result;
  PlannedCamera& camera = result.camera;
  camera.name = name;
  camera.label = preset["label"].value_or(name);
  camera.focal_m = preset["focal_mm"].value_or(0.0) * kMetresPerMm;
  camera.sensor_width_m = preset["sensor_mm"][0].value_or(0.0) * kMetresPerMm;
  camera.sensor_height_m = preset["sensor_mm"][1].value_or(0.0) * kMetresPerMm;
  camera.width_px = preset["pixels"][0].value_or(0);
  camera.height_px = preset["pixels"][1].value_or(0);
  result.dji_drone = preset["dji"]["drone"].value_or(0);
  result.dji_drone_sub = preset["dji"]["sub"].value_or(0);
  result.dji_payload = preset["dji"]["payload"].value_or(0);
  result.battery_scale = FlightMinutes(reference) / FlightMinutes(preset);
  return result;
}

// What is impossible about a camera that somebody typed; empty when nothing is.
std::string Problem(const PlannedCamera& camera) {
  const auto within = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  constexpr double kLeastSensor_m = 1e-3;
  constexpr double kMostSensor_m = 0.1;
  if (!within(camera.sensor_width_m, kLeastSensor_m, kMostSensor_m) ||
      !within(camera.sensor_height_m, kLeastSensor_m, kMostSensor_m)) {
    return "a sensor is 1 to 100 mm wide and high";
  }
  if (!within(camera.focal_m, 1e-3, 1)) return "a focal length is 1 to 1000 mm";
  if (!within(camera.width_px, 100, 50000) || !within(camera.height_px, 100, 50000)) {
    return "a picture is 100 to 50000 pixels wide and high";
  }
  // Data sheets round sensors to a tenth of a millimetre; more is a mix-up (a 3:2 sensor with 16:9
  // pixels, width for height).
  constexpr double kMostSkew = 0.05;
  const double across = camera.sensor_width_m / camera.width_px;
  const double down = camera.sensor_height_m / camera.height_px;
  if (!(std::abs(across / down - 1) <= kMostSkew)) {
    return fmt::format("its pixels would be {:.2f} x {:.2f} micrometres, and pixels are square",
                       across * 1e6, down * 1e6);
  }
  return "";
}

// "17.3x13mm,12.29mm,5280x3956"; nothing when the text is not of this form.
std::optional<CameraPreset> CustomCamera(const std::string& text) {
  static const std::regex form(
      R"(\s*(\d+(?:\.\d+)?)\s*[xX]\s*(\d+(?:\.\d+)?)\s*(?:mm)?\s*,)"
      R"(\s*(\d+(?:\.\d+)?)\s*(?:mm)?\s*,\s*(\d+)\s*[xX]\s*(\d+)\s*(?:px)?\s*)");
  std::smatch found;
  if (!std::regex_match(text, found, form)) return std::nullopt;
  CameraPreset result;
  PlannedCamera& camera = result.camera;
  camera.name = text;
  try {
    camera.sensor_width_m = std::stod(found[1]) * kMetresPerMm;
    camera.sensor_height_m = std::stod(found[2]) * kMetresPerMm;
    camera.focal_m = std::stod(found[3]) * kMetresPerMm;
    camera.width_px = std::stoi(found[4]);
    camera.height_px = std::stoi(found[5]);
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
  camera.label =
      fmt::format("camera of {} x {} mm, {} mm", found[1].str(), found[2].str(), found[3].str());
  return result;
}

const toml::table& Presets() {
  static const toml::table presets = toml::parse(internal::PresetsToml());
  return presets;
}

[[noreturn]] void FailUnknown(const std::string& name) {
  std::string nearest;
  int best = std::max(2, static_cast<int>(name.size()) / 3);
  for (const std::string& known : CameraNames()) {
    constexpr size_t kTelling = 3;  // letters that say which drone is meant
    const bool begins_it = name.size() >= kTelling && known.starts_with(name);
    const int distance = begins_it ? 1 : EditDistance(name, known);
    if (distance > best || (distance == best && !nearest.empty())) continue;
    best = distance;
    nearest = known;
  }
  throw Error(
      ErrorKind::kUsage,
      fmt::format("camera {:?}: there is no such camera{}", name,
                  nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest)),
      fmt::format("give one of {}, or a camera as 17.3x13mm,12.29mm,5280x3956 (sensor, focal "
                  "length, pixels)",
                  fmt::join(CameraNames(), ", ")));
}

}  // namespace

double CameraPreset::HorizontalFov() const {
  return 2 * std::atan(camera.sensor_width_m / (2 * camera.focal_m));
}

std::vector<std::string> CameraNames() {
  std::vector<std::string> names;
  for (const auto& [key, value] : Presets()) names.emplace_back(key.str());
  return names;
}

CameraPreset FindCamera(const std::string& name) {
  if (const toml::table* preset = Presets()[name].as_table()) {
    return PresetFromToml(name, *preset, *Presets()[kReference].as_table());
  }
  const std::optional<CameraPreset> custom = CustomCamera(name);
  if (!custom) FailUnknown(name);
  const std::string problem = Problem(custom->camera);
  if (problem.empty()) return *custom;
  throw Error(ErrorKind::kUsage, fmt::format("camera {}: {}", name, problem),
              "give sensor, focal length (not that of 35 mm film) and pixels as "
              "17.3x13mm,12.29mm,5280x3956");
}

}  // namespace stucco::plan
