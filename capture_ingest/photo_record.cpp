// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/photo_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "capture_ingest/gimbal.h"
#include "capture_ingest/health.h"
#include "capture_ingest/position.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/utf8.h"

namespace stucco {
namespace {

// "reason; remedy" without the path of this machine in front: results do not depend on where the
// photos lie.
std::string Reason(const Error& error, const std::filesystem::path& path) {
  std::string reason = error.what();
  const std::string prefix = path.string() + ": ";
  if (reason.starts_with(prefix)) reason.erase(0, prefix.size());
  const std::string& remedy = error.remedy();
  return fmt::format("{}; {}", reason,
                     remedy.empty() ? "copy the photo from the camera again" : remedy);
}

// Nothing where one of the three is missing or no exposure: not all lenses state their aperture,
// and one without is not known to have the same as another.
std::optional<double> Exposure_s(const Tags& tags) {
  const double time_s = Number(tags, "Exif.Photo.ExposureTime").value_or(0);
  const double iso = Number(tags, "Exif.Photo.ISOSpeedRatings").value_or(0);
  const double f_number = Number(tags, "Exif.Photo.FNumber").value_or(0);
  if (!(time_s > 0 && iso > 0 && f_number > 0)) return std::nullopt;
  return time_s * (iso / 100) / (f_number * f_number);
}

void TakeMetadata(const std::string& bytes, PhotoRecord& record) {
  PhotoTags tags = ReadTags(bytes);
  if (!tags.problem.empty()) record.doubts.push_back("metadata: " + tags.problem);
  record.tags = std::move(tags.tags);
  PositionReading position = ReadPosition(record.tags);
  record.photo.position = position.position;
  record.photo.height_above_takeoff_m = position.height_above_takeoff_m;
  GimbalReading gimbal = ReadGimbal(record.tags);
  record.photo.gimbal = gimbal.angles;
  record.doubts.insert(record.doubts.end(), position.doubts.begin(), position.doubts.end());
  record.doubts.insert(record.doubts.end(), gimbal.doubts.begin(), gimbal.doubts.end());
  const std::string time = Text(record.tags, "Exif.Photo.DateTimeOriginal");
  if (IsPrintableUtf8(time)) record.photo.capture_time = time;
  record.photo.exposure_s = Exposure_s(record.tags);
}

PhotoHealth KnownHealth(const std::filesystem::path& path, const std::string& hash,
                        const StageContext& context) {
  const std::string parts[] = {hash, kHealthVersion};
  const std::string bytes = ComputeUnit(context, "photo", HashParts(parts),
                                        [&] { return Serialized(CheckHealth(path)); });
  return ParseHealth(bytes);
}

}  // namespace

void Reject(PhotoRecord& record, std::string why) {
  record.photo.usable = false;
  record.photo.why = std::move(why);
}

PhotoRecord InspectPhoto(const PhotoFile& file, int min_side_px, const StageContext& context) {
  PhotoRecord record;
  record.photo.path = file.path;
  if (!file.problem.empty()) {
    Reject(record, file.problem);
    return record;
  }
  const std::filesystem::path path = context.photos / file.path;
  try {
    const std::string bytes = ReadFile(path);
    if (bytes.empty()) {
      Reject(record, "the file is empty; copy the photo from the camera again");
      return record;
    }
    record.photo.hash = HashBytes(bytes);
    ReadJpegSize(path);  // before metadata, so that a PNG named .jpg is called one
    TakeMetadata(bytes, record);
    const PhotoHealth health = KnownHealth(path, record.photo.hash, context);
    record.photo.width_px = health.size.width_px;
    record.photo.height_px = health.size.height_px;
    record.photo.sharpness = health.sharpness;
    record.thumbnail = health.thumbnail;
    record.photo.usable = true;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kBadInput) throw;
    Reject(record, Reason(error, path));
    return record;
  }
  const int shorter = std::min(record.photo.width_px, record.photo.height_px);
  if (shorter < min_side_px) {
    Reject(record, fmt::format("{} x {} pixels are too few; lower ingest.min_side_px to use it",
                               record.photo.width_px, record.photo.height_px));
  }
  return record;
}

void RejectDuplicates(std::vector<PhotoRecord>& records) {
  std::map<std::string, std::string> path_by_hash;
  for (PhotoRecord& record : records) {
    if (!record.photo.usable) continue;
    const auto [first, is_new] = path_by_hash.emplace(record.photo.hash, record.photo.path);
    if (is_new) continue;
    record.photo.duplicate_of = first->second;
    Reject(record, fmt::format("identical to {}; nothing to do", first->second));
  }
}

}  // namespace stucco
