// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/imported/sort_pieces.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "proxy/facets/facet_letter.h"
#include "survey/disjoint_sets.h"
#include "survey/median.h"

namespace stucco {
namespace {

using Eigen::Vector3d;

const double kSteep = std::cos(45 * std::numbers::pi / 180);
constexpr double kLowest_m = 0.5;  // undersides so near to a building's lowest corner are its floor
constexpr double kOnPlane = 5e-7;  // what Facet allows, and some to spare
constexpr size_t kLongestId = 64;
constexpr char kGroundId[] = "G0";

bool IsIdText(const std::string& text) {
  return !text.empty() && text.size() <= kLongestId &&
         std::ranges::all_of(text, [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-';
         });
}

// Whether each edge is there once and once the other way.
bool IsClosed(const std::vector<FlatPiece>& pieces, const std::vector<int>& members) {
  std::set<std::pair<int, int>> edges;
  for (const int member : members) {
    for (const std::vector<int>& ring : pieces[member].rings) {
      for (size_t i = 0; i < ring.size(); ++i) {
        if (!edges.emplace(ring[i], ring[(i + 1) % ring.size()]).second) return false;
      }
    }
  }
  return std::ranges::all_of(edges, [&](const auto& edge) {
    return edges.contains({edge.second, edge.first});
  });
}

double VolumeOf(const WeldedModel& welded, const std::vector<FlatPiece>& pieces,
                const std::vector<int>& members) {
  const Vector3d& origin = welded.corners[pieces[members.front()].rings.front().front()];
  double volume = 0;
  for (const int member : members) {
    const FlatPiece& piece = pieces[member];
    volume += (piece.offset - piece.normal.dot(origin)) * piece.area / 3;
  }
  return volume;
}

// The pieces that hang together by edges, whichever way these run.
DisjointSets JoinedByEdges(const PieceEdges& edges, size_t pieces,
                           const std::function<bool(int, int)>& may_join) {
  DisjointSets sets(pieces);
  for (const auto& [edge, users] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    for (const int user : users) {
      if (may_join(users.front(), user)) sets.Join(users.front(), user);
    }
    if (back == edges.end()) continue;
    for (const int other : back->second) {
      if (may_join(users.front(), other)) sets.Join(users.front(), other);
    }
  }
  return sets;
}

// Turns closed bodies that face inwards.
void FaceOutwards(const WeldedModel& welded, std::vector<FlatPiece>& pieces) {
  DisjointSets sets =
      JoinedByEdges(EdgesOf(pieces), pieces.size(), [](int /*a*/, int /*b*/) { return true; });
  std::map<int, std::vector<int>> bodies;
  for (size_t i = 0; i < pieces.size(); ++i) {
    bodies[sets.Find(static_cast<int>(i))].push_back(static_cast<int>(i));
  }
  for (const auto& [first, members] : bodies) {
    if (!IsClosed(pieces, members) || VolumeOf(welded, pieces, members) >= 0) continue;
    for (const int member : members) {
      FlatPiece& piece = pieces[member];
      piece.normal = -piece.normal;
      piece.offset = -piece.offset;
      for (std::vector<int>& ring : piece.rings) std::ranges::reverse(ring);
    }
  }
}

class PieceSorter {
 public:
  PieceSorter(const SurfaceModel& model, const WeldedModel& welded, std::vector<FlatPiece> pieces,
              const std::function<bool(const Facet&)>& behind)
      : model_(model),
        welded_(welded),
        pieces_(std::move(pieces)),
        behind_(behind),
        edges_(EdgesOf(pieces_)) {
    for (size_t i = 0; i < pieces_.size(); ++i) classes_.push_back(ClassByNormal(pieces_[i]));
  }

