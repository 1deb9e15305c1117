// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/check.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <variant>

#include "pipeline/engine/console.h"
#include "pipeline/engine/layout.h"
#include "pipeline/engine/resources.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// A photo is compared with at most about this many others.
constexpr double kPairsPerPhoto = 60;
// Work on two threads takes longer than half the time: parts of every stage run on one.
constexpr double kParallelShare = 0.85;

// The longer side to which a stage reduces photos; 0 when it takes them as they are.
int MaxSide(const BoundStage& bound) {
  const Option* option = bound.options.Find("max_image_px");
  const auto* value = option == nullptr ? nullptr : std::get_if<int*>(&option->value);
  return value == nullptr ? 0 : **value;
}

StageNeed Estimate(const Stage& stage, const BoundStage& bound, const PhotoFolder& photos,
                   const RunSettings& run) {
  double megapixels = 0, largest = 0;
  for (const ImageSize& full : photos.sizes) {
    const ImageSize size = ScaledSize(full, MaxSide(bound));
    const double photo = 1e-6 * size.width_px * size.height_px;
    megapixels += photo;
    largest = std::max(largest, photo);
  }
  const StageCost& cost = stage.cost;
  const auto count = static_cast<double>(photos.photos);
  const double pairs = std::min(count * (count - 1) / 2, count * kPairsPerPhoto);
  const double cpu_s = cost.cpu_s_per_photo * count + cost.cpu_s_per_megapixel * megapixels +
                       cost.cpu_s_per_pair * pairs;
  const double limit_mb = run.memory_limit_gb * 1024;
  const double thread_mb = cost.thread_mb_per_largest_megapixel * largest;
  const double threads_mb = std::min(thread_mb * ResolvedThreads(run),
                                     std::max(thread_mb, cost.threads_share * limit_mb));
  StageNeed need;
  need.stage = stage.name;
  need.wall_s = cpu_s * (1 - kParallelShare + kParallelShare / ResolvedThreads(run));
  need.disk_mb = cost.disk_mb_per_photo * count + cost.disk_mb_per_megapixel * megapixels;
  need.memory_mb =
      cost.memory_mb + cost.memory_mb_per_photo * count +
      cost.memory_mb_per_megapixel * megapixels + cost.memory_mb_per_largest_megapixel * largest +
      threads_mb +
      std::min(cost.cached_mb_per_megapixel * megapixels, cost.cached_share * limit_mb);
  return need;
}

class Checker {
 public:
  Checker(const fs::path& survey, const StageTable& table, const Settings& settings)
      : survey_(survey), table_(table), settings_(settings) {
    result_.threads = ResolvedThreads(settings.run);
    result_.memory_limit_mb = settings.run.memory_limit_gb * 1024;
    result_.available_memory_mb = AvailableMemoryMb();
    result_.free_disk_mb = FreeDiskMb(survey);
  }

  CheckResult Run(const std::vector<std::string>& stages) {
    CheckSurveyFolder();
    const bool opens_photos = std::any_of(stages.begin(), stages.end(), [&](const auto& name) {
      return GetStage(table_, name).opens_photos;
    });
    if (opens_photos) {
      CheckPhotos();
    }
    for (const std::string& name : stages) {
      result_.needs.push_back(Estimate(GetStage(table_, name), settings_.stages.at(name),
                                       result_.photos, settings_.run));
    }
    CheckDisk();
    CheckMemory();
    std::stable_partition(result_.problems.begin(), result_.problems.end(),
                          [](const CheckProblem& problem) { return problem.fatal; });
    return std::move(result_);
  }

 private:
  void Refuse(ErrorKind kind, std::string what, std::string remedy) {
    result_.problems.push_back({kind, true, std::move(what), std::move(remedy)});
  }
  void Warn(std::string what, std::string remedy) {
    result_.problems.push_back({ErrorKind::kBadInput, false, std::move(what), std::move(remedy)});
  }

