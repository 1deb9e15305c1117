// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <sstream>

#include "simulate/scene/scene_folder.h"
#include "survey/decode_image.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/parallel.h"

namespace stucco::simulate {
namespace {

// A town is between these, in metres; a model a thousand times as large or as small is in
// millimetres or kilometres.
constexpr double kSmallest_m = 1;
constexpr double kLargest_m = 10000;
// At ten kilometres from the origin floats are a millimetre apart.
constexpr double kFarthest_m = 10000;
constexpr char kExportAgain[] = "export the model again";

[[noreturn]] void Refuse(const std::filesystem::path& path, const std::string& why,
                         const std::string& remedy = {}) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), why), remedy);
}

// Where a material's picture comes from: a number of an embedded one, or a file.
struct PictureSource {
  const aiTexture* embedded = nullptr;
  std::filesystem::path file;
  std::string name;  // for messages
};

// Which of a mesh's sets of texture coordinates a material means, and how it moves them.
struct UvReading {
  int set = 0;
  Eigen::Affine2f transform = Eigen::Affine2f::Identity();
};

// Assimp's scene, being turned into ours.
struct Conversion {
  std::filesystem::path path;
  const aiScene* model = nullptr;
  bool y_up = true;
  double unit_m = 1;
  Scene scene;
  std::vector<PictureSource> pictures;  // as scene.textures
  std::vector<UvReading> uv_readings;   // of materials
  std::map<std::string, int> picture_of;
  std::map<std::string, int> element_of;
};

// glTF names files as URIs do: "brick%20wall.png".
std::string PercentDecoded(const std::string& name) {
  std::string decoded;
  for (size_t i = 0; i < name.size(); ++i) {
    unsigned code = 0;
    const char* digits = name.data() + i + 1;
    if (name[i] != '%' || i + 2 >= name.size() ||
        std::from_chars(digits, digits + 2, code, 16).ptr != digits + 2) {
      decoded += name[i];
      continue;
    }
    decoded += static_cast<char>(code);
    i += 2;
  }
  return decoded;
}

int PictureIndex(Conversion& conversion, const std::string& reference) {
  const auto [at, is_new] =
      conversion.picture_of.emplace(reference, static_cast<int>(conversion.pictures.size()));
  if (!is_new) return at->second;
  PictureSource source;
  source.embedded = conversion.model->GetEmbeddedTexture(reference.c_str());
  if (source.embedded) {
    source.name = fmt::format("{}: picture {}", conversion.path.string(), reference);
  } else {
    std::string relative = reference;
    std::replace(relative.begin(), relative.end(), '\\', '/');  // as Windows programs write
    source.file = conversion.path.parent_path() / relative;
    source.name = source.file.string();
    if (!std::filesystem::is_regular_file(source.file)) {
      source.file = conversion.path.parent_path() / PercentDecoded(relative);
    }
    if (!std::filesystem::is_regular_file(source.file)) {
      Refuse(conversion.path, fmt::format("its picture {} is missing", source.name),
             "put the pictures beside the model, as its materials name them");
    }
  }
  conversion.pictures.push_back(source);
  return at->second;
}

Material ConvertMaterial(Conversion& conversion, const aiMaterial& from) {
  Material material;
  material.name = from.GetName().C_Str();
  aiColor4D colour(1, 1, 1, 1);
  const bool is_gltf = from.Get(AI_MATKEY_BASE_COLOR, colour) == AI_SUCCESS;
  if (!is_gltf) from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  material.colour = {colour.r, colour.g, colour.b};
  aiString reference;
  if (from.GetTexture(AI_MATKEY_BASE_COLOR_TEXTURE, &reference) == AI_SUCCESS ||
      from.GetTexture(aiTextureType_DIFFUSE, 0, &reference) == AI_SUCCESS) {
    material.texture = PictureIndex(conversion, reference.C_Str());
    // Programs that write MTL leave Kd black or grey beside a picture, which stands for itself.
    if (!is_gltf) material.colour.setOnes();
  }
  aiString alpha_mode;
  if (from.Get("$mat.gltf.alphaMode", 0, 0, alpha_mode) == AI_SUCCESS) {
    material.cut_out = std::strcmp(alpha_mode.C_Str(), "OPAQUE") != 0;
  } else {  // OBJ: a picture with alpha, or one of its own
    aiString mask;
    material.cut_out = from.GetTexture(aiTextureType_OPACITY, 0, &mask) == AI_SUCCESS;
  }
  float roughness = 1;
  if (from.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == AI_SUCCESS) {
    material.gloss = std::clamp(1 - roughness, 0.0f, 1.0f);
  }
  return material;
}

// KHR_texture_transform; its rotation is counter-clockwise as one sees it, with v downwards.
Eigen::Affine2f UvTransformOf(const aiUVTransform& from) {
  // Assimp turns about the middle of a picture whose v points up, and its translation makes up for
  // that: back to glTF's, which turns about the top-left corner.
  const float turn = -from.mRotation;
  const Eigen::Vector2f scale(from.mScaling.x, from.mScaling.y);
  const float c = std::cos(turn);
  const float s = std::sin(turn);
  const Eigen::Vector2f offset(
      from.mTranslation.x - 0.5f * scale.x() * (1 - c + s),
      1 - scale.y() - from.mTranslation.y + 0.5f * scale.y() * (s + c - 1));
  return Eigen::Translation2f(offset) * Eigen::Rotation2Df(-turn) * Eigen::Scaling(scale);
}

