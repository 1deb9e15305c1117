// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "survey/proxy.h"

namespace stucco {

// facets.json, proxy.obj and proxy.city.json.
void WriteProxyFiles(const Proxy& proxy, const std::filesystem::path& folder);

}  // namespace stucco
