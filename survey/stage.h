// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stucco {

// How a running stage talks to whoever started it. Implementations are thread-safe.
class Progress {
 public:
  virtual ~Progress() = default;
  // A new step of `total` units begins: Begin("matching pairs", 55).
  virtual void Begin(std::string_view step, size_t total) = 0;
  virtual void Advance(size_t units = 1) = 0;
  // Something the user should know; the work goes on.
  virtual void Warn(std::string_view text) = 0;
  // A finding worth a line in the log.
  virtual void Note(std::string_view text) = 0;
  // True once SIGINT or SIGTERM was received.
  virtual bool Cancelled() const = 0;
};

// Checkpoints inside a stage: results of one unit of work (a photo's features, a pair's matches),
// kept by a key that hashes everything the result depends on. Thread-safe.
class UnitStore {
 public:
  virtual ~UnitStore() = default;
  // The bytes saved under this key, or nothing; damaged ones count as absent. `kind` is a short
  // word for the folder and the log: "features".
  virtual std::optional<std::string> Load(std::string_view kind, std::string_view key) = 0;
  // Crash-safe: after a kill the unit is there whole or not at all.
  virtual void Save(std::string_view kind, std::string_view key, std::string_view bytes) = 0;
};

// State of a stage of the pipeline, as the report shows it.
struct StageStatus {
  std::string stage;
  std::string state;   // done, stale, missing, failed
  std::string why;     // for stale and failed
  std::string remedy;  // for failed; may be empty
  double wall_s = -1;  // -1: not known
  double cpu_s = -1;
  double peak_memory_mb = -1;
};

// What a stage gets to work with. It reads the outputs of other stages below `survey`, writes only
// below `out` (which becomes survey/<stage> when the stage succeeds) and never writes below
// `photos`.
struct StageContext {
  std::filesystem::path survey;
  std::filesystem::path photos;
  std::filesystem::path out;
  int threads = 1;
  uint64_t memory_limit_bytes = uint64_t{4} << 30;
  Progress* progress = nullptr;       // never null while a stage runs
  UnitStore* units = nullptr;         // never null while a stage runs
  std::vector<StageStatus> statuses;  // of the stages before this one; only the report uses it

  // Throws Error (kInterrupted) once the user asked to stop; call it between units.
  void ThrowIfCancelled() const;
};

// Loads the unit, or computes and saves it. Requires a context with units.
std::string ComputeUnit(const StageContext& context, std::string_view kind, std::string_view key,
                        const std::function<std::string()>& compute);

// For tests and for calling a stage as a library: no output, no checkpoints, never cancelled.
Progress& SilentProgress();
UnitStore& NoUnits();

}  // namespace stucco
