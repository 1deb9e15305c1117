// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include "exchange/read_model.h"
#include "pipeline/engine/exit_code.h"
#include "pipeline/engine/layout.h"
#include "pipeline/engine/run.h"
#include "pipeline/engine/settings.h"
#include "pipeline/verbs/import.h"
#include "pipeline/verbs/internal/describe_model.h"
#include "pipeline/verbs/internal/place_model.h"
#include "pipeline/verbs/internal/publish_import.h"
#include "survey/calibration.h"
#include "survey/captures.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/georef.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr char kCalibStage[] = "calib";
constexpr char kIngestStage[] = "ingest";

// Sides of resized pictures are rounded to whole pixels, by some programs downwards.
constexpr double kShapeTolerance = 0.005;

// The size that the photos of every camera really have.
std::map<CameraId, ImageSize> PhotoSizes(const PhotoIndex& photos, const Reconstruction& model) {
  std::map<CameraId, ImageSize> sizes;
  for (const auto& [id, photo] : model.photos) {
    const ImageSize size = photos.SizeOf(photo.name);
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

void ScaleToPhotos(const PhotoIndex& photos, Reconstruction& model, ImportReport& report) {
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

// What the photos say of themselves is wanted before a model can be brought to it.
void RunIngest(const fs::path& survey, const StageTable& table, Console& console,
               const Platform& platform) {
  RunOptions options;
  options.goal = kIngestStage;
  options.command = "import";
  const RunResult result = Run(survey, table, options, console, platform);
  if (result.interrupted) throw Error(ErrorKind::kInterrupted, "interrupted");
  for (const StageOutcome& outcome : result.stages) {
    if (outcome.stage != kIngestStage || !outcome.failure) continue;
    throw Error(KindFromName(outcome.failure->kind), outcome.failure->why, outcome.failure->remedy);
  }
}

std::optional<Captures> ReadCapturesOf(const fs::path& survey) {
  std::error_code error;
  if (!fs::exists(survey / kCapturesFile, error)) return std::nullopt;
  return ReadCaptures(survey / kCapturesFile);
}

// Whether the survey wants models brought to the positions of its photos (calib.use_positions).
bool UsesPositions(const Settings& settings) {
  const auto calib = settings.stages.find(kCalibStage);
  if (calib == settings.stages.end()) return true;
  const Option* option = calib->second.options.Find("use_positions");
  return option == nullptr || *std::get<bool*>(option->value);
}

// What later stages will miss.
void NoteMissing(const Calibration& calibration, ImportReport& report) {
  if (report.points == 0) {
    report.notes.emplace_back(
        "it has no points that photos share, from which dense would know which photos to match: "
        "import a cloud, too (stucco import SURVEY cloud.ply), or a model with points");
  }
  if (!calibration.unposed.empty()) {
    report.notes.push_back(
        fmt::format("{} usable photos are not in the model", calibration.unposed.size()));
  }
}

void WriteCalib(const Reconstruction& model, const Calibration& calibration, const Georef& georef,
                const fs::path& out) {
  WriteColmapBinary(model, out / "sparse/0");
  WriteColmapText(model, out / "sparse/0");
  WriteGeoref(georef, out / "georef.json");
  WriteCalibration(calibration, out / "calibration.json");
}

}  // namespace

ImportReport ImportModel(const fs::path& survey, const fs::path& path, const StageTable& table,
                         Console& console, const Platform& platform) {
  const Settings settings = LoadSettings(survey, table, {});
  RequireApart(survey, settings.photos, table);
  const RecognizedModel source = RecognizeModel(path);
  const PhotoIndex photos(settings.photos);
  ExchangedModel imported = ReadModel(source, photos);
  ImportReport report;
  report.format = imported.format;
  report.notes = imported.notes;
  ScaleToPhotos(photos, imported.model, report);
  RunIngest(survey, table, console, platform);
  const std::optional<Captures> captures = ReadCapturesOf(survey);
  const Captures* known = captures ? &*captures : nullptr;
  const PlacedModel place =
      PlaceModel(source.path, UsesPositions(settings) ? known : nullptr, imported);
  report.frame = place.georef.frame;
  report.notes.insert(report.notes.end(), place.notes.begin(), place.notes.end());
  MeasurePointErrors(imported);
  Calibration calibration = DescribeModel(imported.model, place, known);
  calibration.findings.push_back(
      fmt::format("imported from {}", fs::absolute(path).lexically_normal().string()));
  for (std::string& note :
       PublishImport(survey, kCalibStage, path, platform, [&](const fs::path& out) {
         WriteCalib(imported.model, calibration, place.georef, out);
       })) {
    report.notes.push_back(std::move(note));
  }
  report.photos = calibration.photos_posed;
  report.points = calibration.points;
  report.cameras = static_cast<int>(imported.model.cameras.size());
  NoteMissing(calibration, report);
  return report;
}

}  // namespace stucco
