// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/house_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "simulate/city/design_wall.h"
#include "simulate/city/footprints.h"
#include "simulate/city/roof_mesh.h"
#include "simulate/city/wall_mesh.h"
#include "simulate/paint/paint.h"
#include "simulate/random.h"
#include "survey/geometry2d.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTrim_m = 2;
constexpr double kTrimTexel_m = 0.01;
constexpr double kPartyTexels = 2;  // on their walls, in texels of facades
constexpr float kPaneGloss = 0.9f;

std::optional<PitchedRoof> RoofOf(const House& house) {
  if (house.roof == RoofShape::kFlat) return std::nullopt;
  return MakePitchedRoof(house.outline, house.roof, house.slope, house.party);
}

std::vector<Loop> Holes(const Solid& solid, const Solid::Face& face) {
  std::vector<Loop> holes;
  for (const std::vector<int>& hole : face.holes) holes.push_back(Corners(solid, hole));
  return holes;
}

Facet FacetOf(const Solid& solid, const Solid::Face& face) {
  return ExactFacet(face.facet_class, Corners(solid, face.outer), Holes(solid, face));
}

// The roofs of a solid by falling area, as R0, R1 ...; the walls and the floor in their order.
std::vector<const Solid::Face*> RoofsBySize(const Solid& solid) {
  std::vector<const Solid::Face*> roofs;
  for (const Solid::Face& face : solid.faces) {
    if (face.facet_class == FacetClass::kRoof) roofs.push_back(&face);
  }
  std::stable_sort(roofs.begin(), roofs.end(), [&](const auto* a, const auto* b) {
    return FacetOf(solid, *a).area > FacetOf(solid, *b).area;
  });
  return roofs;
}

std::string FileNameOf(std::string id) {
  std::replace(id.begin(), id.end(), '/', '_');
  return id + ".jpg";
}

// A picture has whole texels, so that its sheet may reach over the right and lower edges.
void RoundUpToTexels(double metres_per_texel, Sheet& sheet) {
  sheet.width_m = Texels(sheet.width_m, metres_per_texel) * metres_per_texel;
  sheet.height_m = Texels(sheet.height_m, metres_per_texel) * metres_per_texel;
}

TexturedFacet TruthTexture(const std::string& id, const Sheet& sheet, double metres_per_texel) {
  TexturedFacet facet;
  facet.id = id;
  facet.image = "textures/" + FileNameOf(id);
  facet.width_px = Texels(sheet.width_m, metres_per_texel);
  facet.height_px = Texels(sheet.height_m, metres_per_texel);
  facet.metres_per_texel = metres_per_texel;
  facet.wanted_metres_per_texel = metres_per_texel;
  facet.origin = sheet.origin;
  facet.u_axis = sheet.u;
  facet.v_axis = sheet.v;
  facet.painted = 1;
  facet.gsd_m = metres_per_texel;
  return facet;
}

class HouseBuilder {
 public:
  HouseBuilder(const House& house, double metres_per_texel, CityModel& model, TextureSet& truth)
      : house_(house),
        solid_(SolidOf(house)),
        texel_(metres_per_texel),
        model_(model),
        truth_(truth) {
    WallDesign design;
    design.width_m = design.height_m = kTrim_m;
    design.cladding = house.cladding;
    design.palette = house.palette;
    design.seed = house.seed;
    trim_ = MakeTrim(design, "-trim");
    design.cladding = Cladding::kConcrete;
    roof_trim_ = MakeTrim(design, "-roof-trim");
  }

  void Build(const std::vector<std::string>& facades) {
    for (const Solid::Face& face : solid_.faces) {
      if (face.facet_class != FacetClass::kWall) continue;
      if (facades[face.edge].empty()) {
        AddPartyWall(face);
      } else {
        AddFacade(face, facades[face.edge]);
      }
    }
    const auto roofs = RoofsBySize(solid_);
    for (size_t i = 0; i < roofs.size(); ++i) AddRoof(*roofs[i], static_cast<int>(i));
    trim_.element = roof_trim_.element = AddElement(house_.id + "/trim", model_);
    AddRoofEdges(house_, solid_, roof_trim_, model_);
    const bool pitched = house_.roof != RoofShape::kFlat;
    AddRoofThings(house_, solid_, pitched ? trim_ : roof_trim_, model_);
  }

 private:
  Trim MakeTrim(const WallDesign& design, const char* name) {
    Trim trim;
    trim.size_m = kTrim_m;
    trim.material = AddPainted(house_.id + name,
                               {[design] { return PaintTrim(design, kTrimTexel_m); }, ""}, model_);
    return trim;
  }

  double ParapetOf() const { return house_.roof == RoofShape::kFlat ? house_.parapet_m : 0; }

  // The wall's outline with the parapet on top.
  Loop WallLoop(const Solid::Face& face) const {
    Loop loop = Corners(solid_, face.outer);
    for (size_t i = 2; i < loop.size(); ++i) loop[i].z() += ParapetOf();
    return loop;
  }

  // Blind; what rises above the neighbour is seen from afar only.
  void AddPartyWall(const Solid::Face& face) {
    const Loop loop = WallLoop(face);
    Sheet sheet;
    const WallPlace place = LaySheet(face, loop, sheet);
    const WallDesign design = DesignWall(house_, place);
    const double texel = kPartyTexels * texel_;
    const std::string id = fmt::format("{}/W{:02}", house_.id, face.edge);
    sheet.element = AddElement(id, model_);
    RoundUpToTexels(texel, sheet);
    sheet.material =
        AddPainted(id, {[design, texel] { return PaintWall(design, texel); }, ""}, model_);
    AddConvex(sheet, loop, model_);
  }

