// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/ingest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

#include "capture_ingest/camera_groups.h"
#include "capture_ingest/consensus.h"
#include "capture_ingest/contact_sheet.h"
#include "capture_ingest/photo_record.h"
#include "capture_ingest/planned_views.h"
#include "survey/captures.h"
#include "survey/error.h"
#include "survey/image.h"
#include "survey/parallel.h"
#include "survey/photo_files.h"
#include "survey/plan_of_survey.h"

namespace stucco {
namespace {

std::vector<PhotoRecord> InspectAll(const std::vector<PhotoFile>& files,
                                    const IngestOptions& options, const StageContext& context) {
  context.progress->Begin("reading photos", files.size());
  std::vector<PhotoRecord> records(files.size());
  ParallelFor(files.size(), context.threads, [&](size_t i) {
    context.ThrowIfCancelled();
    records[i] = InspectPhoto(files[i], options.min_side_px, context);
    context.progress->Advance();
  });
  return records;
}

size_t CountUsable(const std::vector<PhotoRecord>& records) {
  return std::count_if(records.begin(), records.end(),
                       [](const PhotoRecord& record) { return record.photo.usable; });
}

// The first few unusable photos, so that the message alone says what is wrong.
std::string Examples(const std::vector<PhotoRecord>& records) {
  constexpr size_t kMost = 3;
  std::vector<std::string> examples;
  for (const PhotoRecord& record : records) {
    if (record.photo.usable || examples.size() == kMost) continue;
    examples.push_back(fmt::format("{}: {}", record.photo.path, record.photo.why));
  }
  return fmt::format("{}", fmt::join(examples, "\n  "));
}

void RequireUsable(size_t fewest, const std::vector<PhotoRecord>& records,
                   const StageContext& context) {
  const std::string folder = context.photos.string();
  if (records.empty()) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: there are no photos in this folder", folder),
                "put the JPEG photos of the survey there, or name another folder");
  }
  const size_t usable = CountUsable(records);
  if (usable >= fewest) return;
  std::string what = fmt::format("{}: {} of {} photos can be used", folder,
                                 usable == 0 ? "none" : "only 1", records.size());
  if (records.size() > usable) what += "\n  " + Examples(records);
  throw Error(ErrorKind::kBadInput, what,
              usable == 0 ? "copy the photos from the camera again as JPEG files"
                          : "a model needs at least two overlapping photos, better three or more "
                            "of every wall; add photos to the folder");
}

void WarnAboutDoubts(const std::vector<PhotoRecord>& records, Progress& progress) {
  for (const PhotoRecord& record : records) {
    if (!record.photo.usable && !record.photo.why.empty()) {
      progress.Warn(fmt::format("{} is not used: {}", record.photo.path, record.photo.why));
      continue;
    }
    for (const std::string& doubt : record.doubts) {
      progress.Warn(fmt::format("{}: {}", record.photo.path, doubt));
    }
  }
}

void NoteFindings(const Captures& captures, Progress& progress) {
  size_t usable = 0;
  size_t positions = 0;
  size_t fixed = 0;
  size_t gimbals = 0;
  for (const CapturedPhoto& photo : captures.photos) {
    if (!photo.usable) continue;
    ++usable;
    positions += photo.position.has_value();
    fixed += photo.position && photo.position->rtk_fixed;
    gimbals += photo.gimbal.has_value();
  }
  progress.Note(fmt::format(
      "{} of {} photos can be used; {} with a GPS position ({} RTK fixed), {} with gimbal angles",
      usable, captures.photos.size(), positions, fixed, gimbals));
  for (const CapturedCamera& camera : captures.cameras) {
    progress.Note(fmt::format("camera {}: focal length {:.0f} px ({})", camera.label,
                              camera.intrinsics.FocalX(), camera.focal_source));
  }
}

void CompareWithPlan(const StageContext& context, Captures& captures) {
  const std::optional<Plan> plan = PlanOfSurvey(context);
  if (!plan) return;
  captures.views = MatchToPlan(*plan, captures.photos);
  const size_t captured =
      std::count_if(captures.views.begin(), captures.views.end(),
                    [](const CapturedView& view) { return view.status == "captured"; });
  context.progress->Note(
      fmt::format("{} of {} planned views are captured, by the ids in the names "
                  "of the photos",
                  captured, captures.views.size()));
}

}  // namespace

void Describe(OptionTable& table, IngestOptions& options) {
  table.Add("prior_camera", options.prior_camera,
            "Known camera in pixels of the full photo: fx, fy, cx, cy or fx, fy, cx, cy, k1, k2, "
            "p1, p2 (COLMAP's OPENCV model). Empty: from the metadata of the photos.");
  table.Add("prior_camera_fixed", options.prior_camera_fixed,
            "Hold the prior camera in calibration instead of refining it.");
  table.Add("min_side_px", options.min_side_px, 16, 100000,
            "Photos whose shorter side has fewer pixels are not used.");
}

void RunIngest(const IngestOptions& options, StageContext& context) {
  std::vector<PhotoRecord> records = InspectAll(FindPhotoFiles(context.photos), options, context);
  RejectDuplicates(records);
  RequireUsable(static_cast<size_t>(options.fewest_usable), records, context);
  QuarantineOutliers(records);
  if (UseHeightAboveTakeoff(records)) {
    context.progress->Warn("no photo has a height above sea; heights above take-off are used");
  }
  Captures captures;
  captures.cameras = GroupCameras(records);
  for (const std::string& label :
       ApplyPriorCamera(options.prior_camera, options.prior_camera_fixed, captures.cameras)) {
    context.progress->Warn(
        fmt::format("ingest.prior_camera does not fit {}; its metadata are used", label));
  }
  for (const PhotoRecord& record : records) captures.photos.push_back(record.photo);
  WarnAboutDoubts(records, *context.progress);
  NoteFindings(captures, *context.progress);
  CompareWithPlan(context, captures);
  WriteCaptures(captures, context.out / "captures.json");
  WriteImage(ContactSheet(records), context.out / "contact-sheet.jpg", 85);
}

}  // namespace stucco
