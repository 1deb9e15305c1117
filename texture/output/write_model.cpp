// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/write_model.h"

#include <assimp/material.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Exporter.hpp>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "survey/error.h"
#include "survey/facet_picture.h"
#include "survey/files.h"
#include "survey/triangulate.h"
#include "texture/output/glb_parts.h"

namespace stucco {
namespace {

constexpr double kFar_m = 10000;        // floats are still good to a millimetre
constexpr double kOffsetStep_m = 1000;  // offsets are whole multiples: people copy them

// How pictures get into a model: the texture path of a facet's material.
using TexturePath = std::map<std::string, std::string>;

aiMaterial* MakeMaterial(const std::string& name, const std::string* texture) {
  auto* material = new aiMaterial();  // owned by the scene, as everything assimp takes
  const aiString title(name);
  material->AddProperty(&title, AI_MATKEY_NAME);
  const float shade = texture ? 1.0f : kUnpaintedGrey;
  const aiColor4D color(shade, shade, shade, 1);
  material->AddProperty(&color, 1, AI_MATKEY_COLOR_DIFFUSE);
  const aiShadingMode shading = aiShadingMode_Unlit;
  material->AddProperty(&shading, 1, AI_MATKEY_SHADING_MODEL);
  if (texture) {
    const aiString path(*texture);
    material->AddProperty(&path, AI_MATKEY_TEXTURE_DIFFUSE(0));
    const int clamp = aiTextureMapMode_Clamp;
    material->AddProperty(&clamp, 1, AI_MATKEY_MAPPINGMODE_U(aiTextureType_DIFFUSE, 0));
    material->AddProperty(&clamp, 1, AI_MATKEY_MAPPINGMODE_V(aiTextureType_DIFFUSE, 0));
  }
  return material;
}

aiVector3D ToVector(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// Assimp's texture coordinates have their origin at the lower left.
aiVector3D TextureCoordinates(const TexturedFacet& texture, const Eigen::Vector3d& vertex) {
  const Eigen::Vector2d at = OnPicture(texture, vertex);
  return {static_cast<float>(at.x()), static_cast<float>(1 - at.y()), 0};
}

aiMesh* MakeMesh(const Facet& facet, const TexturedFacet* texture,
                 const Eigen::Isometry3d& model_from_world, unsigned material) {
  const FacetTriangles shape = TriangulateFacet(facet);
  if (shape.triangles.empty()) return nullptr;
  auto* mesh = new aiMesh();
  mesh->mName = aiString(facet.id);
  mesh->mMaterialIndex = material;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = static_cast<unsigned>(shape.vertices.size());
  mesh->mVertices = new aiVector3D[shape.vertices.size()];
  mesh->mNormals = new aiVector3D[shape.vertices.size()];
  if (texture) {
    mesh->mTextureCoords[0] = new aiVector3D[shape.vertices.size()];
    mesh->mNumUVComponents[0] = 2;
  }
  for (size_t i = 0; i < shape.vertices.size(); ++i) {
    mesh->mVertices[i] = ToVector(model_from_world * shape.vertices[i]);
    mesh->mNormals[i] = ToVector(model_from_world.linear() * facet.normal);
    if (texture) mesh->mTextureCoords[0][i] = TextureCoordinates(*texture, shape.vertices[i]);
  }
  mesh->mNumFaces = static_cast<unsigned>(shape.triangles.size());
  mesh->mFaces = new aiFace[shape.triangles.size()];
  for (size_t i = 0; i < shape.triangles.size(); ++i) {
    mesh->mFaces[i].mNumIndices = 3;
    mesh->mFaces[i].mIndices = new unsigned[3];
    for (int k = 0; k < 3; ++k) mesh->mFaces[i].mIndices[k] = shape.triangles[i][k];
  }
  return mesh;
}

template <typename T>
T** MoveIntoArray(const std::vector<T*>& items) {
  auto** array = new T*[items.size()];
  std::copy(items.begin(), items.end(), array);
  return array;
}

// One node per facet below the root, so that viewers list facets by their id.
aiNode* MakeNodes(const std::vector<aiMesh*>& meshes) {
  auto* root = new aiNode("stucco");
  root->mNumChildren = static_cast<unsigned>(meshes.size());
  root->mChildren = new aiNode*[meshes.size()];
  for (unsigned i = 0; i < meshes.size(); ++i) {
    auto* node = new aiNode(meshes[i]->mName.C_Str());
    node->mParent = root;
    node->mNumMeshes = 1;
    node->mMeshes = new unsigned[1]{i};
    root->mChildren[i] = node;
  }
  return root;
}

std::unique_ptr<aiScene> MakeScene(const Proxy& proxy, const TextureSet& textures,
                                   const TexturePath& paths,
                                   const Eigen::Isometry3d& model_from_world) {
  std::map<std::string, const TexturedFacet*> by_id;
  for (const TexturedFacet& facet : textures.facets) by_id[facet.id] = &facet;
  std::vector<aiMaterial*> materials = {MakeMaterial("untextured", nullptr)};
  std::vector<aiMesh*> meshes;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      const auto path = paths.find(facet.id);
      const bool painted = path != paths.end();
      const auto material = painted ? static_cast<unsigned>(materials.size()) : 0u;
      aiMesh* mesh =
          MakeMesh(facet, painted ? by_id.at(facet.id) : nullptr, model_from_world, material);
      if (!mesh) continue;
      meshes.push_back(mesh);
      if (painted) materials.push_back(MakeMaterial(facet.id, &path->second));
    }
  }
  auto scene = std::make_unique<aiScene>();
  scene->mNumMaterials = static_cast<unsigned>(materials.size());
  scene->mMaterials = MoveIntoArray(materials);
  scene->mNumMeshes = static_cast<unsigned>(meshes.size());
  scene->mMeshes = MoveIntoArray(meshes);
  scene->mRootNode = MakeNodes(meshes);
  return scene;
}

void Export(const aiScene& scene, const char* format, const std::filesystem::path& path) {
  Assimp::Exporter exporter;
  if (exporter.Export(&scene, format, path.string()) != aiReturn_SUCCESS) {
    throw Error(ErrorKind::kOutOfResource,
                fmt::format("{}: cannot be written: {}", path.string(), exporter.GetErrorString()),
                "check free space and permissions of the survey folder");
  }
}

Eigen::Isometry3d WithoutOffset(const TextureSet& textures) {
  return Eigen::Isometry3d(Eigen::Translation3d(-textures.model_offset));
}

}  // namespace