  void CheckSurveyFolder() {
    if (access(survey_.c_str(), W_OK) != 0) {
      Refuse(ErrorKind::kBadInput,
             fmt::format("{}: the survey folder cannot be written", survey_.string()),
             "make it writable, or create the survey on another disk");
    }
    try {
      RequireApart(survey_, settings_.photos, table_);
    } catch (const Error& e) {
      Refuse(e.kind(), e.what(), e.remedy());
    }
  }

  void CheckPhotos() {
    try {
      result_.photos = InspectPhotos(settings_.photos, result_.threads);
    } catch (const Error& e) {
      Refuse(e.kind(), e.what(), e.remedy());
      return;
    }
    const PhotoFolder& photos = result_.photos;
    const std::string folder = settings_.photos.string();
    if (photos.photos == 0) {
      Refuse(ErrorKind::kBadInput,
             photos.other_files + photos.problems.size() == 0
                 ? fmt::format("{}: the photo folder is empty", folder)
                 : fmt::format("{}: none of the {} files in it is a readable JPEG photo", folder,
                               photos.other_files + photos.problems.size()),
             "copy the photos there, or correct photos = ... in survey.toml");
    } else if (photos.photos == 1) {
      Refuse(ErrorKind::kBadInput, fmt::format("{}: there is only one usable photo", folder),
             "a model needs at least two photos that overlap, better three of every wall");
    }
  }

  void CheckDisk() {
    double need_mb = 0;
    for (const StageNeed& need : result_.needs) {
      std::error_code error;
      if (!fs::exists(survey_ / need.stage, error)) {
        need_mb += need.disk_mb;
      }
    }
    if (result_.free_disk_mb < 0 || result_.free_disk_mb >= need_mb) {
      return;
    }
    const std::string what =
        fmt::format("{}: about {} of disk will be needed and {} are free", survey_.string(),
                    MemoryText(need_mb), MemoryText(result_.free_disk_mb));
    const std::string remedy = "free some space, or create the survey on a larger disk";
    // The estimate is rough: only a clear shortage stops the work.
    if (result_.free_disk_mb < need_mb / 2) {
      Refuse(ErrorKind::kOutOfResource, what, remedy);
    } else {
      Warn(what, remedy);
    }
  }

  void CheckMemory() {
    const auto most = std::max_element(
        result_.needs.begin(), result_.needs.end(),
        [](const StageNeed& a, const StageNeed& b) { return a.memory_mb < b.memory_mb; });
    if (most == result_.needs.end() || most->memory_mb == 0) {
      return;
    }
    if (result_.available_memory_mb > 0 && most->memory_mb > result_.available_memory_mb) {
      Warn(fmt::format("{} will need about {} of memory and {} are free", most->stage,
                       MemoryText(most->memory_mb), MemoryText(result_.available_memory_mb)),
           "close other programs, or use smaller pictures (calib.max_image_px, "
           "dense.max_image_px)");
    } else if (most->memory_mb > result_.memory_limit_mb) {
      Warn(fmt::format("{} will need about {} of memory and the limit is {}", most->stage,
                       MemoryText(most->memory_mb), MemoryText(result_.memory_limit_mb)),
           "raise run.memory_limit_gb, or use smaller pictures");
    }
  }

  const fs::path& survey_;
  const StageTable& table_;
  const Settings& settings_;
  CheckResult result_;
};

}  // namespace

bool CheckResult::ok() const {
  return problems.empty() || !problems.front().fatal;
}

CheckResult Check(const fs::path& survey, const StageTable& table, const Settings& settings,
                  const std::vector<std::string>& stages) {
  return Checker(survey, table, settings).Run(stages);
}

void ThrowIfFatal(const CheckResult& result) {
  std::string what, remedy;
  for (const CheckProblem& problem : result.problems) {
    if (problem.fatal) {
      what += (what.empty() ? "" : "\n") + problem.what;
      remedy += (remedy.empty() ? "" : "\n") + problem.remedy;
    }
  }
  if (!result.ok()) {
    throw Error(result.problems.front().kind, what, remedy);
  }
}

}  // namespace stucco
