// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/outputs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>

#include "pipeline/engine/exit_code.h"
#include "pipeline/engine/manifest.h"
#include "pipeline/engine/work_folder.h"
#include "survey/files.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

void Flush(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    throw WriteError(path, "cannot be opened to flush it to disk", errno);
  }
  const int result = fsync(file);
  const int error = errno;
  close(file);
  // EINVAL, EROFS: a file system that has nothing to flush.
  if (result != 0 && error != EINVAL && error != EROFS) {
    throw WriteError(path, "cannot be flushed to disk", error);
  }
}

void FlushTree(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_symlink()) {
      Flush(entry.path());
    }
  }
  Flush(folder);
}

void Rename(const fs::path& from, const fs::path& to) {
  if (rename(from.c_str(), to.c_str()) != 0) {
    throw WriteError(to, "cannot be put in place", errno);
  }
}

bool IsOurs(const fs::path& survey, const std::string& stage) {
  const WorkFolder work(survey);
  std::error_code error;
  return fs::exists(work.Mark(stage), error) || ReadManifest(work.Manifest(stage)).manifest;
}

// The first of <target>.old-1, <target>.old-2 ... that is free.
fs::path FreeNameBeside(const fs::path& target) {
  for (int number = 1;; ++number) {
    fs::path name = fmt::format("{}{}-{}", target.string(), kOldSuffix, number);
    std::error_code error;
    if (!fs::exists(fs::symlink_status(name, error))) {
      return name;
    }
  }
}

// Puts outputs of <folder> that are old, and have no successor in <targets>, back there.
void RestoreOld(const fs::path& folder, const fs::path& targets) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(kOldSuffix)) continue;
    const fs::path target = targets / name.substr(0, name.find_last_of('-'));
    if (!fs::exists(target)) Rename(entry.path(), target);
  }
}

}  // namespace

void MarkAsOurs(const fs::path& survey, const std::string& stage) {
  const fs::path mark = WorkFolder(survey).Mark(stage);
  std::error_code error;
  if (fs::exists(mark, error)) {
    return;
  }
  fs::create_directories(mark.parent_path(), error);
  if (error) {
    throw WriteError(mark.parent_path(), "cannot be created", error.value());
  }
  WriteFileAtomically(mark, "survey/" + stage + " is made by stucco and replaced by its runs\n");
}

ScratchFolder::ScratchFolder(const fs::path& survey, const std::string& stage)
    : survey_(survey),
      stage_(stage),
      path_(WorkFolder(survey).Scratch() / fmt::format("{}-{}", stage, getpid())),
      target_(survey / stage) {
  std::error_code error;
  fs::remove_all(path_, error);
  fs::create_directories(path_, error);
  if (error) {
    throw WriteError(path_, "cannot be created", error.value());
  }
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

std::optional<fs::path> ScratchFolder::Publish(const Platform& platform) {
  FlushTree(path_);
  std::optional<fs::path> moved;
  if (fs::exists(fs::symlink_status(target_)) && !IsOurs(survey_, stage_)) {
    moved = FreeNameBeside(target_);
    Rename(target_, *moved);
  }
  // Before the outputs are in place: a kill between them and their manifest does not make them
  // somebody else's.
  MarkAsOurs(survey_, stage_);
  if (!fs::exists(target_)) {
    Rename(path_, target_);
  } else if (!platform.exchange_folders(path_, target_)) {
    // Two steps. A kill between them leaves no target but its old content with this suffix, which
    // CleanScratch puts back.
    const fs::path old = path_.string() + kOldSuffix;
    fs::remove_all(old);
    Rename(target_, old);
    Rename(path_, target_);
    Flush(target_.parent_path());
    fs::remove_all(old);
    return moved;
  }
  Flush(target_.parent_path());
  fs::remove_all(path_);  // holds the old outputs after an exchange
  return moved;
}

void CleanScratch(const fs::path& survey) {
  const fs::path scratch = WorkFolder(survey).Scratch();
  // Of stages, and of epochs in a folder of theirs.
  RestoreOld(scratch / kEpochsFolder, survey / kEpochsFolder);
  RestoreOld(scratch, survey);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(scratch, error)) {
    fs::remove_all(entry.path(), error);
  }
}

}  // namespace stucco
