// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/resources.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/pipeline/burn.h"

namespace stucco {
namespace {

TEST(Resources, CpuTimeIsOfAllThreads) {
  const UsageMeter meter;
  BurnOnTwoThreads(0.1);
  const Usage usage = meter.Read();
  EXPECT_GE(usage.cpu_s, 0.19);
  EXPECT_GE(usage.wall_s, 0.099);
  EXPECT_EQ(usage.cores, AvailableCores());
  EXPECT_GE(usage.cores, 1);
  EXPECT_GT(usage.peak_memory_mb, 1);
}

TEST(Resources, SleepTakesNoCpuTime) {
  const UsageMeter meter;
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const Usage usage = meter.Read();
  EXPECT_GE(usage.wall_s, 0.2);
  EXPECT_LT(usage.cpu_s, 0.1);
}

TEST(Resources, FreeDiskIsKnownOfFoldersThatAreNotThereYet) {
  const std::filesystem::path root = std::filesystem::temp_directory_path();
  EXPECT_GT(FreeDiskMb(root), 0);
  EXPECT_GT(FreeDiskMb(root / "not/there/yet"), 0);
}

TEST(Resources, MemoryInUseIsLessThanThereIs) {
  EXPECT_GT(CurrentMemoryMb(), 0);
  EXPECT_GT(AvailableMemoryMb(), 0);
}

}  // namespace
}  // namespace stucco
