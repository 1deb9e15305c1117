// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/engine/stages.h"

namespace stucco {

class HashCache;

// Everything that a stage's outputs depend on. Two runs with equal fingerprints give equal bytes.
struct Fingerprint {
  int stage_version = 0;
  std::map<std::string, std::string> options;  // name -> value as TOML
  std::map<std::string, std::string> inputs;   // what -> content hash, or a word like "missing"
  bool operator==(const Fingerprint&) const = default;
};

// Content of an input that is not there or cannot be read.
inline constexpr char kMissingInput[] = "missing";
inline constexpr char kUnreadableInput[] = "unreadable";
// Of one that counts only by its name, such as a picture that is no JPEG.
inline constexpr char kUnreadInput[] = "not read";

// Where a stage's inputs are.
struct SurveyPaths {
  std::filesystem::path survey;
  std::filesystem::path photos;
};

// What fingerprints are taken of, and how.
struct FingerprintContext {
  const SurveyPaths& paths;
  // Of the other stages; inputs of a stage that reports failures: their state and reasons, not
  // their times.
  const std::vector<StageStatus>& statuses;
  int threads;
  HashCache& hashes;
  Progress& progress;  // shows the photos that have to be read
};

// Photos are hashed as far as ingest looks at them. Throws Error (kInterrupted) between two of them
// once `progress` is cancelled.
Fingerprint TakeFingerprint(const Stage& stage, const BoundStage& bound,
                            const FingerprintContext& context);

// Name of the input that holds another stage's state.
std::string StateInput(const std::string& stage);

// Why a result made under `was` does not hold under `is`, a sentence each: "option
// dense.max_image_px changed from 1200 to 800", "input photos/a.jpg changed". Empty when equal.
std::vector<std::string> Differences(const std::string& stage, const Fingerprint& was,
                                     const Fingerprint& is);

// Every regular file below a folder, relative to it with '/' between folders, sorted. Symbolic
// links to files count as files; links to folders are not followed. Empty when it is no folder.
std::vector<std::string> FilesBelow(const std::filesystem::path& folder);

// Hashes of `files` (relative to `base`) by the same index.
std::vector<std::string> HashFiles(const std::filesystem::path& base,
                                   const std::vector<std::string>& files, int threads,
                                   HashCache& hashes);

}  // namespace stucco
