// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "pipeline/engine/layout.h"
#include "pipeline/engine/settings.h"
#include "pipeline/verbs/import.h"
#include "pipeline/verbs/internal/publish_import.h"
#include "survey/calibration.h"
#include "survey/captures.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/georef.h"
#include "survey/image.h"
#include "survey/photo_files.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr char kCalibStage[] = "calib";

// Sides of resized pictures are rounded to whole pixels, by some programs downwards.
constexpr double kShapeTolerance = 0.005;

std::string FileName(const std::string& path) {
  return fs::path(path).filename().string();
}

// Renames the photos of the model to paths below the photo folder.
void MatchNames(const fs::path& photos, Reconstruction& model) {
  std::set<std::string> paths;
  std::map<std::string, std::vector<std::string>> by_name;
  for (const PhotoFile& file : FindPhotoFiles(photos)) {
    if (file.problem.empty()) {
      paths.insert(file.path);
      by_name[FileName(file.path)].push_back(file.path);
    }
  }
  std::vector<std::string> unknown;
  std::set<std::string> taken;
  for (auto& [id, photo] : model.photos) {
    const auto same_name = by_name.find(FileName(photo.name));
    if (!paths.contains(photo.name)) {
      if (same_name == by_name.end() || same_name->second.size() != 1) {
        unknown.push_back(photo.name);
        continue;
      }
      photo.name = same_name->second.front();
    }
    if (!taken.insert(photo.name).second) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("the model has photo {} more than once", photo.name),
                  "import a model in which every photo is one image");
    }
  }
  if (!unknown.empty()) {
    const size_t shown = std::min<size_t>(unknown.size(), 3);
    throw Error(ErrorKind::kBadInput,
                fmt::format("{} of {} photos of the model are not in {}: {}{}", unknown.size(),
                            model.photos.size(), photos.string(),
                            fmt::join(unknown.begin(), unknown.begin() + shown, ", "),
                            unknown.size() > shown ? " ..." : ""),
                "import a model of the photos that survey.toml names");
  }
}

// The size that the photos of every camera really have.
std::map<CameraId, ImageSize> PhotoSizes(const fs::path& photos, const Reconstruction& model) {
  std::map<CameraId, ImageSize> sizes;
  for (const auto& [id, photo] : model.photos) {
    const ImageSize size = ReadJpegSize(photos / photo.name);
    const auto [known, is_new] = sizes.emplace(photo.camera, size);
    if (known->second.width_px != size.width_px || known->second.height_px != size.height_px) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("camera {} of the model has photos of {} x {} and of {} x {} pixels",
                              photo.camera.value, known->second.width_px, known->second.height_px,
                              size.width_px, size.height_px),
                  "import a model with one camera per picture size");
    }
  }
  return sizes;
}

void ScaleObservations(CameraId camera, double x, double y, Reconstruction& model) {
  for (auto& [id, photo] : model.photos) {
    if (photo.camera == camera) {
      for (Observation& observation : photo.observations) {
        observation.pixel = observation.pixel.cwiseProduct(Eigen::Vector2d(x, y));
      }
    }
  }
}

void ScaleToPhotos(const fs::path& photos, Reconstruction& model, ImportReport& report) {
  for (const auto& [id, size] : PhotoSizes(photos, model)) {
    Camera& camera = model.cameras.at(id);
    const double x = static_cast<double>(size.width_px) / camera.width_px;
    const double y = static_cast<double>(size.height_px) / camera.height_px;
    if (x == 1 && y == 1) {
      continue;
    }
    if (std::abs(x / y - 1) > kShapeTolerance) {
      throw Error(
          ErrorKind::kBadInput,
          fmt::format("camera {} of the model is of {} x {} pixels and its photos have {} "
                      "x {}",
                      id.value, camera.width_px, camera.height_px, size.width_px, size.height_px),
          "import a model of these photos, not of cropped or undistorted ones");
    }
    report.notes.push_back(fmt::format("camera {} was scaled from {} x {} to {} x {} pixels",
                                       id.value, camera.width_px, camera.height_px, size.width_px,
                                       size.height_px));
    camera = Resized(camera, size.width_px, size.height_px);
    ScaleObservations(id, x, y, model);
  }
}

