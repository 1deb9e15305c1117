// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "survey/occluders.h"

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

// A device of Embree that is given a number of threads limits TBB in the whole process.
TEST(ParallelFor, UsesTwoThreadsWhileAnEmbreeSceneIsAlive) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "the machine has one core";
  const Occluders alive({}, {});
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  std::atomic<int> running = 0;
  std::atomic<bool> both = false;
  ParallelFor(2, 2, [&](size_t) {
    ++running;
    while (!both && std::chrono::steady_clock::now() < deadline) {
      if (running == 2) both = true;
      std::this_thread::yield();
    }
    --running;
  });
  EXPECT_TRUE(both);
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

// Each index waits for up to three random earlier ones.
std::vector<std::vector<size_t>> RandomOrder(size_t count) {
  std::mt19937 random(1);
  std::vector<std::vector<size_t>> before(count);
  for (size_t i = 1; i < count; ++i) {
    for (size_t k = random() % 4; k > 0; --k) before[i].push_back(random() % i);
  }
  return before;
}

TEST(ParallelInOrder, CallsEachIndexOnceAfterThoseItWaitsFor) {
  for (const size_t count : {size_t{0}, size_t{1}, size_t{2}, size_t{2000}}) {
    const std::vector<std::vector<size_t>> before = RandomOrder(count);
    for (const int threads : {-1, 1, 2, 7}) {
      std::vector<std::atomic<int>> ended(count);
      std::atomic<int> early = 0;
      ParallelInOrder(before, threads, [&](size_t i) {
        for (const size_t earlier : before[i]) early += ended[earlier] != 1;
        ++ended[i];
      });
      EXPECT_EQ(early, 0) << threads;
      for (size_t i = 0; i < count; ++i) EXPECT_EQ(ended[i], 1) << threads << " " << i;
    }
  }
}

TEST(ParallelInOrder, RethrowsAndCallsNothingThatWaitsForTheFailed) {
  std::vector<std::vector<size_t>> before(100);
  for (size_t i = 1; i < before.size(); ++i) before[i].push_back(i - 1);
  for (const int threads : {1, 4}) {
    std::atomic<int> calls = 0;
    EXPECT_THROW(ParallelInOrder(before, threads,
                                 [&](size_t i) {
                                   ++calls;
                                   if (i == 17) throw std::runtime_error("seventeen");
                                 }),
                 std::runtime_error);
    EXPECT_EQ(calls, 18);
  }
}

TEST(ParallelInOrderDeathTest, RequiresOrder) {
  const std::vector<std::vector<size_t>> before = {{1}, {}};
  EXPECT_DEATH(ParallelInOrder(before, 1, [](size_t) {}), "WaitsForEarlierOnes");
}

}  // namespace
}  // namespace stucco
