// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

namespace stucco {
namespace {

constexpr int kInterruptedExitCode = 130;

// All that a signal handler can tell of; read through the platform only.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "used in a signal handler");

void Say(std::string_view text) {
  // write() is all that a signal handler may do; whether it worked changes nothing.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
}

extern "C" void HandleInterrupt(int) {
  if (interrupted.exchange(true)) {
    Say("\nStopped at once; run again to continue.\n");
    _exit(kInterruptedExitCode);
  }
  Say("\nStopping at the next safe point (once more to stop at once) ...\n");
}

}  // namespace

Platform CatchInterrupts() {
  struct sigaction action = {};
  action.sa_handler = HandleInterrupt;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  Platform platform = RealPlatform();
  platform.interrupted = [] { return interrupted.load(std::memory_order_relaxed); };
  return platform;
}

}  // namespace stucco
