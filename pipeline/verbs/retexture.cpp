// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/retexture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

#include "calib/localise/localise.h"
#include "calib/options/calib_options.h"
#include "capture_ingest/ingest.h"
#include "pipeline/engine/events.h"
#include "pipeline/engine/exit_code.h"
#include "pipeline/engine/layout.h"
#include "pipeline/engine/lock.h"
#include "pipeline/engine/outputs.h"
#include "pipeline/engine/progress.h"
#include "pipeline/engine/settings.h"
#include "pipeline/engine/shell.h"
#include "pipeline/engine/units.h"
#include "pipeline/engine/work_folder.h"
#include "pipeline/verbs/internal/stage_options.h"
#include "report/epoch_report.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/model_look.h"
#include "survey/plan_of_survey.h"
#include "survey/survey_folder.h"
#include "survey/survey_photo.h"
#include "texture/options/texture_options.h"
#include "texture/repaint.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr char kVerb[] = "retexture";
constexpr size_t kLongestName = 64;
constexpr size_t kMostExamples = 3;

std::string EpochName(const RetextureRequest& request) {
  const bool given = !request.epoch.empty();
  std::string name = given ? request.epoch : RealPath(request.photos).filename().string();
  const bool plain = !name.empty() && name.size() <= kLongestName && name.front() != '.' &&
                     name != kOwnLook && !IsMovedAside(name) &&
                     std::ranges::all_of(name, [](unsigned char c) {
                       return std::isalnum(c) || c == '-' || c == '_' || c == '.';
                     });
  if (plain) return name;
  throw Error(
      ErrorKind::kUsage,
      given ? fmt::format("--epoch: \"{}\" is no name of an epoch", name)
            : fmt::format("an epoch cannot be called \"{}\" as the photo folder is", name),
      fmt::format("give one with --epoch, of letters, digits, '-', '_' and '.', such as "
                  "2026-spring: it becomes a folder below epochs; \"{}\" is the survey's own look",
                  kOwnLook));
}

void RequirePhotoFolder(const RetextureRequest& request) {
  const fs::path& photos = request.photos;
  std::error_code error;
  if (fs::is_directory(photos, error)) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: {}", photos.string(),
                          fs::exists(photos, error) ? "is a file, not a folder" : "is not there"),
              request.again ? fmt::format("epoch {} is of its photos: put them back, or make "
                                          "another: stucco retexture --photos FOLDER",
                                          request.epoch)
                            : "name the folder of the new photos with --photos");
}

void RequireFinished(const fs::path& survey) {
  for (const char* file : {kTexturesFile, kFacetsFile, kCapturesFile, kSparseFolder}) {
    std::error_code error;
    if (fs::exists(survey / file, error)) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is not there: only a survey with textures can get new ones",
                            (survey / file).string()),
                fmt::format("finish the survey first: stucco run {}", ShellWord(survey.string())));
  }
}

void RequireNew(const fs::path& survey, const std::string& name) {
  const fs::path folder = survey / kEpochsFolder / name;
  std::error_code error;
  if (!fs::exists(fs::symlink_status(folder, error))) return;
  throw Error(ErrorKind::kBadInput, fmt::format("{}: this epoch is there already", folder.string()),
              fmt::format("choose another name with --epoch; to make it again from its photos: "
                          "stucco texture {} --epoch {}",
                          ShellWord(survey.string()), ShellWord(name)));
}

// Checkpoints of this verb; what calibration found in the survey's photos is read too.
class EpochUnits : public UnitStore {
 public:
  explicit EpochUnits(const fs::path& survey)
      : own_(WorkFolder(survey).Units(kVerb), nullptr),
        calibration_(WorkFolder(survey).Units("calib"), nullptr) {}

  std::optional<std::string> Load(std::string_view kind, std::string_view key) override {
    auto unit = own_.Load(kind, key);
    return unit ? unit : calibration_.Load(kind, key);
  }
  void Save(std::string_view kind, std::string_view key, std::string_view bytes) override {
    own_.Save(kind, key, bytes);
  }
  void DeleteUntouched() { own_.DeleteUntouched(); }

 private:
  DiskUnits own_;
  DiskUnits calibration_;
};

Captures IngestNew(const Settings& settings, const Captures& of_survey, StageContext context) {
  context.out /= fs::path(kCapturesFile).parent_path();
  fs::create_directories(context.out);
  auto options = OptionsOf<IngestOptions>(settings, "ingest");
  options.prior_camera = {};  // that of the survey's photos; calibration knows it better
  options.fewest_usable = 1;
  RunIngest(options, context);
  const fs::path file = context.out / fs::path(kCapturesFile).filename();
  Captures captures = ReadCaptures(file);
  std::map<std::string, std::string> known;
  for (const CapturedPhoto& photo : of_survey.photos) known[photo.hash] = photo.path;
  size_t usable = 0;
  for (CapturedPhoto& photo : captures.photos) {
    const auto same = known.find(photo.hash);
    if (photo.usable && same != known.end()) {
      photo.usable = false;
      photo.why = fmt::format("is the survey's own photo {}", same->second);
      context.progress->Warn(fmt::format("{} is not used: {}", photo.path, photo.why));
    }
    usable += photo.usable;
  }
  if (usable == 0) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: there is no new photo: all that can be used are the survey's own",
                            context.photos.string()),
                "name a folder with photos of another day");
  }
  WriteCaptures(captures, file);
  return captures;
}