  std::vector<Building> Sort() {
    TellGround();
    std::map<int, std::vector<int>> members;  // by the first piece of a building; -1: the ground
    DisjointSets sets = JoinedToBuildings();
    for (size_t i = 0; i < pieces_.size(); ++i) {
      members[IsOfGround(i) ? -1 : sets.Find(static_cast<int>(i))].push_back(static_cast<int>(i));
    }
    std::vector<Building> buildings;
    for (const auto& [first, pieces] : members) {
      if (first >= 0) buildings.push_back(MakeBuilding(NameOf(pieces_[first]), pieces));
    }
    if (members.contains(-1)) buildings.push_back(MakeBuilding(kGroundId, members[-1]));
    return buildings;
  }

 private:
  static FacetClass ClassByNormal(const FlatPiece& piece) {
    if (piece.facet_class) return *piece.facet_class;
    if (std::abs(piece.normal.z()) < kSteep) return FacetClass::kWall;
    return piece.normal.z() > 0 ? FacetClass::kRoof : FacetClass::kOuterFloor;
  }

  const Vector3d& Corner(int index) const { return welded_.corners[index]; }

  double HeightOf(const FlatPiece& piece) const {
    double sum = 0;
    for (const int corner : piece.rings.front()) sum += Corner(corner).z();
    return sum / static_cast<double>(piece.rings.front().size());
  }

  // Walls stand on the ground and hang from roofs; what touches none is ground when it is lower
  // than half of the walls.
  void TellGround() {
    std::vector<double> heights;
    for (size_t i = 0; i < pieces_.size(); ++i) {
      if (classes_[i] == FacetClass::kWall) heights.push_back(HeightOf(pieces_[i]));
    }
    const std::optional<double> middle = Median(heights);
    if (!middle) return;
    for (size_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].facet_class || classes_[i] != FacetClass::kRoof) continue;
      const std::optional<double> above = WallsAbove(pieces_[i]);
      if (above ? *above > 0 : HeightOf(pieces_[i]) < *middle) classes_[i] = FacetClass::kGround;
    }
  }

  // Length of its edges that walls stand on, less that of those that walls hang from; nothing where
  // there are neither.
  std::optional<double> WallsAbove(const FlatPiece& piece) const {
    double above = 0;
    bool any = false;
    for (const std::vector<int>& ring : piece.rings) {
      for (size_t i = 0; i < ring.size(); ++i) {
        const int a = ring[i];
        const int b = ring[(i + 1) % ring.size()];
        const auto beyond = edges_.find({b, a});
        if (beyond == edges_.end()) continue;
        for (const int other : beyond->second) {
          if (classes_[other] != FacetClass::kWall) continue;
          any = true;
          const bool stands = HeightOf(pieces_[other]) > (Corner(a).z() + Corner(b).z()) / 2;
          above += (stands ? 1 : -1) * (Corner(a) - Corner(b)).norm();
        }
      }
    }
    return any ? std::optional(above) : std::nullopt;
  }

  // Floors of buildings are ground, too, but theirs.
  bool IsOfGround(size_t piece) const {
    if (!model_.is_mesh) return model_.objects[pieces_[piece].object].is_ground;
    return classes_[piece] == FacetClass::kGround;
  }

  DisjointSets JoinedToBuildings() const {
    if (model_.is_mesh) {
      return JoinedByEdges(edges_, pieces_.size(),
                           [&](int a, int b) { return !IsOfGround(a) && !IsOfGround(b); });
    }
    DisjointSets sets(pieces_.size());
    std::map<int, int> first_of;  // by object
    for (size_t i = 0; i < pieces_.size(); ++i) {
      const auto at = first_of.emplace(pieces_[i].object, static_cast<int>(i)).first;
      sets.Join(at->second, static_cast<int>(i));
    }
    return sets;
  }

  std::string NameOf(const FlatPiece& piece) {
    const std::string& id = model_.objects[piece.object].id;
    if (IsIdText(id) && id != kGroundId && buildings_.insert(id).second) return id;
    std::string name;
    do name = fmt::format("M{:04}", ++numbered_);
    while (!buildings_.insert(name).second);
    return name;
  }

