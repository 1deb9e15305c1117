// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/lock.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <ctime>
#include <thread>

#include "pipeline/engine/exit_code.h"
#include "pipeline/engine/internal/json.h"
#include "pipeline/engine/work_folder.h"
#include "survey/error.h"

namespace stucco {
namespace {

using Json = nlohmann::ordered_json;

std::string HostName() {
  char name[256] = {};
  gethostname(name, sizeof(name) - 1);
  return name;
}

std::optional<LockOwner> ReadOwner(int file) {
  char text[4096] = {};
  const ssize_t size = pread(file, text, sizeof(text), 0);
  try {
    const Json json = Json::parse(text, text + (size > 0 ? size : 0));
    return LockOwner{json.value("pid", 0), json.value("host", ""), json.value("started", ""),
                     json.value("command", "")};
  } catch (const Json::exception&) {
    return std::nullopt;  // empty, torn or not ours
  }
}

void WriteOwner(int file, const std::string& command) {
  // Long commands are cut so that one read gets the whole record.
  const std::string text = Dump(
      Json{{"pid", getpid()},
           {"host", HostName()},
           {"started", fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr)))},
           {"command", command.substr(0, 1000)}});
  if (ftruncate(file, 0) != 0 || pwrite(file, text.data(), text.size(), 0) < 0) {
    // Only the name in another run's message gets lost; the lock itself holds.
  }
}

// `stucco status` holds the lock for a moment to see whether anybody has it.
LockResult LockPatiently(int file, const Platform& platform) {
  for (int attempt = 0; attempt < 5; ++attempt) {
    const LockResult result = platform.lock_file(file, LockMode::kExclusive);
    if (result != LockResult::kTaken) {
      return result;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(40));
  }
  return LockResult::kTaken;
}

}  // namespace

SurveyLock::SurveyLock(const std::filesystem::path& survey, const std::string& command,
                       const Platform& platform) {
  const std::filesystem::path path = WorkFolder(survey).Lock();
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) {
    throw WriteError(path, "cannot be written", errno);
  }
  const LockResult result = LockPatiently(file_, platform);
  held_ = result == LockResult::kHeld;
  if (result == LockResult::kTaken) {
    const std::optional<LockOwner> owner = ReadOwner(file_);
    close(file_);
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: another run is at work: {}", survey.string(),
                            owner ? Describe(*owner) : "its name cannot be read"),
                owner ? fmt::format("wait until it is done, or stop it with: kill {}", owner->pid)
                      : "wait until it is done");
  }
  killed_owner_ = ReadOwner(file_);
  WriteOwner(file_, command);
}

SurveyLock::~SurveyLock() {
  // An empty file says that this run ended in order. It is never removed: a process that has just
  // opened it would then hold a lock on a file without a name.
  if (ftruncate(file_, 0) != 0) {
    // Then the next run says that this one was killed, and nothing else changes.
  }
  close(file_);
}

std::optional<LockOwner> CurrentOwner(const std::filesystem::path& survey,
                                      const Platform& platform) {
  const int file = open(WorkFolder(survey).Lock().c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return std::nullopt;
  }
  std::optional<LockOwner> owner;
  if (platform.lock_file(file, LockMode::kShared) == LockResult::kTaken) {
    owner = ReadOwner(file);
    if (!owner) {
      owner = LockOwner{};
    }
  }
  close(file);
  return owner;
}

std::string Describe(const LockOwner& owner) {
  return fmt::format("process {} on {}, since {} ({})", owner.pid, owner.host, owner.started,
                     owner.command);
}

}  // namespace stucco
