// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "pipeline/engine/console.h"
#include "pipeline/engine/events.h"
#include "survey/stage.h"

namespace stucco {

// Speed over the last seconds. A step often begins with units that are already there; a mean since
// the start would promise their speed for the rest.
class RateMeter {
 public:
  void Restart(double now_s);
  void Add(double now_s, size_t done);
  // Units per second; 0 as long as it is not known.
  double rate() const;

 private:
  struct Sample {
    double time_s;
    size_t done;
  };
  std::deque<Sample> samples_;
};

// "calib: matching pairs 120/450 (27 %), 12.3/s, 27 s left, 812 MiB"
std::string ProgressText(std::string_view stage, std::string_view step, size_t done, size_t total,
                         double rate);

// Shows a running stage: a bar on a terminal, a line every half minute elsewhere, and records in
// the event log. A thread of its own draws, so that counting units costs nothing. Cancelled once
// `interrupted` (of the platform) says so.
class StageProgress : public Progress {
 public:
  StageProgress(std::string stage, Console& console, EventLog& events,
                std::function<bool()> interrupted);
  ~StageProgress() override;

  void Begin(std::string_view step, size_t total) override;
  void Advance(size_t units = 1) override;
  void Warn(std::string_view text) override;
  void Note(std::string_view text) override;
  bool Cancelled() const override;

 private:
  void Watch();
  void EndStep();
  std::string Text() const;
  double Now() const;

  const std::string stage_;
  Console& console_;
  EventLog& events_;
  const std::function<bool()> interrupted_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::atomic<size_t> done_ = 0;
  std::mutex mutex_;  // for what follows
  std::string step_;
  size_t total_ = 0;
  double step_start_s_ = 0;
  double step_start_cpu_s_ = 0;
  double next_line_s_ = 0;
  double next_event_s_ = 0;
  RateMeter rate_;
  bool stop_ = false;
  std::condition_variable wake_;
  std::thread watcher_;  // last: it uses everything above
};

}  // namespace stucco
