// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <filesystem>
#include <string>

#include "survey/error.h"

namespace stucco {

// Exit codes of the program: 0 done, 1 a stage failed, 2 wrong usage, 3 bad input, 4 a quality
// gate was not met, 5 out of a resource, 130 interrupted.
int ExitCode(ErrorKind kind);

// "stage_failed", "usage", "bad_input", "quality_gate", "out_of_resource", "interrupted".
std::string KindName(ErrorKind kind);
ErrorKind KindFromName(const std::string& name);  // kStageFailed for an unknown name

// A file that cannot be written, from errno: kOutOfResource for a full disk or quota, else
// kBadInput.
Error WriteError(const std::filesystem::path& path, const std::string& what, int error);

// Any exception as an Error: full disks and missing permissions that the standard library reports,
// exhausted memory, and errors of other libraries (kStageFailed).
Error AsError(const std::exception_ptr& exception);

}  // namespace stucco
