// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/survey_data.h"

#include <algorithm>
#include <set>

#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// Messages name the whole path; the report is about the survey wherever it lies.
std::string WithoutFolder(std::string text, const fs::path& survey) {
  const std::string prefix = survey.string() + "/";
  for (size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at)) {
    text.erase(at, prefix.size());
  }
  return text;
}

template <typename Value, typename Read>
std::optional<Value> Load(const fs::path& survey, const char* stage, const char* file, Read read,
                          std::vector<DamagedFile>& damaged) {
  std::error_code ignored;
  if (!fs::exists(survey / file, ignored)) return std::nullopt;
  try {
    return read(survey / file);
  } catch (const std::exception& error) {
    damaged.push_back({stage, file, WithoutFolder(error.what(), survey)});
    return std::nullopt;
  }
}

std::vector<SurveyPhoto> LoadPhotos(const fs::path& survey, const Captures& captures,
                                    std::vector<DamagedFile>& damaged) {
  const auto model = Load<Reconstruction>(
      survey, "calib", kSparseFolder, [](const fs::path& path) { return ReadColmapModel(path); },
      damaged);
  return model ? JoinPhotos(*model, captures) : std::vector<SurveyPhoto>();
}

bool IsMetric(const SurveyData& data) {
  if (!data.georef && !data.proxy) return false;
  return (!data.georef || data.georef->metric) && (!data.proxy || data.proxy->metric);
}

std::set<std::string> FindElevations(const fs::path& survey, const Proxy& proxy) {
  std::set<std::string> found;
  for (const Building& building : proxy.buildings) {
    std::error_code ignored;
    if (fs::exists(survey / kElevationsFolder / ElevationFile(building), ignored)) {
      found.insert(building.id);
    }
  }
  return found;
}

// Without a pipeline that knows, a stage is done when its result is there.
std::vector<StageStatus> GuessedStatuses(const fs::path& survey) {
  const std::pair<const char*, const char*> results[] = {{"ingest", kCapturesFile},
                                                         {"calib", kCalibrationFile},
                                                         {"dense", kCloudFile},
                                                         {"proxy", kFacetsFile},
                                                         {"texture", kTexturesFile}};
  std::vector<StageStatus> statuses;
  for (const auto& [stage, file] : results) {
    std::error_code ignored;
    StageStatus status;
    status.stage = stage;
    status.state = fs::exists(survey / file, ignored) ? "done" : "missing";
    statuses.push_back(status);
  }
  return statuses;
}

// Photos' answers to "why": duplicates say so by themselves.
LeftOutPhoto Unusable(const CapturedPhoto& photo) {
  return {photo.path, photo.duplicate_of.empty() ? "unusable" : "duplicate", photo.why};
}

}  // namespace

SurveyData LoadSurvey(const fs::path& survey, const std::vector<StageStatus>& statuses) {
  SurveyData data;
  data.captures = Load<Captures>(survey, "ingest", kCapturesFile, ReadCaptures, data.damaged);
  data.calibration =
      Load<Calibration>(survey, "calib", kCalibrationFile, ReadCalibration, data.damaged);
  data.georef = Load<Georef>(survey, "calib", kGeorefFile, ReadGeoref, data.damaged);
  data.photos = LoadPhotos(survey, data.captures.value_or(Captures()), data.damaged);
  data.proxy = Load<Proxy>(survey, "proxy", kFacetsFile, ReadProxy, data.damaged);
  if (data.proxy) data.elevations = FindElevations(survey, *data.proxy);
  data.textures = Load<TextureSet>(survey, "texture", kTexturesFile, ReadTextureSet, data.damaged);
  data.metric = IsMetric(data);
  data.statuses = statuses.empty() ? GuessedStatuses(survey) : statuses;
  std::erase_if(data.statuses, [](const StageStatus& s) { return s.stage == "report"; });
  for (StageStatus& status : data.statuses) status.why = WithoutFolder(status.why, survey);
  return data;
}

std::vector<Attention> FindAttention(const SurveyData& data) {
  std::vector<Attention> found;
  std::set<std::string> named;
  for (const DamagedFile& file : data.damaged) {
    if (!named.insert(file.stage).second) continue;
    found.push_back({file.stage, "damaged", file.why, "compute this stage again",
                     "stucco run SURVEY --from " + file.stage + " --force"});
  }
  for (const char* state : {"failed", "missing", "stale"}) {
    for (const StageStatus& status : data.statuses) {
      if (status.state != state || !named.insert(status.stage).second) continue;
      found.push_back({status.stage, status.state, status.why, status.remedy, "stucco run SURVEY"});
    }
  }
  return found;
}

std::vector<LeftOutPhoto> LeftOutPhotos(const SurveyData& data) {
  std::vector<LeftOutPhoto> photos;
  if (data.captures) {
    for (const CapturedPhoto& photo : data.captures->photos) {
      if (!photo.usable) photos.push_back(Unusable(photo));
    }
  }
  if (data.calibration) {
    for (const UnposedPhoto& photo : data.calibration->unposed) {
      photos.push_back({photo.path, "not posed", photo.why});
    }
  }
  std::stable_sort(photos.begin(), photos.end(),
                   [](const auto& a, const auto& b) { return a.path < b.path; });
  // Calibration may repeat what ingest has found.
  const auto same = [](const auto& a, const auto& b) { return a.path == b.path; };
  photos.erase(std::unique(photos.begin(), photos.end(), same), photos.end());
  return photos;
}

}  // namespace stucco
