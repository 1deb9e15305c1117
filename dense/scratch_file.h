// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <type_traits>

namespace stucco {

// A file that loses its name as soon as it is open, so that nothing stays behind whatever happens.
// Errors name the folder that it was made in (kOutOfResource for a full disk).
class ScratchFile {
 public:
  explicit ScratchFile(const std::filesystem::path& folder);

  void Write(const void* bytes, size_t size);
  // Reading begins at the start after Rewind(); writing goes on at the end after SeekEnd().
  void Rewind();
  void Read(void* bytes, size_t size);
  void SeekEnd();

  template <typename Value>
  void Write(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    Write(&value, sizeof value);
  }
  template <typename Value>
  Value Read() {
    static_assert(std::is_trivially_copyable_v<Value>);
    Value value;
    Read(&value, sizeof value);
    return value;
  }

 private:
  void Require(bool done) const;

  std::filesystem::path folder_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace stucco
