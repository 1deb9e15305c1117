// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stage.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/survey/support.h"

namespace stucco {
namespace {

class MapUnits : public UnitStore {
 public:
  std::optional<std::string> Load(std::string_view kind, std::string_view key) override {
    const auto found = units_.find(std::string(kind) + "/" + std::string(key));
    if (found == units_.end()) return std::nullopt;
    return found->second;
  }
  void Save(std::string_view kind, std::string_view key, std::string_view bytes) override {
    units_[std::string(kind) + "/" + std::string(key)] = bytes;
  }

 private:
  std::map<std::string, std::string> units_;
};

class Stopped : public Progress {
 public:
  void Begin(std::string_view, size_t) override {}
  void Advance(size_t) override {}
  void Warn(std::string_view) override {}
  void Note(std::string_view) override {}
  bool Cancelled() const override { return true; }
};

TEST(Stage, ComputesAUnitOnce) {
  MapUnits units;
  StageContext context;
  context.progress = &SilentProgress();
  context.units = &units;
  int computed = 0;
  const auto compute = [&] {
    ++computed;
    return std::string("bytes\0more", 10);
  };
  EXPECT_EQ(ComputeUnit(context, "features", "1", compute), std::string("bytes\0more", 10));
  EXPECT_EQ(ComputeUnit(context, "features", "1", compute), std::string("bytes\0more", 10));
  EXPECT_EQ(computed, 1);
  ComputeUnit(context, "features", "2", compute);
  ComputeUnit(context, "matches", "1", compute);
  EXPECT_EQ(computed, 3);
}

TEST(Stage, AFailedUnitIsNotSaved) {
  MapUnits units;
  StageContext context;
  context.progress = &SilentProgress();
  context.units = &units;
  EXPECT_THROW(ComputeUnit(context, "a", "1",
                           []() -> std::string { throw Error(ErrorKind::kStageFailed, "no"); }),
               Error);
  EXPECT_FALSE(units.Load("a", "1"));
}

TEST(Stage, NoUnitsForgets) {
  StageContext context;
  context.progress = &SilentProgress();
  context.units = &NoUnits();
  int computed = 0;
  const auto compute = [&] { return std::to_string(++computed); };
  EXPECT_EQ(ComputeUnit(context, "a", "1", compute), "1");
  EXPECT_EQ(ComputeUnit(context, "a", "1", compute), "2");
}

TEST(Stage, StopsWhenAsked) {
  StageContext context;
  EXPECT_NO_THROW(context.ThrowIfCancelled());
  context.progress = &SilentProgress();
  EXPECT_NO_THROW(context.ThrowIfCancelled());
  Stopped stopped;
  context.progress = &stopped;
  context.units = &NoUnits();
  EXPECT_EQ(test::ErrorOf([&] { context.ThrowIfCancelled(); }).kind(), ErrorKind::kInterrupted);
  const Error error = test::ErrorOf([&] {
    ComputeUnit(context, "a", "1", []() -> std::string {
      ADD_FAILURE() << "computed after the stop";
      return {};
    });
  });
  EXPECT_EQ(error.kind(), ErrorKind::kInterrupted);
  EXPECT_FALSE(error.remedy().empty());
}

}  // namespace
}  // namespace stucco
