// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stage.h"

#include <gtest/gtest.h>

#include "tests/survey/stage_support.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

TEST(Stage, ComputesAUnitOnce) {
  test::MemoryUnits units;
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
  test::MemoryUnits units;
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
  test::Listener stopped;
  stopped.cancelled = true;
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
