// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <atomic>
#include <cerrno>
#include <memory>
#include <system_error>
#include <vector>

#include "survey/error.h"
#include "survey/internal/bytes.h"
#include "survey/internal/output_file.h"

namespace stucco {
namespace {

constexpr size_t kBlockBytes = size_t{1} << 20;

[[noreturn]] void FailReading(const std::filesystem::path& path, int error) {
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("{}: cannot be read: {}", path.string(), std::generic_category().message(error)),
      error == EACCES ? "check the permissions of the file and its folders"
                      : "check the path of the file");
}

[[noreturn]] void FailWriting(const std::filesystem::path& path, int error) {
  const std::string what = fmt::format("{}: cannot be written: {}", path.string(),
                                       std::generic_category().message(error));
  if (error == ENOSPC || error == EDQUOT) {
    throw Error(ErrorKind::kOutOfResource, what,
                "free space on this disk (or raise the quota) and run the same command again");
  }
  throw Error(ErrorKind::kBadInput, what, "check that the folder exists and may be written to");
}

class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path) : path_(path) {
    descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) FailReading(path_, errno);
  }
  ~InputFile() { close(descriptor_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  // Number of bytes read; 0 at the end.
  size_t Read(char* buffer, size_t size) {
    while (true) {
      const ssize_t count = read(descriptor_, buffer, size);
      if (count >= 0) return static_cast<size_t>(count);
      if (errno != EINTR) FailReading(path_, errno);
    }
  }

  // Only a hint: 0 for pipes and devices.
  size_t Size() const {
    struct stat status {};
    return fstat(descriptor_, &status) == 0 && status.st_size > 0
               ? static_cast<size_t>(status.st_size)
               : 0;
  }

 private:
  const std::filesystem::path& path_;
  int descriptor_ = -1;
};

std::string Hex(const XXH128_hash_t& hash) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, hash);
  std::string hex;
  for (const unsigned char byte : canonical.digest) hex += fmt::format("{:02x}", byte);
  return hex;
}

class Hasher {
 public:
  Hasher() : state_(XXH3_createState(), XXH3_freeState) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(state_.get());
  }
  void Add(std::string_view bytes) {
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
  }
  std::string Digest() const { return Hex(XXH3_128bits_digest(state_.get())); }

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

// Renames are lost in a power failure until their folder is flushed. A file system that cannot
// flush folders is not an error.
void FlushFolder(const std::filesystem::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

namespace internal {

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)) {
  descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) FailWriting(path_, errno);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void OutputFile::Write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(descriptor_, bytes.data(), bytes.size());
    if (count >= 0) {
      bytes.remove_prefix(static_cast<size_t>(count));
    } else if (errno != EINTR) {
      FailWriting(path_, errno);
    }
  }
}

void OutputFile::FlushToDisk() {
  if (fsync(descriptor_) != 0) FailWriting(path_, errno);
}

void OutputFile::Close() {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (close(descriptor) != 0 && errno != EINTR) FailWriting(path_, errno);
}

void CreateFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) FailWriting(folder, error.value());
}

}  // namespace internal

std::string ReadFile(const std::filesystem::path& path) {
  InputFile file(path);
  std::string bytes;
  size_t size = 0;
  // One byte more than the file should have, so that the end is seen without growing.
  bytes.resize(file.Size() + 1);
  while (true) {
    if (size == bytes.size()) bytes.resize(bytes.size() + kBlockBytes);
    const size_t count = file.Read(bytes.data() + size, bytes.size() - size);
    if (count == 0) break;
    size += count;
  }
  bytes.resize(size);
  return bytes;
}

void WriteFile(const std::filesystem::path& path, std::string_view bytes) {
  internal::OutputFile file(path);
  file.Write(bytes);
  file.Close();
}

void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  static std::atomic<uint64_t> counter = 0;
  std::filesystem::path folder = path.parent_path();
  if (folder.empty()) folder = ".";
  const std::filesystem::path partial =
      folder / fmt::format(".{}.{}.{}.partial", path.filename().string(), getpid(), counter++);
  try {
    internal::OutputFile file(partial);
    file.Write(bytes);
    file.FlushToDisk();
    file.Close();
    if (rename(partial.c_str(), path.c_str()) != 0) FailWriting(path, errno);
  } catch (...) {
    unlink(partial.c_str());
    throw;
  }
  FlushFolder(folder);
}

std::string HashBytes(std::string_view bytes) {
  return Hex(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string HashFile(const std::filesystem::path& path) {
  InputFile file(path);
  std::vector<char> block(kBlockBytes);
  Hasher hasher;
  while (const size_t count = file.Read(block.data(), block.size())) {
    hasher.Add({block.data(), count});
  }
  return hasher.Digest();
}

std::string HashParts(std::span<const std::string> parts) {
  Hasher hasher;
  for (const std::string& part : parts) {
    std::string length;
    internal::AppendLittleEndian(length, uint64_t{part.size()});
    hasher.Add(length);
    hasher.Add(part);
  }
  return hasher.Digest();
}

}  // namespace stucco
