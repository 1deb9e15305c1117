// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

namespace stucco {

// What a piece of work took.
struct Usage {
  double wall_s = 0;
  double cpu_s = 0;  // of all threads, user and system
  double peak_memory_mb = 0;
  int cores = 0;  // that it could have used; 0: not known
};

// Measures this process from its construction on. Where the kernel lets a process reset its
// high-water mark (/proc/self/clear_refs), the peak is that of the measured piece; elsewhere it is
// the largest since the program started.
class UsageMeter {
 public:
  UsageMeter();
  Usage Read() const;

 private:
  double start_wall_s_;
  double start_cpu_s_;
};

// Of all threads of this process since it began, user and system.
double CpuSeconds();

double CurrentMemoryMb();  // resident set size; 0 when not known

// Memory that can be had without swapping; 0 when not known.
double AvailableMemoryMb();

// Space that an ordinary user may fill on the disk of `path` or of its nearest existing parent;
// negative when not known.
double FreeDiskMb(const std::filesystem::path& path);

int AvailableCores();  // at least 1; honours CPU affinity (taskset, containers)

}  // namespace stucco
