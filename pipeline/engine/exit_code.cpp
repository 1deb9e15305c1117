// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/exit_code.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <new>
#include <system_error>

#include "pipeline/engine/console.h"
#include "pipeline/engine/resources.h"

namespace stucco {
namespace {

struct Row {
  ErrorKind kind;
  int exit_code;
  const char* name;
};

constexpr std::array<Row, 6> kRows = {{{ErrorKind::kStageFailed, 1, "stage_failed"},
                                       {ErrorKind::kUsage, 2, "usage"},
                                       {ErrorKind::kBadInput, 3, "bad_input"},
                                       {ErrorKind::kQualityGate, 4, "quality_gate"},
                                       {ErrorKind::kOutOfResource, 5, "out_of_resource"},
                                       {ErrorKind::kInterrupted, 130, "interrupted"}}};

const Row& RowOf(ErrorKind kind) {
  for (const Row& row : kRows) {
    if (row.kind == kind) {
      return row;
    }
  }
  return kRows.front();
}

bool IsFullDisk(int error) {
  return error == ENOSPC || error == EDQUOT;
}

Error FromSystem(const std::system_error& e) {
  // By number: the standard's portable conditions do not know quotas.
  const auto& category = e.code().category();
  if ((category == std::generic_category() || category == std::system_category()) &&
      IsFullDisk(e.code().value())) {
    return {ErrorKind::kOutOfResource, e.what(),
            "free space on this disk and run the same command again"};
  }
  if (e.code() == std::errc::permission_denied || e.code() == std::errc::read_only_file_system) {
    return {ErrorKind::kBadInput, e.what(), "check the permissions of this file and its folders"};
  }
  return {ErrorKind::kStageFailed, e.what()};
}

}  // namespace

int ExitCode(ErrorKind kind) {
  return RowOf(kind).exit_code;
}

std::string KindName(ErrorKind kind) {
  return RowOf(kind).name;
}

ErrorKind KindFromName(const std::string& name) {
  for (const Row& row : kRows) {
    if (row.name == name) {
      return row.kind;
    }
  }
  return ErrorKind::kStageFailed;
}

Error WriteError(const std::filesystem::path& path, const std::string& what, int error) {
  const bool full = IsFullDisk(error);
  return {full ? ErrorKind::kOutOfResource : ErrorKind::kBadInput,
          fmt::format("{}: {} ({})", path.string(), what, std::generic_category().message(error)),
          full ? "free some space on this disk, or raise the quota, and run again"
               : "check the permissions of the survey folder"};
}

Error AsError(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const Error& e) {
    return e;
  } catch (const std::bad_alloc&) {
    return {ErrorKind::kOutOfResource,
            fmt::format("out of memory: {} in use when more was asked for",
                        MemoryText(CurrentMemoryMb())),
            "use smaller pictures (calib.max_image_px, dense.max_image_px), fewer threads, or a "
            "computer with more memory"};
  } catch (const std::system_error& e) {
    return FromSystem(e);
  } catch (const std::exception& e) {
    return {ErrorKind::kStageFailed, fmt::format("unexpected error: {}", e.what())};
  } catch (...) {
    return {ErrorKind::kStageFailed, "unexpected error of an unknown kind"};
  }
}

}  // namespace stucco
