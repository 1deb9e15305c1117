// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "texture/grid/relief.h"

namespace stucco {

inline constexpr char kReliefFolder[] = "relief";

// A relief as a picture of 16 bits and what its values mean (see docs/formats.md).
struct ReliefFiles {
  std::string png;
  std::string json;  // empty: there is none
};

ReliefFiles EncodeRelief(const Relief& relief);

// relief/NAME.png and .json below `folder`; nothing where there is no relief. Throws Error
// (kBadInput) when one of them is damaged.
std::shared_ptr<const Relief> ReadRelief(const std::filesystem::path& folder,
                                         const std::string& name);

}  // namespace stucco
