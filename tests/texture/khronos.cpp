// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/texture/khronos.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>

namespace stucco::test {

std::optional<std::string> KhronosFindings(const std::filesystem::path& glb) {
  const std::filesystem::path root = STUCCO_ROOT;
  const std::filesystem::path modules = root / "build/checkers/node_modules";
  if (!std::filesystem::exists(modules / "gltf-validator")) return std::nullopt;
  const std::string command =
      fmt::format("node '{}' '{}' '{}' 2>&1", (root / "tests/texture/khronos.js").string(),
                  modules.string(), glb.string());
  FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) return "node cannot be started";
  std::string findings;
  std::array<char, 512> part;
  while (std::fgets(part.data(), part.size(), output) != nullptr) findings += part.data();
  const int status = pclose(output);
  if (status != 0) findings += fmt::format("node ended with status {}", status);
  return findings;
}

}  // namespace stucco::test
