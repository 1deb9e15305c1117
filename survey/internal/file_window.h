// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "survey/error.h"
#include "survey/text.h"

namespace stucco::internal {

// A file read through a window that moves along it.
class FileWindow {
 public:
  explicit FileWindow(const std::filesystem::path& path) : stream_(path, std::ios::binary) {
    std::error_code error;
    unread_ = size_ = stream_ ? std::filesystem::file_size(path, error) : 0;
    if (stream_ && !error) return;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: cannot be read: {}", path.string(),
                            error ? error.message() : std::generic_category().message(errno)),
                "check the path of the file");
  }

  // What comes next: at least `wanted` bytes, unless the file ends before. Valid until the next
  // call.
  std::string_view Peek(size_t wanted) {
    if (buffer_.size() - begin_ < wanted && unread_ > 0) Refill(wanted);
    return std::string_view(buffer_).substr(begin_);
  }
  void Skip(size_t bytes) { begin_ += bytes; }
  // Bytes from the beginning of the file to what comes next.
  uint64_t At() const { return size_ - Left(); }
  void GoTo(uint64_t byte) {
    buffer_.clear();
    begin_ = 0;
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(byte));
    unread_ = stream_ && byte < size_ ? size_ - byte : 0;
  }
  // Bytes to the end of the file.
  uint64_t Left() const { return unread_ + (buffer_.size() - begin_); }

  // The next line without its end; nothing at the end of the file.
  std::optional<std::string> NextLine() {
    if (Left() == 0) return std::nullopt;
    std::string line;
    for (bool ended = false; !ended && Left() > 0;) {
      const std::string_view ahead = Peek(1);
      const size_t end = ahead.find('\n');
      ended = end != std::string_view::npos;
      line += ahead.substr(0, end);
      Skip(ended ? end + 1 : ahead.size());
    }
    if (line.ends_with('\r')) line.pop_back();
    return line;
  }

  // The next text between blanks; empty at the end of the file.
  std::string_view NextWord() {
    constexpr size_t kLongestWord = 4096;
    std::string_view ahead = Peek(kLongestWord);
    size_t blanks = 0;
    while (blanks < ahead.size() && IsBlank(ahead[blanks])) {
      if (++blanks < ahead.size()) continue;
      Skip(blanks);
      ahead = Peek(kLongestWord);
      blanks = 0;
    }
    Skip(blanks);
    ahead = Peek(kLongestWord);
    const std::string_view word = TakeWord(ahead);
    Skip(word.size());
    return word;
  }

 private:
  void Refill(size_t wanted) {
    constexpr size_t kBlockBytes = size_t{1} << 20;
    buffer_.erase(0, begin_);
    begin_ = 0;
    const size_t kept = buffer_.size();
    buffer_.resize(kept + std::min<uint64_t>(std::max(wanted, kBlockBytes), unread_));
    stream_.read(buffer_.data() + kept, static_cast<std::streamsize>(buffer_.size() - kept));
    const auto count = static_cast<size_t>(stream_.gcount());
    buffer_.resize(kept + count);
    unread_ = stream_ ? unread_ - count : 0;  // the file has become shorter
  }

  std::ifstream stream_;
  std::string buffer_;
  size_t begin_ = 0;
  uint64_t size_ = 0;
  uint64_t unread_ = 0;
};

}  // namespace stucco::internal
