// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/model_to_write.h"

namespace stucco {

namespace fs = std::filesystem;

std::string PathFrom(const fs::path& folder, const ModelToWrite& what,
                     const RegisteredImage& photo) {
  const fs::path path = fs::absolute(what.photos / photo.name).lexically_normal();
  const fs::path base = fs::absolute(folder.empty() ? fs::path(".") : folder).lexically_normal();
  const fs::path relative = path.lexically_relative(base);
  return (relative.empty() ? path : relative).generic_string();
}

}  // namespace stucco