  // Puts the picture's top-left corner and axes onto a wall.
  WallPlace LaySheet(const Solid::Face& face, const Loop& loop, Sheet& sheet) const {
    double top = loop[0].z();
    for (const Vector3d& corner : loop) top = std::max(top, corner.z());
    sheet.u = (loop[1] - loop[0]).normalized();
    sheet.v = -Vector3d::UnitZ();
    sheet.origin = {loop[0].x(), loop[0].y(), top};
    WallPlace place;
    place.edge = face.edge;
    place.width_m = (loop[1] - loop[0]).norm();
    place.top_m = top;
    place.gable_rise_m = loop.size() == 5 ? top - loop[2].z() : 0;
    sheet.width_m = place.width_m;
    sheet.height_m = top - loop[0].z();
    return place;
  }

  void AddFacade(const Solid::Face& face, const std::string& id) {
    const Loop loop = WallLoop(face);
    WallShape shape;
    Sheet& sheet = shape.sheet;
    const WallPlace place = LaySheet(face, loop, sheet);
    for (const Vector3d& corner : loop) {
      shape.outline.emplace_back((corner - loop[0]).dot(sheet.u), place.top_m - corner.z());
    }
    const WallDesign design = DesignWall(house_, place);
    sheet.element = AddElement(id, model_);
    RoundUpToTexels(texel_, sheet);
    const double texel = texel_;
    sheet.material = AddPainted(
        id, {[design, texel] { return PaintWall(design, texel); }, FileNameOf(id)}, model_);
    // All of a curtain wall mirrors.
    if (design.cladding == Cladding::kGlass)
      model_.scene.materials[sheet.material].gloss = kPaneGloss;
    shape.pane_material = sheet.material;
    if (std::any_of(design.parts.begin(), design.parts.end(), HasPane)) {
      Material pane = model_.scene.materials[sheet.material];
      pane.name += "-pane";
      pane.gloss = kPaneGloss;
      shape.pane_material = AddMaterial(pane, model_);
    }
    trim_.element = sheet.element;
    shape.trim = trim_;
    shape.corner_left = TurnsAway(face.edge, /*at_end=*/false);
    shape.corner_right = TurnsAway(face.edge, /*at_end=*/true);
    AddWall(shape, design, model_);
    truth_.facets.push_back(TruthTexture(id, sheet, texel_));
  }

  // Whether the house has an outer corner at an end of an edge, with a free wall beyond it.
  bool TurnsAway(int edge, bool at_end) const {
    const std::vector<OutlineEdge> edges = EdgesOf(house_.outline);
    const int first = at_end ? edge : edges[edge].before;
    const int second = edges[first].after;
    const bool free = !house_.party[first] && !house_.party[second];
    return free && Cross(edges[first].along(), edges[second].along()) > 0;
  }

  void AddRoof(const Solid::Face& face, int number) {
    const std::string id = fmt::format("{}/R{}", house_.id, number);
    RoofSheet roof = LayRoofSheet(house_, solid_, face);
    Sheet& sheet = roof.sheet;
    const CoveringDesign design{.width_m = sheet.width_m,
                                .height_m = sheet.height_m,
                                .covering = house_.covering,
                                .palette = house_.palette,
                                .seed = Random(house_.seed, 10).Next(),
                                .face = number};
    sheet.element = AddElement(id, model_);
    RoundUpToTexels(texel_, sheet);
    const double texel = texel_;
    sheet.material = AddPainted(
        id, {[design, texel] { return PaintCovering(design, texel); }, FileNameOf(id)}, model_);
    AddPolygon(sheet, roof.drawn, Holes(solid_, face), model_);
    truth_.facets.push_back(TruthTexture(id, sheet, texel_));
  }

  const House& house_;
  const Solid solid_;
  const double texel_;
  CityModel& model_;
  TextureSet& truth_;
  Trim trim_;       // in the material of the walls
  Trim roof_trim_;  // edges of the roof and what stands on it
};

}  // namespace

Solid SolidOf(const House& house) {
  return MakeSolid(house.outline, house.base_m, house.eaves_m(), RoofOf(house));
}

Building TruthOf(const House& house, const Solid& solid, const std::vector<std::string>& facades) {
  Building building;
  building.id = house.id;
  building.watertight = !FindGap(solid);
  building.source = "model";
  const auto hide = [](Facet& facet) {
    facet.seen = 0;
    facet.inferred = 1;
  };
  for (const Solid::Face& face : solid.faces) {
    if (face.facet_class != FacetClass::kWall) continue;
    Facet facet = FacetOf(solid, face);
    const bool party = facades[face.edge].empty();
    facet.id = party ? fmt::format("{}/W{:02}", house.id, face.edge) : facades[face.edge];
    if (party) hide(facet);
    building.facets.push_back(std::move(facet));
  }
  int number = 0;
  for (const Solid::Face* face : RoofsBySize(solid)) {
    building.facets.push_back(FacetOf(solid, *face));
    building.facets.back().id = fmt::format("{}/R{}", house.id, number++);
  }
  building.facets.push_back(FacetOf(solid, solid.faces.back()));
  building.facets.back().id = house.id + "/G0";
  hide(building.facets.back());
  for (Facet& facet : building.facets) facet.facade = facet.id;
  return building;
}

void AddHouse(const House& house, const std::vector<std::string>& facades, double metres_per_texel,
              CityModel& model, TextureSet& truth) {
  HouseBuilder(house, metres_per_texel, model, truth).Build(facades);
}

}  // namespace stucco::simulate
