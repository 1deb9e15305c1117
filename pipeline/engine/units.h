// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "pipeline/engine/manifest.h"
#include "survey/stage.h"

namespace stucco {

// Checkpoints of one stage on disk: <folder>/<kind>/<key>. A file begins with its size and
// checksum; one that does not hold what they say counts as absent and is computed again. Written
// beside and renamed: a kill leaves a whole unit or none; after a power cut the checksum tells.
class DiskUnits : public UnitStore {
 public:
  // Called for every unit that was computed, after it is on disk.
  using Listener = std::function<void(std::string_view kind, std::string_view key, size_t bytes)>;

  DiskUnits(std::filesystem::path folder, Listener listener);

  std::optional<std::string> Load(std::string_view kind, std::string_view key) override;
  void Save(std::string_view kind, std::string_view key, std::string_view bytes) override;

  // By kind; a unit loaded twice counts once.
  std::map<std::string, UnitCount> counts() const;

  // After the stage succeeded: removes the units that this run did not use.
  void DeleteUntouched();

 private:
  std::filesystem::path Path(std::string_view kind, std::string_view key) const;

  std::filesystem::path folder_;
  Listener listener_;
  mutable std::mutex mutex_;
  std::map<std::string, UnitCount> counts_;
  std::set<std::filesystem::path> touched_;
};

}  // namespace stucco
