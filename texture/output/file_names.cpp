// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/file_names.h"

#include <fmt/format.h>

#include <set>

namespace stucco {
namespace {

bool IsPlain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || c == '.';
}

std::string Lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::vector<std::string> FileNames(const std::vector<std::string>& ids) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const std::string& id : ids) {
    std::string plain = id;
    for (char& c : plain) {
      if (!IsPlain(c)) c = '_';
    }
    if (plain.empty() || plain.front() == '.') plain.insert(plain.begin(), '_');
    std::string name = plain;
    for (int k = 2; !taken.insert(Lower(name)).second; ++k) name = fmt::format("{}-{}", plain, k);
    names.push_back(name);
  }
  return names;
}

}  // namespace stucco
