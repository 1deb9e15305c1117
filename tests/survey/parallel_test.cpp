// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace stucco {
namespace {

TEST(ParallelFor, CallsEachIndexOnce) {
  for (const int threads : {-1, 0, 1, 2, 7}) {
    for (const size_t count : {size_t{0}, size_t{1}, size_t{2}, size_t{1000}}) {
      std::vector<std::atomic<int>> calls(count);
      ParallelFor(count, threads, [&](size_t i) { ++calls[i]; });
      for (size_t i = 0; i < count; ++i) EXPECT_EQ(calls[i], 1) << threads << " " << i;
    }
  }
}

TEST(ParallelFor, NeverRunsMoreThanItsThreads) {
  std::atomic<int> running = 0;
  std::atomic<int> most = 0;
  ParallelFor(200, 2, [&](size_t) {
    const int now = ++running;
    for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
    }
    for (volatile int spin = 0; spin < 10000;) spin = spin + 1;
    --running;
  });
  EXPECT_LE(most, 2);
}

TEST(ParallelFor, RethrowsAfterTheRunningCallsEnded) {
  for (const int threads : {1, 4}) {
    std::atomic<int> running = 0;
    try {
      ParallelFor(500, threads, [&](size_t i) {
        ++running;
        const bool fails = i == 17;
        --running;
        if (fails) throw std::runtime_error("seventeen");
      });
      FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "seventeen");
      EXPECT_EQ(running, 0);
    }
  }
  // It works again afterwards.
  std::atomic<int> calls = 0;
  ParallelFor(10, 4, [&](size_t) { ++calls; });
  EXPECT_EQ(calls, 10);
}

TEST(ParallelFor, Nests) {
  std::vector<std::vector<int>> slots(20, std::vector<int>(30));
  ParallelFor(slots.size(), 3, [&](size_t i) {
    ParallelFor(slots[i].size(), 3, [&](size_t j) { slots[i][j] = static_cast<int>(i * j); });
  });
  for (size_t i = 0; i < slots.size(); ++i) {
    for (size_t j = 0; j < slots[i].size(); ++j) EXPECT_EQ(slots[i][j], static_cast<int>(i * j));
  }
}

}  // namespace
}  // namespace stucco
