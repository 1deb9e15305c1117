// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/fingerprint.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/engine/hash_cache.h"
#include "pipeline/engine/internal/json.h"
#include "survey/error.h"
#include "survey/parallel.h"
#include "survey/photo_files.h"

namespace stucco {
namespace {

// A manifest is JSON and holds only UTF-8. File names may be any bytes; those of a name that is not
// UTF-8 are written as \xNN.
std::string ManifestName(const std::string& name) {
  try {
    [[maybe_unused]] const std::string checked = nlohmann::json(name).dump();
    return name;
  } catch (const nlohmann::json::type_error&) {
    std::string escaped;
    for (const char c : name) {
      const auto byte = static_cast<unsigned char>(c);
      escaped += byte < 0x80 ? std::string(1, c) : fmt::format("\\x{:02x}", byte);
    }
    return escaped;
  }
}

std::string HashOrUnreadable(const std::filesystem::path& file, HashCache& hashes) {
  try {
    return hashes.Hash(file);
  } catch (const Error&) {
    // The stage that opens the file says what is wrong with it.
    return kUnreadableInput;
  }
}

// Reads the photos that the cache does not know, which can take long: many gigabytes, a slow disk.
void ReadNewPhotos(const std::vector<PhotoFile>& files, const FingerprintContext& context) {
  std::vector<std::filesystem::path> unknown;
  for (const PhotoFile& file : files) {
    const std::filesystem::path path = context.paths.photos / file.file;
    if (file.problem.empty() && !context.hashes.Remembers(path)) {
      unknown.push_back(path);
    }
  }
  if (unknown.empty()) {
    return;
  }
  context.progress.Begin("hashing photos", unknown.size());
  ParallelFor(unknown.size(), context.threads, [&](size_t i) {
    if (context.progress.Cancelled()) {
      throw Error(ErrorKind::kInterrupted, "interrupted while hashing photos");
    }
    HashOrUnreadable(unknown[i], context.hashes);
    context.progress.Advance();
  });
}

// None when the folder is not there or cannot be read; `check` says what is wrong with it.
std::vector<PhotoFile> PhotosOrNone(const std::filesystem::path& folder) {
  try {
    return FindPhotoFiles(folder);
  } catch (const Error&) {
    return {};
  }
}

void AddPhotos(const FingerprintContext& context, std::map<std::string, std::string>& inputs) {
  const std::vector<PhotoFile> files = PhotosOrNone(context.paths.photos);
  ReadNewPhotos(files, context);
  for (const PhotoFile& file : files) {
    // Wherever the photo folder is: moving it changes nothing.
    inputs["photos/" + ManifestName(file.file.generic_string())] =
        file.problem.empty() ? HashOrUnreadable(context.paths.photos / file.file, context.hashes)
                             : kUnreadInput;
  }
}

void AddInput(const std::string& input, const FingerprintContext& context,
              std::map<std::string, std::string>& inputs) {
  const std::filesystem::path path = context.paths.survey / input;
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    const std::vector<std::string> files = FilesBelow(path);
    const std::vector<std::string> contents =
        HashFiles(path, files, context.threads, context.hashes);
    for (size_t i = 0; i < files.size(); ++i) {
      inputs[input + "/" + files[i]] = contents[i];
    }
  } else if (std::filesystem::exists(path, error)) {
    inputs[input] = HashOrUnreadable(path, context.hashes);
  } else {
    inputs[input] = kMissingInput;
  }
}

}  // namespace

std::vector<std::string> FilesBelow(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  using Iterator = std::filesystem::recursive_directory_iterator;
  Iterator entry(folder, std::filesystem::directory_options::skip_permission_denied, error);
  for (; !error && entry != Iterator(); entry.increment(error)) {
    std::error_code unknown;
    if (entry->is_regular_file(unknown)) {
      files.push_back(entry->path().lexically_relative(folder).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> HashFiles(const std::filesystem::path& base,
                                   const std::vector<std::string>& files, int threads,
                                   HashCache& hashes) {
  std::vector<std::string> contents(files.size());
  ParallelFor(files.size(), threads,
              [&](size_t i) { contents[i] = HashOrUnreadable(base / files[i], hashes); });
  return contents;
}

Fingerprint TakeFingerprint(const Stage& stage, const BoundStage& bound,
                            const FingerprintContext& context) {
  Fingerprint fingerprint;
  fingerprint.stage_version = stage.version;
  for (const Option& option : bound.options.options()) {
    if (option.affects_result) {
      fingerprint.options[option.name] = ValueAsToml(option);
    }
    if (const auto* const* file = std::get_if<std::string*>(&option.value);
        file != nullptr && option.is_input_file && !(*file)->empty()) {
      AddInput(**file, context, fingerprint.inputs);
    }
  }
  if (stage.photos_are_input) {
    AddPhotos(context, fingerprint.inputs);
  }
  for (const std::string& input : stage.inputs) {
    AddInput(input, context, fingerprint.inputs);
  }
  if (stage.reports_failures) {
    for (const StageStatus& status : context.statuses) {
      fingerprint.inputs[StateInput(status.stage)] =
          status.state + (status.why.empty() ? "" : ": " + status.why);
    }
  }
  return fingerprint;
}

std::string StateInput(const std::string& stage) {
  return "state of " + stage;
}

std::vector<std::string> Differences(const std::string& stage, const Fingerprint& was,
                                     const Fingerprint& is) {
  std::vector<std::string> reasons;
  if (was.stage_version != is.stage_version) {
    reasons.push_back(fmt::format("this program computes {} in another way (version {}, was {})",
                                  stage, is.stage_version, was.stage_version));
  }
  for (const auto& [name, value] : is.options) {
    const auto before = was.options.find(name);
    if (before == was.options.end()) {
      reasons.push_back(fmt::format("option {}.{} is new", stage, name));
    } else if (before->second != value) {
      reasons.push_back(
          fmt::format("option {}.{} changed from {} to {}", stage, name, before->second, value));
    }
  }
  for (const auto& [name, value] : was.options) {
    if (!is.options.contains(name)) {
      reasons.push_back(fmt::format("option {}.{} is gone", stage, name));
    }
  }
  for (const auto& [name, content] : is.inputs) {
    const auto before = was.inputs.find(name);
    if (before == was.inputs.end()) {
      reasons.push_back(fmt::format("input {} is new", name));
    } else if (before->second != content) {
      reasons.push_back(content == kMissingInput ? fmt::format("input {} is gone", name)
                                                 : fmt::format("input {} changed", name));
    }
  }
  for (const auto& [name, content] : was.inputs) {
    if (!is.inputs.contains(name)) {
      reasons.push_back(fmt::format("input {} is gone", name));
    }
  }
  return reasons;
}

}  // namespace stucco
