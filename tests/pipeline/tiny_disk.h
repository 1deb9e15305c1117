// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/mount.h>

#include <filesystem>

namespace stucco {

// A file system of 200 KiB over a folder, as long as this lives. Needs the right to mount, as in a
// container's root.
class TinyDisk {
 public:
  explicit TinyDisk(const std::filesystem::path& folder, const char* limits = "size=200k")
      : folder_(folder) {
    mounted_ = mount("none", folder.c_str(), "tmpfs", 0, limits) == 0;
  }
  ~TinyDisk() {
    if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  bool mounted() const { return mounted_; }

 private:
  std::filesystem::path folder_;
  bool mounted_;
};

}  // namespace stucco
