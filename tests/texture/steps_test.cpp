// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/steps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <future>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace stucco {
namespace {

using testing::ElementsAre;

// Facets being worked on at the same time, and in which order they began.
class Watched {
 public:
  explicit Watched(std::vector<uint64_t> bytes) : bytes_(std::move(bytes)) {}

  void Run(int threads, uint64_t budget) {
    StageContext context;
    context.threads = threads;
    context.memory_limit_bytes = 2 * budget;
    ForEachFacet(bytes_, context, [&](size_t facet) {
      Begin(facet);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      End(facet);
    });
  }

  std::vector<size_t> order;
  uint64_t most = 0;  // bytes at the same time

 private:
  void Begin(size_t facet) {
    const std::lock_guard lock(mutex_);
    order.push_back(facet);
    bytes_now_ += bytes_[facet];
    most = std::max(most, bytes_now_);
  }
  void End(size_t facet) {
    const std::lock_guard lock(mutex_);
    bytes_now_ -= bytes_[facet];
  }

  const std::vector<uint64_t> bytes_;
  std::mutex mutex_;
  uint64_t bytes_now_ = 0;
};

TEST(ForEachFacet, BeginsWithTheOneThatNeedsMost) {
  Watched facets({10, 40, 0, 30, 20});
  facets.Run(1, 100);
  EXPECT_THAT(facets.order, ElementsAre(1, 3, 4, 0, 2));
}

TEST(ForEachFacet, StaysWithinItsMemory) {
  Watched facets({60, 60, 50, 50, 40, 30, 20, 10});
  facets.Run(4, 100);
  EXPECT_EQ(facets.order.size(), 8u);
  EXPECT_LE(facets.most, 100u);
}

TEST(ForEachFacet, SmallOnesGoBesideALargeOne) {
  StageContext context;
  context.threads = 2;
  context.memory_limit_bytes = 200;
  std::promise<size_t> beside;
  std::atomic<bool> is_known = false;
  bool was_beside = false;
  const std::vector<uint64_t> bytes = {90, 80, 10, 10};
  ForEachFacet(bytes, context, [&](size_t facet) {
    if (facet == 0) {
      std::future<size_t> other = beside.get_future();
      was_beside = other.wait_for(std::chrono::seconds(20)) == std::future_status::ready;
      EXPECT_TRUE(was_beside && other.get() > 1);
    } else if (!is_known.exchange(true)) {
      beside.set_value(facet);
    }
  });
  EXPECT_TRUE(was_beside);
}

TEST(ForEachFacet, OneThatNeedsMoreThanThereIsGoesAlone) {
  Watched facets({500, 10, 10, 10});
  facets.Run(4, 100);
  EXPECT_EQ(facets.order.size(), 4u);
  EXPECT_EQ(facets.most, 500u);
}

TEST(ForEachFacet, PassesErrorsOn) {
  StageContext context;
  context.threads = 2;
  const std::vector<uint64_t> bytes(20, context.memory_limit_bytes);
  EXPECT_THROW(
      ForEachFacet(bytes, context, [](size_t) { throw std::runtime_error("cannot paint"); }),
      std::runtime_error);
}

TEST(ForEachFacet, NothingIsNothing) {
  ForEachFacet({}, StageContext(), [](size_t) { FAIL(); });
}

}  // namespace
}  // namespace stucco
