// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/internal/read_mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>

#include "survey/error.h"

namespace stucco {
namespace {

// At ten kilometres from the origin floats are a millimetre apart.
constexpr double kFarthest = 10000;

class MeshReader {
 public:
  MeshReader(const aiScene& scene, bool y_up) : scene_(scene), y_up_(y_up) {}

  SurfaceObject Read() {
    Append(*scene_.mRootNode, Eigen::Matrix4d::Identity());
    return std::move(object_);
  }

 private:
  void Append(const aiNode& node, const Eigen::Matrix4d& world_from_parent) {
    const aiMatrix4x4& m = node.mTransformation;
    Eigen::Matrix4d parent_from_node;
    parent_from_node << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4,
        m.d1, m.d2, m.d3, m.d4;
    const Eigen::Matrix4d world_from_node = world_from_parent * parent_from_node;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      Append(*scene_.mMeshes[node.mMeshes[i]], world_from_node);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) Append(*node.mChildren[i], world_from_node);
  }

  void Append(const aiMesh& mesh, const Eigen::Matrix4d& world_from_node) {
    const bool mirrored = world_from_node.topLeftCorner<3, 3>().determinant() < 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      auto& ring = object_.polygons.emplace_back().rings.emplace_back();
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D& p = mesh.mVertices[face.mIndices[k]];
        const Eigen::Vector4d place = world_from_node * Eigen::Vector4d(p.x, p.y, p.z, 1);
        ring.push_back(Upright(place.head<3>()));
      }
      if (mirrored) std::swap(ring[1], ring[2]);
    }
  }

  Eigen::Vector3d Upright(const Eigen::Vector3d& p) const {
    return y_up_ ? Eigen::Vector3d(p.x(), -p.z(), p.y()) : p;
  }

  const aiScene& scene_;
  bool y_up_;
  SurfaceObject object_;
};

void RequirePlaces(const SurfaceObject& object, const std::filesystem::path& path) {
  double farthest = 0;
  for (const SurfacePolygon& polygon : object.polygons) {
    for (const Eigen::Vector3d& corner : polygon.rings.front()) {
      if (!corner.allFinite()) {
        throw Error(ErrorKind::kBadInput, fmt::format("{}: a corner is not finite", path.string()),
                    "export the model again");
      }
      farthest = std::max(farthest, corner.cwiseAbs().maxCoeff());
    }
  }
  if (farthest <= kFarthest) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: reaches {:.0f} units from its origin, where coordinates of single "
                          "precision are not exact",
                          path.string(), farthest),
              "export it with an offset taken off, and say it: --offset X,Y,Z");
}

}  // namespace

SurfaceModel ReadMesh(const std::filesystem::path& path, bool y_up) {
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: cannot be read: {}", path.string(), importer.GetErrorString()),
                "export the model again, as GLB or OBJ");
  }
  SurfaceModel model;
  model.format = path.extension() == ".obj" || path.extension() == ".OBJ" ? "OBJ" : "glTF";
  model.is_mesh = true;
  model.objects.push_back(MeshReader(*scene, y_up).Read());
  RequirePlaces(model.objects.front(), path);
  return model;
}

}  // namespace stucco
