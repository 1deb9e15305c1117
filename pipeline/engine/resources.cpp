// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/resources.h"

#include <malloc.h>
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>

namespace stucco {
namespace {

double WallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// A line "VmHWM:   1234 kB" of a /proc file; 0 when it is not there.
double ProcMb(const char* file, const std::string& field) {
  std::ifstream in(file);
  for (std::string name; in >> name;) {
    double kilobytes = 0;
    if (name == field + ":" && in >> kilobytes) {
      return kilobytes / 1024;
    }
    in.ignore(1 << 16, '\n');
  }
  return 0;
}

double PeakMemoryMb() {
  if (const double peak = ProcMb("/proc/self/status", "VmHWM"); peak > 0) {
    return peak;
  }
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

double CpuSeconds() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
}

UsageMeter::UsageMeter() : start_wall_s_(WallSeconds()), start_cpu_s_(CpuSeconds()) {
#ifdef __GLIBC__
  // What was freed before goes back to the system and does not count here.
  malloc_trim(0);
#endif
  // proc(5): writing 5 resets the peak resident set size to the present one.
  std::ofstream("/proc/self/clear_refs") << "5";
}

Usage UsageMeter::Read() const {
  return {WallSeconds() - start_wall_s_, CpuSeconds() - start_cpu_s_, PeakMemoryMb(),
          AvailableCores()};
}

double CurrentMemoryMb() {
  return ProcMb("/proc/self/status", "VmRSS");
}

double AvailableMemoryMb() {
  return ProcMb("/proc/meminfo", "MemAvailable");
}

double FreeDiskMb(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path existing = std::filesystem::absolute(path, error);
  while (!existing.empty() && !std::filesystem::exists(existing, error) &&
         existing != existing.parent_path()) {
    existing = existing.parent_path();
  }
  const std::filesystem::space_info space = std::filesystem::space(existing, error);
  return error ? -1 : static_cast<double>(space.available) / (1 << 20);
}

int AvailableCores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(0, sizeof(cores), &cores) == 0) {
    return std::max(1, CPU_COUNT(&cores));
  }
  return std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace stucco
