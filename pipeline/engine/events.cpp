// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/events.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>

#include "pipeline/engine/internal/json.h"

namespace stucco {
namespace {

// "2026-03-01T12:00:00.123Z"
std::string UtcNow() {
  const auto now = std::chrono::system_clock::now();
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(now)), ms.count() % 1000);
}

bool EndsInLine(int file) {
  struct stat status = {};
  char last = '\n';
  return fstat(file, &status) != 0 || status.st_size == 0 ||
         pread(file, &last, 1, status.st_size - 1) != 1 || last == '\n';
}

}  // namespace

EventLog::EventLog(const std::filesystem::path& path) {
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ >= 0 && !EndsInLine(file_)) {
    [[maybe_unused]] const ssize_t written = write(file_, "\n", 1);
  }
}

EventLog::~EventLog() {
  if (file_ >= 0) {
    close(file_);
  }
}

void EventLog::Write(std::string_view event, const std::vector<EventField>& fields) {
  if (file_ < 0) {
    return;
  }
  nlohmann::ordered_json json = {{"time", UtcNow()}, {"event", event}};
  for (const EventField& field : fields) {
    std::visit([&](const auto& value) { json[field.name] = value; }, field.value);
  }
  const std::string line = Dump(json) + "\n";
  const std::lock_guard lock(mutex_);
  [[maybe_unused]] const ssize_t written = write(file_, line.data(), line.size());
}

}  // namespace stucco
