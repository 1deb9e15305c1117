// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/console.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace stucco {
namespace {

// Back to the line's start, and everything right of it gone (ECMA-48 EL).
constexpr char kEraseLine[] = "\r\033[K";

size_t TerminalWidth(std::FILE* file) {
  winsize size = {};
  const bool known = ioctl(fileno(file), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace

Console::Console(std::FILE* file, bool is_terminal, Verbosity verbosity)
    : file_(file), is_terminal_(is_terminal), verbosity_(verbosity) {}

Console Console::ForStderr(Verbosity verbosity) {
  return Console(stderr, isatty(STDERR_FILENO) == 1, verbosity);
}

void Console::Print(std::string_view text) {
  const std::lock_guard lock(mutex_);
  Write(fmt::format("{}{}\n{}", bar_.empty() ? "" : kEraseLine, text, bar_));
}

// A terminal that was closed or a full disk must not end hours of work.
void Console::Write(const std::string& text) {
  if (!lost_) {
    lost_ =
        std::fwrite(text.data(), 1, text.size(), file_) != text.size() || std::fflush(file_) != 0;
  }
}

void Console::Line(std::string_view text) {
  if (verbosity_ != Verbosity::kQuiet) {
    Print(text);
  }
}

void Console::Detail(std::string_view text) {
  if (verbosity_ == Verbosity::kVerbose) {
    Print(text);
  }
}

void Console::Warning(std::string_view text) {
  Print(text);
}

void Console::Bar(std::string_view text) {
  if (!is_terminal_ || verbosity_ == Verbosity::kQuiet) {
    return;
  }
  const std::lock_guard lock(mutex_);
  // A bar longer than the line would leave its head behind at every redraw.
  bar_ = text.substr(0, TerminalWidth(file_) - 1);
  Write(kEraseLine + bar_);
}

std::string DurationText(double seconds) {
  if (!(seconds >= 0)) {
    return "unknown";
  }
  if (seconds < 9.95) {
    return fmt::format("{:.1f} s", seconds);
  }
  const auto whole = static_cast<int64_t>(std::llround(seconds));
  if (whole < 60) {
    return fmt::format("{} s", whole);
  }
  if (whole < 3600) {
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  }
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string CoresText(const Usage& usage) {
  constexpr double kShortest_s = 0.05;  // a few ticks of the clock that counts CPU time
  if (!(usage.wall_s >= kShortest_s) || usage.cores <= 0) {
    return {};
  }
  return fmt::format("{:.1f} of {} core{}", usage.cpu_s / usage.wall_s, usage.cores,
                     usage.cores == 1 ? "" : "s");
}

std::string UsageText(const Usage& usage) {
  const std::string cores = CoresText(usage);
  return DurationText(usage.wall_s) + (cores.empty() ? "" : fmt::format(", {} busy", cores));
}

std::string MemoryText(double megabytes) {
  return megabytes < 1000 ? fmt::format("{:.0f} MiB", megabytes)
                          : fmt::format("{:.1f} GiB", megabytes / 1024);
}

std::string GroupedDigits(size_t count) {
  std::string digits = fmt::format("{}", count);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<size_t>(at), 1, ' ');
  }
  return digits;
}

}  // namespace stucco