Eigen::Vector3d ModelOffset(const Proxy& proxy) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector3d high = -low;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      for (const Eigen::Vector3d& vertex : facet.outer) {
        low = low.cwiseMin(vertex);
        high = high.cwiseMax(vertex);
      }
    }
  }
  const Eigen::Vector3d center = (low + high) / 2;
  if (!(high.x() >= low.x()) || !(center.norm() > kFar_m)) return Eigen::Vector3d::Zero();
  return kOffsetStep_m * (center / kOffsetStep_m).array().round().matrix();
}

void WriteObj(const Proxy& proxy, const TextureSet& textures, const std::filesystem::path& folder) {
  TexturePath paths;
  for (const TexturedFacet& facet : textures.facets) {
    if (!facet.image.empty()) paths[facet.id] = facet.image;
  }
  const auto scene = MakeScene(proxy, textures, paths, WithoutOffset(textures));
  Export(*scene, "obj", folder / "model.obj");
  if (textures.model_offset.isZero(0)) return;
  const Eigen::Vector3d& offset = textures.model_offset;
  WriteFile(folder / "model.obj", fmt::format("# add {} {} {} for world coordinates\n", offset.x(),
                                              offset.y(), offset.z()) +
                                      ReadFile(folder / "model.obj"));
}

}  // namespace stucco
