// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/parallel.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_for_each.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <map>
#include <mutex>

namespace stucco {
namespace {

// More threads than the machine has would only make TBB warn.
int Usable(int threads) {
  return std::min(threads, tbb::info::default_concurrency());
}

// Runs fn in an arena of that many threads. Arenas are kept, as TBB takes up to half a second to
// lend its workers to a new one on a busy machine. In isolation, a thread that waits inside a
// nested call never picks up an outer index.
void RunOn(int threads, const std::function<void()>& fn) {
  static std::mutex mutex;
  static std::map<int, tbb::task_arena> arenas;
  tbb::task_arena* arena = nullptr;
  {
    const std::lock_guard lock(mutex);
    arena = &arenas.try_emplace(threads, threads).first->second;
  }
  arena->execute([&] { tbb::this_task_arena::isolate(fn); });
}

[[maybe_unused]] bool WaitsForEarlierOnes(std::span<const std::vector<size_t>> before) {
  for (size_t i = 0; i < before.size(); ++i) {
    if (std::ranges::any_of(before[i], [i](size_t earlier) { return earlier >= i; })) return false;
  }
  return true;
}

}  // namespace

void ParallelFor(size_t count, int threads, const std::function<void(size_t)>& fn) {
  threads = Usable(threads);
  if (threads <= 1 || count <= 1) {
    for (size_t i = 0; i < count; ++i) fn(i);
    return;
  }
  RunOn(threads, [&] {
    tbb::parallel_for(
        size_t{0}, count, [&](size_t i) { fn(i); }, tbb::simple_partitioner());
  });
}

void ParallelInOrder(std::span<const std::vector<size_t>> before, int threads,
                     const std::function<void(size_t)>& fn) {
  assert(WaitsForEarlierOnes(before));
  threads = Usable(threads);
  if (threads <= 1 || before.size() <= 1) {
    for (size_t i = 0; i < before.size(); ++i) fn(i);
    return;
  }
  std::vector<std::vector<size_t>> after(before.size());
  std::vector<std::atomic<size_t>> missing(before.size());
  std::vector<size_t> ready;
  for (size_t i = 0; i < before.size(); ++i) {
    for (const size_t earlier : before[i]) after[earlier].push_back(i);
    missing[i] = before[i].size();
    if (before[i].empty()) ready.push_back(i);
  }
  RunOn(threads, [&] {
    tbb::parallel_for_each(ready, [&](size_t i, tbb::feeder<size_t>& feeder) {
      fn(i);
      for (const size_t later : after[i]) {
        if (--missing[later] == 0) feeder.add(later);
      }
    });
  });
}

}  // namespace stucco
