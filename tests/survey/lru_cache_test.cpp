// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/lru_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace stucco::test {
namespace {

struct Counted {
  std::vector<int> loads;
  LruCache<int, std::string> cache;

  explicit Counted(size_t max_bytes)
      : cache(
            max_bytes,
            [this](int key) {
              loads.push_back(key);
              return std::make_shared<const std::string>(10, static_cast<char>('a' + key));
            },
            [](const std::string& s) { return s.size(); }) {}
};

TEST(LruCache, LoadsOnceWhatFits) {
  Counted c(100);
  for (const int key : {1, 2, 1, 2, 1}) EXPECT_EQ(*c.cache.Get(key), std::string(10, 'a' + key));
  EXPECT_EQ(c.loads, (std::vector<int>{1, 2}));
}

TEST(LruCache, DropsWhatWasUsedLongestAgo) {
  Counted c(25);  // two values
  c.cache.Get(0);
  c.cache.Get(1);
  c.cache.Get(0);  // now 1 is the oldest
  c.cache.Get(2);
  c.cache.Get(0);
  EXPECT_EQ(c.loads, (std::vector<int>{0, 1, 2}));
  c.cache.Get(1);
  EXPECT_EQ(c.loads, (std::vector<int>{0, 1, 2, 1}));
}

TEST(LruCache, ForgetsAllWhenItIsCleared) {
  Counted c(100);
  const auto held = c.cache.Get(1);
  c.cache.Get(2);
  c.cache.Clear();
  EXPECT_EQ(c.cache.bytes(), 0u);
  EXPECT_EQ(*held, std::string(10, 'b'));
  c.cache.Get(1);
  EXPECT_EQ(c.loads, (std::vector<int>{1, 2, 1}));
  EXPECT_EQ(c.cache.bytes(), 10u);
}

TEST(LruCache, HoldsTheLastValueHoweverLarge) {
  Counted c(1);
  c.cache.Get(5);
  c.cache.Get(5);
  EXPECT_EQ(c.loads.size(), 1u);
  c.cache.Get(6);
  c.cache.Get(5);
  EXPECT_EQ(c.loads.size(), 3u);
}

TEST(LruCache, DroppedValuesLiveWhileTheyAreHeld) {
  Counted c(10);
  const auto held = c.cache.Get(0);
  c.cache.Get(1);
  EXPECT_EQ(*held, "aaaaaaaaaa");
}

TEST(LruCache, PassesErrorsOnAndRecovers) {
  bool broken = true;
  LruCache<int, int> cache(
      100,
      [&](int key) {
        if (broken) throw std::runtime_error("no");
        return std::make_shared<const int>(key);
      },
      [](const int&) { return size_t{4}; });
  EXPECT_THROW(cache.Get(3), std::runtime_error);
  broken = false;
  EXPECT_EQ(*cache.Get(3), 3);
}

TEST(LruCache, WhatManyAskForIsLoadedOnce) {
  std::atomic<int> loads = 0;
  LruCache<int, int> cache(
      100,
      [&](int key) {
        ++loads;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return std::make_shared<const int>(key);
      },
      [](const int&) { return size_t{4}; });
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) threads.emplace_back([&] { cache.Get(1); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(loads, 1);
}

TEST(LruCache, ServesManyThreads) {
  LruCache<int, int> cache(
      40, [](int key) { return std::make_shared<const int>(7 * key); },
      [](const int&) { return size_t{4}; });
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 2000; ++i)
        wrong[t] += *cache.Get((i * (t + 1)) % 30) != 7 * ((i * (t + 1)) % 30);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

}  // namespace
}  // namespace stucco::test
