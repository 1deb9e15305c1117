// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "survey/stage.h"

namespace stucco::test {

// Checkpoints in memory.
class MemoryUnits : public UnitStore {
 public:
  std::optional<std::string> Load(std::string_view kind, std::string_view key) override {
    const std::lock_guard lock(mutex_);
    const auto found = units_.find({std::string(kind), std::string(key)});
    return found == units_.end() ? std::nullopt : std::optional(found->second);
  }
  void Save(std::string_view kind, std::string_view key, std::string_view bytes) override {
    const std::lock_guard lock(mutex_);
    units_[{std::string(kind), std::string(key)}] = bytes;
    ++saved[std::string(kind)];
  }
  size_t size() const { return units_.size(); }
  void Clear() { units_.clear(); }

  std::map<std::string, int> saved;  // by kind

 private:
  std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, std::string> units_;
};

// Remembers warnings, and asks to stop when told to.
class Listener : public Progress {
 public:
  void Begin(std::string_view, size_t) override {}
  void Advance(size_t) override {}
  void Warn(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    warnings.emplace_back(text);
  }
  void Note(std::string_view) override {}
  bool Cancelled() const override { return cancelled; }

  std::vector<std::string> warnings;
  bool cancelled = false;

 private:
  std::mutex mutex_;
};

}  // namespace stucco::test
