// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/output/proxy_files.h"

#include "proxy/output/cityjson.h"
#include "proxy/output/obj.h"
#include "survey/files.h"

namespace stucco {

void WriteProxyFiles(const Proxy& proxy, const std::filesystem::path& folder) {
  WriteProxy(proxy, folder / "facets.json");
  WriteFile(folder / "proxy.obj", ObjText(proxy));
  WriteFile(folder / "proxy.city.json", CityJsonText(proxy));
}

}  // namespace stucco
