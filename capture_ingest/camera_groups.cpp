// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/camera_groups.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "capture_ingest/focal.h"
#include "survey/error.h"
#include "survey/text.h"
#include "survey/utf8.h"

namespace stucco {
namespace {

std::string FirstText(const Tags& tags, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    std::string text = Text(tags, key);
    if (!text.empty() && IsPrintableUtf8(text)) return text;
  }
  return {};
}

std::string Make(const Tags& tags) {
  std::string make = FirstText(tags, {"Exif.Image.Make", "Xmp.tiff.Make"});
  if (make.empty() && tags.count("Xmp.drone-dji.GimbalYawDegree") > 0) make = "DJI";
  return make;
}

std::string Model(const Tags& tags) {
  return FirstText(tags, {"Exif.Image.Model", "Xmp.tiff.Model"});
}

std::string Lens(const Tags& tags) {
  return FirstText(tags, {"Exif.Photo.LensModel", "Xmp.aux.Lens"});
}

std::string Serial(const Tags& tags) {
  return FirstText(tags, {"Exif.Photo.BodySerialNumber", "Exif.Image.CameraSerialNumber",
                          "Xmp.drone-dji.CameraSerialNumber", "Xmp.aux.SerialNumber"});
}

std::string Rounded(const Tags& tags, const std::string& key, int decimals) {
  const double value = Number(tags, key).value_or(0);
  return value > 0 ? fmt::format("{:.{}f}", value, decimals) : std::string();
}

// "KODAK Z612 ..." of "EASTMAN KODAK COMPANY" and "Canon EOS" of "Canon" carry the make already.
bool ModelNamesMake(const std::string& make, const std::string& model) {
  const std::string first_word = LowerCase(model.substr(0, model.find(' ')));
  return LowerCase(make).find(first_word) != std::string::npos;
}

void CheckPrior(std::span<const double> prior) {
  constexpr char kRemedy[] = "give fx, fy, cx, cy or fx, fy, cx, cy, k1, k2, p1, p2 in pixels";
  if (prior.size() != 4 && prior.size() != 8) {
    throw Error(ErrorKind::kUsage,
                fmt::format("ingest.prior_camera has {} values instead of 4 or 8", prior.size()),
                kRemedy);
  }
  const bool finite =
      std::all_of(prior.begin(), prior.end(), [](double value) { return std::isfinite(value); });
  if (!finite || !(prior[0] > 0) || !(prior[1] > 0)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("ingest.prior_camera = {} is no camera", fmt::join(prior, ", ")),
                kRemedy);
  }
}

bool Fits(std::span<const double> prior, const Camera& camera) {
  const double x = prior[2] / camera.width_px;
  const double y = prior[3] / camera.height_px;
  return x > 1 / 3.0 && x < 2 / 3.0 && y > 1 / 3.0 && y < 2 / 3.0;
}

}  // namespace

std::string CameraKey(const PhotoRecord& record) {
  const Tags& tags = record.tags;
  const std::string parts[] = {
      Make(tags),
      Model(tags),
      Serial(tags),
      Lens(tags),
      FirstText(tags, {"Xmp.Camera.BandName", "Xmp.drone-dji.BandName"}),
      Rounded(tags, "Exif.Photo.FocalLength", 2),
      Rounded(tags, "Exif.Photo.DigitalZoomRatio", 2),
      fmt::format("{}x{}", record.photo.width_px, record.photo.height_px),
      FirstText(tags, {"Xmp.drone-dji.DewarpData"}),
  };
  return fmt::format("{}", fmt::join(parts, "|"));
}

std::string CameraLabel(const PhotoRecord& record) {
  const Tags& tags = record.tags;
  const std::string make = Make(tags);
  const std::string model = Model(tags);
  std::string name = model;
  if (!make.empty() && (model.empty() || !ModelNamesMake(make, model))) {
    name = model.empty() ? make : make + " " + model;
  }
  if (name.empty()) name = "unknown camera";
  std::string label =
      fmt::format("{}, {} x {}", name, record.photo.width_px, record.photo.height_px);
  const std::string focal = Rounded(tags, "Exif.Photo.FocalLength", 1);
  if (!focal.empty()) label += fmt::format(", {} mm", focal);
  return label;
}

std::vector<CapturedCamera> GroupCameras(std::vector<PhotoRecord>& records) {
  std::vector<CapturedCamera> cameras;
  std::map<std::string, int> index_by_key;
  for (PhotoRecord& record : records) {
    CapturedPhoto& photo = record.photo;
    if (!photo.usable) continue;
    const std::string key = CameraKey(record);
    const int next = static_cast<int>(cameras.size());
    const auto [entry, is_new] = index_by_key.emplace(key, next);
    photo.camera = entry->second;
    if (!is_new) continue;
    InitialCamera initial = InitialIntrinsics(record.tags, photo.width_px, photo.height_px);
    initial.camera.id = CameraId{static_cast<uint32_t>(next) + 1};
    cameras.push_back({.key = key,
                       .label = CameraLabel(record),
                       .intrinsics = std::move(initial.camera),
                       .focal_source = std::move(initial.source)});
  }
  return cameras;
}

std::vector<std::string> ApplyPriorCamera(std::span<const double> prior, bool fixed,
                                          std::vector<CapturedCamera>& cameras) {
  if (prior.empty()) return {};
  CheckPrior(prior);
  std::vector<std::string> unfit;
  for (CapturedCamera& camera : cameras) {
    if (!Fits(prior, camera.intrinsics)) {
      unfit.push_back(camera.label);
      continue;
    }
    auto& params = camera.intrinsics.params;
    assert(params.size() >= prior.size());
    std::fill(params.begin(), params.end(), 0.0);
    std::copy(prior.begin(), prior.end(), params.begin());
    camera.focal_source = "option";
    camera.fixed = fixed;
  }
  if (!cameras.empty() && unfit.size() == cameras.size()) {
    throw Error(ErrorKind::kUsage,
                fmt::format("ingest.prior_camera = {}: its principal point is not in the middle of "
                            "any photo ({})",
                            fmt::join(prior, ", "), fmt::join(unfit, "; ")),
                "give the camera in pixels of the full photos");
  }
  return unfit;
}

}  // namespace stucco
