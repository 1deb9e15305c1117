// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace stucco {

struct EventField {
  std::string name;
  std::variant<std::string, int64_t, double, bool> value;
};

// The log of all runs of a survey: .stucco/events.ndjson, one JSON object a line, append only.
// Fields are described in docs/events.md. Every record is one write, so that readers that follow
// the file see whole lines; a line torn by a power cut is closed by the next run. Thread-safe;
// failing to write is never an error of the run.
class EventLog {
 public:
  // Without a path nothing is written.
  EventLog() = default;
  explicit EventLog(const std::filesystem::path& path);
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  void Write(std::string_view event, const std::vector<EventField>& fields);

 private:
  std::mutex mutex_;
  int file_ = -1;
};

}  // namespace stucco