void RequirePlaced(const std::vector<EpochPhoto>& photos, Progress& progress) {
  const auto placed = std::ranges::count(photos, true, &EpochPhoto::is_placed);
  std::string examples;
  size_t shown = 0;
  for (const EpochPhoto& photo : photos) {
    if (photo.is_placed()) continue;
    if (placed > 0) progress.Warn(fmt::format("{} is not used: {}", photo.path, photo.why));
    if (shown++ < kMostExamples) examples += fmt::format("\n  {}: {}", photo.path, photo.why);
  }
  if (placed == 0) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("none of {} photos can be placed in the survey, which stays as it is{}",
                            photos.size(), examples),
                "photograph what the survey shows, from about where its photos were taken; a photo "
                "that shows more than one wall is placed best");
  }
  progress.Note(fmt::format("{} of {} photos are placed in the survey", placed, photos.size()));
}

// With the facades that the plan means them for where textures go by it.
std::vector<SurveyPhoto> PosedPhotos(const std::vector<EpochPhoto>& photos,
                                     const Captures& captures, bool guided,
                                     const StageContext& context) {
  Reconstruction model;
  for (size_t i = 0; i < photos.size(); ++i) {
    if (!photos[i].is_placed()) continue;
    const auto number = static_cast<uint32_t>(i + 1);
    Camera camera = photos[i].camera;
    camera.id = CameraId{number};
    model.cameras[camera.id] = camera;
    model.photos[PhotoId{number}] = {
        PhotoId{number}, camera.id, photos[i].path, *photos[i].cam_from_world, {}};
  }
  std::vector<SurveyPhoto> posed = JoinPhotos(model, captures);
  std::ranges::sort(posed, {}, &SurveyPhoto::path);
  if (const auto plan = guided ? PlanOfSurvey(context) : std::nullopt) JoinPlan(*plan, posed);
  return posed;
}

// All of an epoch, below `context.out`.
Epoch MakeEpoch(const RetextureRequest& request, const std::string& name, const Settings& settings,
                StageContext& context) {
  FinishedModel model;
  model.captures = ReadCaptures(context.survey / kCapturesFile);
  model.reconstruction = ReadColmapModel(context.survey / kSparseFolder);
  model.photos = settings.photos;
  const Captures captures = IngestNew(settings, model.captures, context);
  Epoch epoch;
  epoch.name = name;
  epoch.replace = request.replace;
  epoch.photo_folder = context.photos.string();
  epoch.photos =
      LocalisePhotos(OptionsOf<CalibOptions>(settings, "calib"), model, captures, context);
  RequirePlaced(epoch.photos, *context.progress);
  const auto painting = OptionsOf<TextureOptions>(settings, "texture");
  epoch.facets = RepaintSurvey(
      painting,
      {name, PosedPhotos(epoch.photos, captures, painting.guided, context), request.replace},
      context);
  WriteEpoch(epoch, context.out / kEpochFile);
  WriteEpochReport(epoch, context);
  return epoch;
}

}  // namespace

RetextureReport RetextureSurvey(const fs::path& survey, const RetextureRequest& request,
                                const StageTable& table, Console& console,
                                const Platform& platform) {
  std::vector<std::string> as_made = OptionsAsMade(survey, table, "calib");
  std::ranges::copy(OptionsAsMade(survey, table, "texture"), std::back_inserter(as_made));
  const Settings settings = LoadSettings(survey, table, as_made);
  RequirePhotoFolder(request);
  const std::string name = EpochName(request);
  const fs::path folder = survey / kEpochsFolder / name;
  if (!request.again) RequireNew(survey, name);
  RequireFinished(survey);
  RequireApart(survey, request.photos, table);
  const SurveyLock lock(survey, request.command, platform);
  if (!request.again) RequireNew(survey, name);
  CleanScratch(survey);
  ScratchFolder scratch(survey, fmt::format("{}/{}", kEpochsFolder, name));
  EventLog events(WorkFolder(survey).Events());
  EpochUnits units(survey);
  RetextureReport report{folder, {}, {}};
  {
    StageProgress progress(kVerb, console, events, platform.interrupted);
    const double memory_gb =
        request.memory_limit_gb > 0 ? request.memory_limit_gb : settings.run.memory_limit_gb;
    StageContext context;
    context.survey = survey;
    context.photos = fs::absolute(request.photos).lexically_normal();
    context.out = scratch.path();
    context.threads = request.threads > 0 ? request.threads : ResolvedThreads(settings.run);
    context.memory_limit_bytes = static_cast<uint64_t>(memory_gb * (1 << 30));
    context.progress = &progress;
    context.units = &units;
    report.epoch = MakeEpoch(request, name, settings, context);
    context.ThrowIfCancelled();
  }
  std::error_code error;
  fs::create_directories(folder.parent_path(), error);
  if (error) throw WriteError(folder.parent_path(), "cannot be created", error.value());
  report.moved = scratch.Publish(platform);
  units.DeleteUntouched();
  return report;
}

bool HasPhotos(const fs::path& survey, const StageTable& table) {
  std::error_code error;
  return fs::is_directory(LoadSettings(survey, table, {}).photos, error);
}

RetextureRequest SameAgain(const fs::path& survey, const std::string& epoch) {
  const Epoch before = ReadEpochRequest(LookFolder(survey, epoch) / kEpochFile);
  RetextureRequest request;
  request.photos = before.photo_folder;
  request.epoch = epoch;
  request.replace = before.replace;
  request.again = true;
  return request;
}

}  // namespace stucco