CalibratedPhoto DescribePhoto(const Reconstruction& model, const RegisteredImage& photo) {
  CalibratedPhoto result;
  result.path = photo.name;
  const Camera& camera = model.cameras.at(photo.camera);
  double sum_px = 0;
  for (const Observation& observation : photo.observations) {
    const auto point = model.points.find(observation.point);
    if (point == model.points.end()) continue;
    const auto pixel = camera.Project(photo.cam_from_world * point->second.position);
    if (!pixel) continue;
    sum_px += (*pixel - observation.pixel).norm();
    ++result.observations;
  }
  result.reprojection_error_px = result.observations > 0 ? sum_px / result.observations : 0;
  return result;
}

Calibration DescribeModel(const Reconstruction& model, const fs::path& survey,
                          const fs::path& source) {
  Calibration calibration;
  std::set<std::string> posed;
  for (const auto& [id, photo] : model.photos) {
    calibration.photos.push_back(DescribePhoto(model, photo));
    posed.insert(photo.name);
  }
  std::sort(calibration.photos.begin(), calibration.photos.end(),
            [](const auto& a, const auto& b) { return a.path < b.path; });
  std::error_code error;
  if (fs::exists(survey / kCapturesFile, error)) {
    for (const CapturedPhoto& photo : ReadCaptures(survey / kCapturesFile).photos) {
      if (photo.usable && !posed.contains(photo.path)) {
        calibration.unposed.push_back({photo.path, "not in the imported model"});
      }
    }
  }
  calibration.photos_posed = static_cast<int>(posed.size());
  calibration.photos_total = static_cast<int>(posed.size() + calibration.unposed.size());
  calibration.reprojection_error_px = MeanReprojectionError(model);
  calibration.points = static_cast<int>(model.points.size());
  calibration.mean_track_length = MeanTrackLength(model);
  for (const auto& [id, camera] : model.cameras) {
    CalibratedCamera entry;
    entry.id = static_cast<int>(id.value);
    entry.label = fmt::format("camera {}, {} x {}", id.value, camera.width_px, camera.height_px);
    entry.model = Name(camera.model);
    const auto names = ParameterNames(camera.model);
    entry.names.assign(names.begin(), names.end());
    entry.params = camera.params;
    calibration.cameras.push_back(std::move(entry));
  }
  calibration.findings.push_back(fmt::format("imported from {}", source.string()));
  return calibration;
}

void WriteCalib(const Reconstruction& model, const Calibration& calibration, const fs::path& out) {
  WriteColmapBinary(model, out / "sparse/0");
  WriteColmapText(model, out / "sparse/0");
  // The model's frame is what it is: scale and directions are not known here.
  WriteGeoref(Georef(), out / "georef.json");
  WriteCalibration(calibration, out / "calibration.json");
}

}  // namespace

ImportReport ImportColmap(const fs::path& survey, const fs::path& source, const StageTable& table,
                          const Platform& platform) {
  const Settings settings = LoadSettings(survey, table, {});
  RequireApart(survey, settings.photos, table);
  Reconstruction model = ReadColmapModel(source);
  if (const auto problem = FindProblem(model)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", source.string(), *problem),
                "export the model again");
  }
  ImportReport report;
  MatchNames(settings.photos, model);
  ScaleToPhotos(settings.photos, model, report);
  const Calibration calibration =
      DescribeModel(model, survey, fs::absolute(source).lexically_normal());
  for (std::string& note :
       PublishImport(survey, kCalibStage, source, platform,
                     [&](const fs::path& out) { WriteCalib(model, calibration, out); })) {
    report.notes.push_back(std::move(note));
  }
  report.photos = calibration.photos_posed;
  report.points = calibration.points;
  report.cameras = static_cast<int>(model.cameras.size());
  if (!calibration.unposed.empty()) {
    report.notes.push_back(
        fmt::format("{} usable photos are not in the model", calibration.unposed.size()));
  }
  return report;
}

}  // namespace stucco
