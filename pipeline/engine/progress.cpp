// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/progress.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/engine/resources.h"

namespace stucco {
namespace {

constexpr auto kTick = std::chrono::milliseconds(200);
constexpr double kLineInterval_s = 30;  // between lines when there is no terminal
constexpr double kEventInterval_s = 5;
constexpr double kRateWindow_s = 20;

}  // namespace

void RateMeter::Restart(double now_s) {
  samples_ = {{now_s, 0}};
}

void RateMeter::Add(double now_s, size_t done) {
  samples_.push_back({now_s, done});
  // The oldest one kept is the last before the window, so that slow units are seen at all.
  while (samples_.size() > 2 && samples_[1].time_s <= now_s - kRateWindow_s &&
         samples_[1].done < done) {
    samples_.pop_front();
  }
}

double RateMeter::rate() const {
  if (samples_.size() < 2) {
    return 0;
  }
  const double seconds = samples_.back().time_s - samples_.front().time_s;
  const auto units = static_cast<double>(samples_.back().done - samples_.front().done);
  return seconds > 0 ? units / seconds : 0;
}

std::string ProgressText(std::string_view stage, std::string_view step, size_t done, size_t total,
                         double rate) {
  std::string text = fmt::format("{}: {}", stage, step);
  if (total > 0) {
    done = std::min(done, total);
    text +=
        fmt::format(" {}/{} ({} %)", GroupedDigits(done), GroupedDigits(total), 100 * done / total);
    if (rate > 0) {
      const double left_s = static_cast<double>(total - done) / rate;
      text += rate >= 0.95 ? fmt::format(", {:.3g}/s", rate)
                           : fmt::format(", {} each", DurationText(1 / rate));
      text += fmt::format(", {} left", DurationText(left_s));
    }
  }
  return text + fmt::format(", {}", MemoryText(CurrentMemoryMb()));
}

StageProgress::StageProgress(std::string stage, Console& console, EventLog& events,
                             std::function<bool()> interrupted)
    : stage_(std::move(stage)),
      console_(console),
      events_(events),
      interrupted_(std::move(interrupted)),
      watcher_([this] { Watch(); }) {}

StageProgress::~StageProgress() {
  {
    const std::lock_guard lock(mutex_);
    EndStep();
    stop_ = true;
  }
  wake_.notify_all();
  watcher_.join();
  console_.Bar("");
}

double StageProgress::Now() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

std::string StageProgress::Text() const {
  return ProgressText(stage_, step_, done_, total_, rate_.rate());
}

void StageProgress::EndStep() {
  if (step_.empty()) {
    return;
  }
  const Usage usage{Now() - step_start_s_, CpuSeconds() - step_start_cpu_s_, 0, AvailableCores()};
  events_.Write("step_done", {{"stage", stage_},
                              {"step", step_},
                              {"done", static_cast<int64_t>(done_)},
                              {"total", static_cast<int64_t>(total_)},
                              {"wall_s", usage.wall_s},
                              {"cpu_s", usage.cpu_s}});
  console_.Detail(fmt::format("  {}: {} took {}", stage_, step_, UsageText(usage)));
  step_.clear();
}

void StageProgress::Begin(std::string_view step, size_t total) {
  const std::lock_guard lock(mutex_);
  EndStep();
  step_ = step;
  total_ = total;
  done_ = 0;
  step_start_s_ = Now();
  step_start_cpu_s_ = CpuSeconds();
  next_line_s_ = step_start_s_ + kLineInterval_s;
  next_event_s_ = step_start_s_ + kEventInterval_s;
  rate_.Restart(step_start_s_);
  events_.Write("step",
                {{"stage", stage_}, {"step", step_}, {"total", static_cast<int64_t>(total)}});
  if (!console_.is_terminal()) {
    console_.Line(total > 0 ? fmt::format("  {}: {} ({})", stage_, step_, GroupedDigits(total))
                            : fmt::format("  {}: {}", stage_, step_));
  }
}

void StageProgress::Advance(size_t units) {
  done_ += units;
}

void StageProgress::Warn(std::string_view text) {
  console_.Warning(fmt::format("  {}: warning: {}", stage_, text));
  events_.Write("warning", {{"stage", stage_}, {"text", std::string(text)}});
}

void StageProgress::Note(std::string_view text) {
  console_.Line(fmt::format("  {}: {}", stage_, text));
  events_.Write("note", {{"stage", stage_}, {"text", std::string(text)}});
}

bool StageProgress::Cancelled() const {
  return interrupted_();
}

void StageProgress::Watch() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kTick, [this] { return stop_; })) {
    if (step_.empty()) {
      continue;
    }
    const double now_s = Now();
    rate_.Add(now_s, done_);
    console_.Bar(Text());
    if (!console_.is_terminal() && now_s >= next_line_s_) {
      next_line_s_ = now_s + kLineInterval_s;
      console_.Line("  " + Text());
    }
    if (now_s >= next_event_s_) {
      next_event_s_ = now_s + kEventInterval_s;
      events_.Write("progress", {{"stage", stage_},
                                 {"step", step_},
                                 {"done", static_cast<int64_t>(done_)},
                                 {"total", static_cast<int64_t>(total_)},
                                 {"per_s", rate_.rate()},
                                 {"memory_mb", CurrentMemoryMb()}});
    }
  }
}

}  // namespace stucco
