// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/platform.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/file.h>

#include <cerrno>

namespace stucco {
namespace {

LockResult LockFile(int file, LockMode mode) {
  const int operation = (mode == LockMode::kExclusive ? LOCK_EX : LOCK_SH) | LOCK_NB;
  int result = 0;
  do {
    result = flock(file, operation);
  } while (result != 0 && errno == EINTR);
  if (result == 0) {
    return LockResult::kHeld;
  }
  return errno == EWOULDBLOCK ? LockResult::kTaken : LockResult::kImpossible;
}

bool ExchangeFolders(const std::filesystem::path& a, const std::filesystem::path& b) {
  return renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
}

}  // namespace

Platform RealPlatform() {
  return {LockFile, ExchangeFolders, [] { return false; }};
}

}  // namespace stucco
