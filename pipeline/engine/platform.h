// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>

namespace stucco {

enum class LockMode { kExclusive, kShared };
enum class LockResult {
  kHeld,
  kTaken,       // by another process
  kImpossible,  // this file system has no locks
};

// What the engine asks of the machine and a test cannot bring about. It is handed in, so that tests
// hand in theirs; programs begin with RealPlatform(). Functions are never empty and may be called
// from any thread.
struct Platform {
  // Locks an open file for this process, without waiting.
  std::function<LockResult(int file, LockMode mode)> lock_file;
  // Exchanges two folders in one step. False when the kernel or the file system cannot.
  std::function<bool(const std::filesystem::path& a, const std::filesystem::path& b)>
      exchange_folders;
  // True once the user asked to stop; stays true.
  std::function<bool()> interrupted;
};

// Of this machine, and never interrupted: who catches signals sets `interrupted`.
Platform RealPlatform();

}  // namespace stucco
