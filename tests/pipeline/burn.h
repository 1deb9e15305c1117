// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <time.h>

#include <thread>

namespace stucco {

// Computes on two threads until each has used so many CPU seconds, however busy the machine is.
inline void BurnOnTwoThreads(double cpu_s_each) {
  const auto cpu_s = [] {
    timespec time = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const auto burn = [cpu_s, cpu_s_each] {
    for (const double start = cpu_s(); cpu_s() - start < cpu_s_each;) {
    }
  };
  std::thread other(burn);
  burn();
  other.join();
}

}  // namespace stucco
