// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/solids/soundness.h"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <utility>

#include "survey/triangulate.h"

namespace stucco {
namespace {

// The first line of what was thrown: CGAL's have several.
std::string FirstLine(const std::exception& thrown) {
  const std::string text = thrown.what();
  return text.substr(0, text.find('\n'));
}

}  // namespace

std::optional<std::string> FindFacetFault(const Facet& facet) {
  Facet named = facet;
  named.id = "-";
  Proxy alone;
  alone.buildings = {{.id = "-", .source = {}, .detail = {}, .facets = {named}}};
  if (auto problem = FindProblem(alone)) return problem->substr(problem->find(": ") + 2);
  if (TriangulateFacet(facet).triangles.empty()) return "nothing lies inside its rings";
  return std::nullopt;
}

Solid CloseOrExplain(const std::function<Solid()>& close) {
  Solid failed;
  try {
    Solid solid = close();
    for (const Facet& facet : solid.facets) {
      if (const auto fault = FindFacetFault(facet))
        failed.why_not = fmt::format("has an unsound facet: {}", *fault);
    }
    if (failed.why_not.empty()) return solid;
  } catch (const std::bad_alloc&) {
    failed.why_not = "it needs more memory than there is";
  } catch (const std::exception& thrown) {
    failed.why_not = fmt::format("its geometry fails: {}", FirstLine(thrown));
  }
  return failed;
}

std::vector<Facet> OutlineOrWarn(const std::function<std::vector<Facet>()>& outline,
                                 std::vector<std::string>& warnings) {
  std::vector<Facet> sound;
  try {
    for (Facet& facet : outline()) {
      if (const auto fault = FindFacetFault(facet)) {
        warnings.push_back(fmt::format("left out a facet of area {:.3g}: {}", facet.area, *fault));
      } else {
        sound.push_back(std::move(facet));
      }
    }
  } catch (const std::exception& thrown) {
    warnings.push_back(
        fmt::format("left out the facets of a plane, its geometry fails: {}", FirstLine(thrown)));
    sound.clear();
  }
  return sound;
}

}  // namespace stucco
