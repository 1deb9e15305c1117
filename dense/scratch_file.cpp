// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/scratch_file.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "survey/error.h"

namespace stucco {

ScratchFile::ScratchFile(const std::filesystem::path& folder)
    : folder_(folder), file_(nullptr, &std::fclose) {
  std::string path = (folder / "scratch-XXXXXX").string();
  const int descriptor = mkostemp(path.data(), O_CLOEXEC);
  Require(descriptor >= 0);
  std::filesystem::remove(path);
  file_.reset(fdopen(descriptor, "w+b"));
  Require(file_ != nullptr);
}

void ScratchFile::Write(const void* bytes, size_t size) {
  Require(std::fwrite(bytes, 1, size, file_.get()) == size);
}

void ScratchFile::Rewind() {
  Require(std::fseek(file_.get(), 0, SEEK_SET) == 0);
}

void ScratchFile::Read(void* bytes, size_t size) {
  Require(std::fread(bytes, 1, size, file_.get()) == size);
}

void ScratchFile::SeekEnd() {
  Require(std::fseek(file_.get(), 0, SEEK_END) == 0);
}

void ScratchFile::Require(bool done) const {
  if (done) return;
  const int error = errno;
  const bool full = error == ENOSPC || error == EDQUOT;
  throw Error(full ? ErrorKind::kOutOfResource : ErrorKind::kBadInput,
              fmt::format("{}: points cannot be kept there: {}", folder_.string(),
                          std::generic_category().message(error)),
              full ? "free space on this disk and run the same command again"
                   : "check that the folder exists and may be written to");
}

}  // namespace stucco