UvReading UvReadingOf(const aiMaterial& material) {
  UvReading reading;
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    if (material.GetTextureCount(type) == 0) continue;
    material.Get(AI_MATKEY_UVWSRC(type, 0), reading.set);
    aiUVTransform transform;
    if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == AI_SUCCESS) {
      reading.transform = UvTransformOf(transform);
    }
    break;
  }
  return reading;
}

int ElementIndex(Conversion& conversion, const std::string& name) {
  const auto [at, is_new] =
      conversion.element_of.emplace(name, static_cast<int>(conversion.scene.elements.size()));
  if (is_new) conversion.scene.elements.push_back(name);
  return at->second;
}

Eigen::Vector3f ConvertPlace(const Conversion& conversion, const Eigen::Vector3d& from) {
  const Eigen::Vector3d in_metres = conversion.unit_m * from;
  // y up: x east, z south.
  const Eigen::Vector3d up =
      conversion.y_up ? Eigen::Vector3d(in_metres.x(), -in_metres.z(), in_metres.y()) : in_metres;
  return up.cast<float>();
}

void AppendMesh(Conversion& conversion, const aiMesh& mesh, const Eigen::Matrix4d& world_from_node,
                int element) {
  Scene& scene = conversion.scene;
  const auto first = static_cast<int>(scene.positions.size());
  const UvReading& reading = conversion.uv_readings[mesh.mMaterialIndex];
  const auto uv_set = static_cast<unsigned>(reading.set);
  const bool has_uv = uv_set < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh.HasTextureCoords(uv_set);
  const int texture = scene.materials[mesh.mMaterialIndex].texture;
  if (texture >= 0 && !has_uv && (mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0) {
    Refuse(conversion.path,
           fmt::format("its part {} has the picture {}, but no texture coordinates (UV)",
                       scene.elements[element], conversion.pictures[texture].name),
           "export the model with its texture coordinates");
  }
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    const Eigen::Vector4d place = world_from_node * Eigen::Vector4d(p.x, p.y, p.z, 1);
    scene.positions.push_back(ConvertPlace(conversion, place.head<3>()));
    // Assimp counts v upwards from the bottom of the picture.
    const aiVector3D uv = has_uv ? mesh.mTextureCoords[uv_set][i] : aiVector3D(0, 1, 0);
    scene.uv.push_back(reading.transform * Eigen::Vector2f(uv.x, 1 - uv.y));
  }
  // A mirrored node turns its triangles round.
  const bool mirrored = world_from_node.topLeftCorner<3, 3>().determinant() < 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    Eigen::Vector3i corners(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
    if (mirrored) std::swap(corners.y(), corners.z());
    scene.triangles.emplace_back(corners.array() + first);
    scene.materials_of.push_back(static_cast<int>(mesh.mMaterialIndex));
    scene.elements_of.push_back(element);
  }
}

void AppendNode(Conversion& conversion, const aiNode& node,
                const Eigen::Matrix4d& world_from_parent) {
  const aiMatrix4x4& m = node.mTransformation;
  Eigen::Matrix4d parent_from_node;
  parent_from_node << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1,
      m.d2, m.d3, m.d4;
  const Eigen::Matrix4d world_from_node = world_from_parent * parent_from_node;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *conversion.model->mMeshes[node.mMeshes[i]];
    std::string name = node.mName.C_Str();
    if (name.empty()) name = mesh.mName.C_Str();
    AppendMesh(conversion, mesh, world_from_node, ElementIndex(conversion, name));
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    AppendNode(conversion, *node.mChildren[i], world_from_node);
  }
}

void CheckPlaces(const Conversion& conversion) {
  const Scene& scene = conversion.scene;
  if (scene.triangles.empty()) {
    Refuse(conversion.path, "there are no triangles in it", kExportAgain);
  }
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Vector3f high = -low;
  for (size_t i = 0; i < scene.positions.size(); ++i) {
    if (!scene.positions[i].allFinite() || !scene.uv[i].allFinite()) {
      Refuse(conversion.path, fmt::format("vertex {} is not finite", i), kExportAgain);
    }
  }
  for (const Eigen::Vector3i& triangle : scene.triangles) {
    for (const int vertex : triangle) {
      low = low.cwiseMin(scene.positions[vertex]);
      high = high.cwiseMax(scene.positions[vertex]);
    }
  }
  const double size = (high - low).norm();
  if (!(size >= kSmallest_m) || size > kLargest_m) {
    Refuse(conversion.path,
           fmt::format("it is {:.6g} m across, where one unit is {:g} m", size, conversion.unit_m),
           size > kLargest_m ? "say what a unit is: --unit 0.001 for millimetres"
                             : "say what a unit is: --unit 1000 for kilometres");
  }
  const double farthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  if (farthest > kFarthest_m) {
    const Eigen::Vector3d middle = (low + high).cast<double>() / 2;
    Refuse(
        conversion.path,
        fmt::format("it lies {:.0f} m from its origin, where coordinates of single precision are "
                    "no longer exact",
                    farthest),
        fmt::format("move it to its origin before it is exported: take about ({:.0f}, {:.0f}, "
                    "{:.0f}) m off x (east), y (north) and z (up)",
                    middle.x(), middle.y(), middle.z()));
  }
}

