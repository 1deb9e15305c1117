// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace stucco {

// Calls fn(0) ... fn(count - 1) on up to `threads` threads (TBB), each index once, in no promised
// order. The first exception is rethrown after the running calls ended. Results that must not
// depend on the number of threads are written to slots by index, never accumulated.
void ParallelFor(size_t count, int threads, const std::function<void(size_t)>& fn);

}  // namespace stucco
