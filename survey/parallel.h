// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace stucco {

// Calls fn(0) ... fn(count - 1) on up to `threads` threads (TBB), each index once, in no promised
// order. The first exception is rethrown after the running calls ended. Results that must not
// depend on the number of threads are written to slots by index, never accumulated.
void ParallelFor(size_t count, int threads, const std::function<void(size_t)>& fn);

// The same for each index of `before`, fn(i) after the calls for all indices in before[i] ended.
// Requires that these are smaller than i. Indices that do not wait for each other run at the same
// time.
void ParallelInOrder(std::span<const std::vector<size_t>> before, int threads,
                     const std::function<void(size_t)>& fn);

}  // namespace stucco
