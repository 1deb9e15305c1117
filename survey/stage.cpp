// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stage.h"

#include <cassert>

#include "survey/error.h"

namespace stucco {
namespace {

class Silent : public Progress {
 public:
  void Begin(std::string_view, size_t) override {}
  void Advance(size_t) override {}
  void Warn(std::string_view) override {}
  void Note(std::string_view) override {}
  bool Cancelled() const override { return false; }
};

class Forgetful : public UnitStore {
 public:
  std::optional<std::string> Load(std::string_view, std::string_view) override { return {}; }
  void Save(std::string_view, std::string_view, std::string_view) override {}
};

}  // namespace

void StageContext::ThrowIfCancelled() const {
  if (progress != nullptr && progress->Cancelled()) {
    throw Error(ErrorKind::kInterrupted, "interrupted",
                "run the same command again to go on from here");
  }
}

std::string ComputeUnit(const StageContext& context, std::string_view kind, std::string_view key,
                        const std::function<std::string()>& compute) {
  assert(context.units != nullptr);
  context.ThrowIfCancelled();
  if (std::optional<std::string> saved = context.units->Load(kind, key)) return *std::move(saved);
  std::string bytes = compute();
  context.units->Save(kind, key, bytes);
  return bytes;
}

Progress& SilentProgress() {
  static Silent silent;  // has no state
  return silent;
}

UnitStore& NoUnits() {
  static Forgetful forgetful;  // has no state
  return forgetful;
}

}  // namespace stucco
