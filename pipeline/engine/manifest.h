// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "pipeline/engine/fingerprint.h"
#include "pipeline/engine/resources.h"

namespace stucco {

// How many units of one kind a stage computed, and how many it found from before.
struct UnitCount {
  int64_t computed = 0;
  int64_t reused = 0;
};

// What a finished stage leaves about itself in .stucco/manifests. Written after the outputs are in
// place, so that outputs without their manifest count as not made.
struct Manifest {
  std::string stage;
  std::string program;  // version of the program that wrote it
  Fingerprint fingerprint;
  std::map<std::string, std::string> outputs;  // path relative to the survey -> content hash
  Usage usage;
  std::map<std::string, UnitCount> units;  // by kind
  std::string imported_from;               // not empty: the outputs came with `stucco import`
};

// Of this program, as `--version` says it.
std::string ProgramVersion();

struct ManifestFile {
  std::optional<Manifest> manifest;
  std::string problem;  // why there is none although the file exists: damaged, unreadable
};

// Never throws: a manifest that cannot be used only means that the stage runs again.
ManifestFile ReadManifest(const std::filesystem::path& path);
void WriteManifest(const Manifest& manifest, const std::filesystem::path& path);

// Why a stage did not finish: .stucco/failures/<stage>.json. Removed when it succeeds; says nothing
// once the options or inputs are others than its fingerprint's.
struct Failure {
  std::string stage;
  std::string kind;  // a word for ErrorKind: "stage_failed", "bad_input" ...
  std::string why;
  std::string remedy;
  Usage usage;
  Fingerprint fingerprint;
};

// Nothing when there is none or it cannot be used.
std::optional<Failure> ReadFailure(const std::filesystem::path& path);
void WriteFailure(const Failure& failure, const std::filesystem::path& path);

}  // namespace stucco
