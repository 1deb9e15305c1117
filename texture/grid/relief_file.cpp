// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/grid/relief_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "survey/error.h"
#include "survey/files.h"

namespace stucco {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kPlane = 32768;
constexpr int kLargest = 65535;

[[noreturn]] void ThrowDamaged(const std::filesystem::path& path, std::string_view problem) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), problem),
              "make the survey's textures again: stucco texture SURVEY --force");
}

}  // namespace

ReliefFiles EncodeRelief(const Relief& relief) {
  const double unit = relief.step;  // heights are whole steps
  cv::Mat picture(relief.height, relief.width, CV_16U);
  for (int y = 0; y < relief.height; ++y) {
    for (int x = 0; x < relief.width; ++x) {
      const double height = relief.heights[static_cast<size_t>(y) * relief.width + x];
      const long value = kPlane + std::lround(height / unit);
      picture.at<uint16_t>(y, x) = static_cast<uint16_t>(std::clamp<long>(value, 0, kLargest));
    }
  }
  std::vector<uint8_t> bytes;
  cv::imencode(".png", picture, bytes);
  const ordered_json description = {{"version", 1},          {"cell", relief.cell},
                                    {"unit", unit},          {"plane", kPlane},
                                    {"width", relief.width}, {"height", relief.height}};
  return {std::string(bytes.begin(), bytes.end()), description.dump(2) + "\n"};
}

std::shared_ptr<const Relief> ReadRelief(const std::filesystem::path& folder,
                                         const std::string& name) {
  const std::filesystem::path description = folder / kReliefFolder / (name + ".json");
  if (!std::filesystem::exists(description)) return nullptr;
  auto relief = std::make_shared<Relief>();
  try {
    const json j = json::parse(ReadFile(description));
    relief->cell = j.at("cell");
    relief->step = j.at("unit");
    relief->width = j.at("width");
    relief->height = j.at("height");
  } catch (const json::exception& problem) {
    ThrowDamaged(description, problem.what());
  }
  const std::filesystem::path picture = folder / kReliefFolder / (name + ".png");
  const std::string bytes = ReadFile(picture);
  if (bytes.empty()) ThrowDamaged(picture, "is empty");
  const cv::Mat heights =
      cv::imdecode(std::vector<uint8_t>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
  if (heights.type() != CV_16U || heights.cols != relief->width || heights.rows != relief->height ||
      !(relief->cell > 0) || !(relief->step > 0)) {
    ThrowDamaged(picture, "is not the relief that its JSON speaks of");
  }
  for (int y = 0; y < heights.rows; ++y) {
    for (int x = 0; x < heights.cols; ++x) {
      const auto height = static_cast<float>((heights.at<uint16_t>(y, x) - kPlane) * relief->step);
      relief->heights.push_back(height);
      relief->highest = std::max(relief->highest, static_cast<double>(height));
    }
  }
  return relief;
}

}  // namespace stucco
