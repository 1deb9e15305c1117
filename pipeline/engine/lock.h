// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/engine/platform.h"

namespace stucco {

// Who works on a survey.
struct LockOwner {
  int pid = 0;
  std::string host;
  std::string started;  // "2026-03-01 12:00:00", local time
  std::string command;
};

// Exclusive use of a survey: flock(2) on .stucco/lock, with the owner's name in the file. The
// kernel drops the lock when its process ends in whatever way, so a dead owner blocks nobody.
class SurveyLock {
 public:
  // Throws Error (kBadInput) that names the owner when another process works on this survey, and
  // when the survey cannot be written.
  SurveyLock(const std::filesystem::path& survey, const std::string& command,
             const Platform& platform);
  ~SurveyLock();
  SurveyLock(const SurveyLock&) = delete;
  SurveyLock& operator=(const SurveyLock&) = delete;

  // False on a file system without locks (some network storage): then nothing keeps a second run
  // away.
  bool held() const { return held_; }

  // The run before this one, when it did not end in an orderly way (killed, power cut).
  const std::optional<LockOwner>& killed_owner() const { return killed_owner_; }

 private:
  int file_ = -1;
  bool held_ = false;
  std::optional<LockOwner> killed_owner_;
};

// Who works on the survey at this moment, if anybody. Takes no lock and writes nothing.
std::optional<LockOwner> CurrentOwner(const std::filesystem::path& survey,
                                      const Platform& platform);

// "process 1234 on host, since 2026-03-01 12:00:00 (stucco run .)"
std::string Describe(const LockOwner& owner);

}  // namespace stucco