Image DecodeEmbedded(const aiTexture& texture, const std::string& name) {
  if (texture.mHeight == 0) {  // as its file was
    return DecodeImage({reinterpret_cast<const char*>(texture.pcData), texture.mWidth}, name);
  }
  Image image{static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), 4, {}};
  image.data.reserve(size_t{4} * texture.mWidth * texture.mHeight);
  for (size_t i = 0; i < size_t{1} * texture.mWidth * texture.mHeight; ++i) {
    const aiTexel& texel = texture.pcData[i];
    image.data.insert(image.data.end(), {texel.r, texel.g, texel.b, texel.a});
  }
  return image;
}

Image ToColour(Image image) {
  if (image.channels != 1) return image;
  Image colour{image.width_px, image.height_px, 3, {}};
  colour.data.reserve(image.data.size() * 3);
  for (const uint8_t grey : image.data) colour.data.insert(colour.data.end(), 3, grey);
  return colour;
}

void ReadPictures(Conversion& conversion) {
  conversion.scene.textures.resize(conversion.pictures.size());
  ParallelFor(conversion.pictures.size(), std::numeric_limits<int>::max(), [&](size_t i) {
    const PictureSource& source = conversion.pictures[i];
    conversion.scene.textures[i] =
        ToColour(source.embedded ? DecodeEmbedded(*source.embedded, source.name)
                                 : DecodeImage(ReadFile(source.file), source.name));
  });
  for (Material& material : conversion.scene.materials) {
    const bool has_alpha =
        material.texture >= 0 && conversion.scene.textures[material.texture].channels == 4;
    material.cut_out = material.cut_out && has_alpha;
  }
}

// Assimp goes on without the materials that it does not find.
void RequireMaterials(const std::filesystem::path& model) {
  if (model.extension() != ".obj" && model.extension() != ".OBJ") return;
  std::istringstream lines(ReadFile(model));
  std::string line;
  while (std::getline(lines, line)) {
    if (!line.starts_with("mtllib ")) continue;
    const size_t end = line.find_last_not_of(" \t\r");
    const std::filesystem::path file = model.parent_path() / line.substr(7, end - 6);
    auto beside = model;  // which assimp tries as well
    if (std::filesystem::exists(file) ||
        std::filesystem::exists(beside.replace_extension(".mtl"))) {
      continue;
    }
    Refuse(model, fmt::format("its materials {} are missing", file.string()),
           "put them beside the model, or remove its mtllib line to fly it without textures");
  }
}

}  // namespace

std::filesystem::path ModelFile(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    Refuse(path, "no such scene",
           "give a scene folder (stucco simulate city) or a GLB or OBJ file");
  }
  if (!std::filesystem::is_directory(path)) return path;
  if (!std::filesystem::exists(path / kSceneModel)) {
    Refuse(path, fmt::format("no scene: there is no {} in it", kSceneModel),
           "make it again with stucco simulate city");
  }
  return path / kSceneModel;
}

Scene ReadScene(const std::filesystem::path& path, const ModelReading& reading) {
  Conversion conversion;
  conversion.path = ModelFile(path);
  if (!(reading.unit_m > 0) || !std::isfinite(reading.unit_m)) {
    throw Error(ErrorKind::kUsage, fmt::format("a unit of {:g} m makes no sense", reading.unit_m),
                "say how many metres one unit of the model has: --unit 0.001 for millimetres");
  }
  RequireMaterials(conversion.path);
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_COLORS |
                                                          aiComponent_TANGENTS_AND_BITANGENTS |
                                                          aiComponent_ANIMATIONS);
  conversion.model = importer.ReadFile(conversion.path.string(),
                                       aiProcess_Triangulate | aiProcess_RemoveComponent);
  if (!conversion.model || !conversion.model->mRootNode) {
    Refuse(conversion.path, fmt::format("cannot be read as a model: {}", importer.GetErrorString()),
           "models are read as GLB, glTF or OBJ; copy or export one again that was cut short");
  }
  conversion.y_up = reading.up != UpAxis::kZ;
  conversion.unit_m = reading.unit_m;
  for (unsigned i = 0; i < conversion.model->mNumMaterials; ++i) {
    conversion.scene.materials.push_back(
        ConvertMaterial(conversion, *conversion.model->mMaterials[i]));
    conversion.uv_readings.push_back(UvReadingOf(*conversion.model->mMaterials[i]));
  }
  AppendNode(conversion, *conversion.model->mRootNode, Eigen::Matrix4d::Identity());
  CheckPlaces(conversion);
  ReadPictures(conversion);
  return std::move(conversion.scene);
}

}  // namespace stucco::simulate
