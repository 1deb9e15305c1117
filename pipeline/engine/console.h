// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>

#include "pipeline/engine/resources.h"

namespace stucco {

enum class Verbosity { kQuiet, kNormal, kVerbose };

// Where a run tells people what it does: stderr, usually. On a terminal the last line is a bar that
// is drawn over in place; elsewhere there are only whole lines. What cannot be written is
// dropped, and after the first failure nothing more is tried. Thread-safe.
class Console {
 public:
  Console(std::FILE* file, bool is_terminal, Verbosity verbosity);
  // To stderr, as a terminal when it is one.
  static Console ForStderr(Verbosity verbosity);
  Console(Console&&) = delete;

  bool is_terminal() const { return is_terminal_; }
  Verbosity verbosity() const { return verbosity_; }

  void Line(std::string_view text);     // not when quiet
  void Detail(std::string_view text);   // only when verbose
  void Warning(std::string_view text);  // always
  // Draws the bar (terminal only, not when quiet); empty text takes it away.
  void Bar(std::string_view text);

 private:
  void Print(std::string_view text);
  void Write(const std::string& text);

  std::FILE* file_;
  bool is_terminal_;
  Verbosity verbosity_;
  std::mutex mutex_;
  std::string bar_;
  bool lost_ = false;
};

// "12 s", "3 min 05 s", "2 h 07 min".
std::string DurationText(double seconds);

// How many cores a piece of work kept busy in the mean, of those that there were: "1.1 of 2 cores".
// Empty where that is not known, or the work too short to tell.
std::string CoresText(const Usage& usage);

// "5 min 29 s, 1.1 of 2 cores busy"; only the time where nothing is known of the cores.
std::string UsageText(const Usage& usage);

// "812 MiB", "3.2 GiB"; of 2^20 bytes each, as settings count them.
std::string MemoryText(double megabytes);

// "11 298".
std::string GroupedDigits(size_t count);

}  // namespace stucco
