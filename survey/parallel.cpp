// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/parallel.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace stucco {

void ParallelFor(size_t count, int threads, const std::function<void(size_t)>& fn) {
  // More threads than the machine has would only make TBB warn.
  threads = std::min(threads, tbb::info::default_concurrency());
  if (threads <= 1 || count <= 1) {
    for (size_t i = 0; i < count; ++i) fn(i);
    return;
  }
  // An arena of its own: a thread that waits inside a nested call never picks up an outer index.
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        size_t{0}, count, [&](size_t i) { fn(i); }, tbb::simple_partitioner());
  });
}

}  // namespace stucco