  Building MakeBuilding(const std::string& id, const std::vector<int>& pieces) {
    Building building;
    building.id = id;
    building.source = "file";
    const bool closed = id != kGroundId && IsClosed(pieces_, pieces);
    double deviation = 0;
    double lowest = std::numeric_limits<double>::infinity();
    for (const int piece : pieces) {
      for (const int corner : pieces_[piece].rings.front()) {
        lowest = std::min(lowest, Corner(corner).z());
      }
    }
    for (const int piece : pieces) {
      Facet facet = MakeFacet(pieces_[piece], classes_[piece]);
      if (!closed && behind_(facet)) Turn(pieces_[piece], facet);
      const bool is_floor = !pieces_[piece].facet_class && id != kGroundId &&
                            facet.facet_class == FacetClass::kOuterFloor &&
                            HeightOf(pieces_[piece]) < lowest + kLowest_m;
      if (is_floor) facet.facet_class = FacetClass::kGround;
      deviation = std::max(deviation, pieces_[piece].deviation);
      facet.id = pieces_[piece].id;
      building.facets.push_back(std::move(facet));
    }
    building.watertight = closed && deviation <= kOnPlane;
    NameFacets(building);
    return building;
  }

  Facet MakeFacet(const FlatPiece& piece, FacetClass facet_class) const {
    Facet facet;
    facet.facet_class = facet_class;
    facet.normal = piece.normal;
    facet.offset = piece.offset;
    facet.area = piece.area;
    facet.source = "file";
    facet.inferred = 1;
    for (size_t k = 0; k < piece.rings.size(); ++k) {
      auto& ring = k == 0 ? facet.outer : facet.holes.emplace_back();
      for (const int corner : piece.rings[k]) {
        const Vector3d& p = Corner(corner);  // to the last bit, where facets meet
        const double off = piece.normal.dot(p) - piece.offset;
        ring.emplace_back(std::abs(off) <= kOnPlane ? p : p - off * piece.normal);
      }
    }
    return facet;
  }

  // Roofs and undersides that the file does not tell apart change places.
  static void Turn(const FlatPiece& piece, Facet& facet) {
    facet.normal = -facet.normal;
    facet.offset = -facet.offset;
    std::ranges::reverse(facet.outer);
    for (auto& hole : facet.holes) std::ranges::reverse(hole);
    if (piece.facet_class || facet.facet_class == FacetClass::kWall) return;
    facet.facet_class = facet.normal.z() > 0 ? FacetClass::kRoof : FacetClass::kOuterFloor;
  }

  // The file's ids where they are of the building and there once, else by class and number.
  static void NameFacets(Building& building) {
    std::map<std::string, int> uses;
    for (const Facet& facet : building.facets) ++uses[facet.id];
    const std::string beginning = building.id + "/";
    std::set<std::string> taken;
    for (Facet& facet : building.facets) {
      const bool good = facet.id.starts_with(beginning) && uses[facet.id] == 1 &&
                        IsIdText(facet.id.substr(beginning.size()));
      if (good) {
        taken.insert(facet.id);
      } else {
        facet.id.clear();
      }
    }
    std::map<char, int> numbers;
    for (Facet& facet : building.facets) {
      const char letter = LetterOf(facet.facet_class);
      while (facet.id.empty()) {
        const int number = numbers[letter]++;
        std::string id = letter == 'W' ? fmt::format("{}W{:02}", beginning, number)
                                       : fmt::format("{}{}{}", beginning, letter, number);
        if (taken.insert(id).second) facet.id = std::move(id);
      }
    }
  }

  const SurfaceModel& model_;
  const WeldedModel& welded_;
  std::vector<FlatPiece> pieces_;
  const std::function<bool(const Facet&)>& behind_;
  PieceEdges edges_;
  std::vector<FacetClass> classes_;
  std::set<std::string> buildings_;
  int numbered_ = 0;
};

}  // namespace

std::vector<Building> SortPieces(const SurfaceModel& model, const WeldedModel& welded,
                                 std::vector<FlatPiece> pieces,
                                 const std::function<bool(const Facet&)>& behind) {
  FaceOutwards(welded, pieces);
  return PieceSorter(model, welded, std::move(pieces), behind).Sort();
}

}  // namespace stucco
