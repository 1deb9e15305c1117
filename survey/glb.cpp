// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <nlohmann/json.hpp>

#include "survey/error.h"

namespace stucco {
namespace {

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 specification.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kRepeat = 10497;
constexpr int kClampToEdge = 33071;
constexpr int kLinear = 9729;
constexpr int kLinearMipmapLinear = 9987;
constexpr char kUnlit[] = "KHR_materials_unlit";
constexpr char kVariants[] = "KHR_materials_variants";

static_assert(std::numeric_limits<float>::is_iec559 && sizeof(Eigen::Vector3f) == 12 &&
              sizeof(Eigen::Vector2f) == 8);

bool IsWithin(int index, size_t size) {
  return index >= 0 && static_cast<size_t>(index) < size;
}

bool IsSound(const GlbPrimitive& primitive, const GlbModel& model) {
  const size_t count = primitive.positions.size();
  return count > 0 && primitive.indices.size() % 3 == 0 &&
         (primitive.normals.empty() || primitive.normals.size() == count) &&
         (primitive.uv.empty() || primitive.uv.size() == count) &&
         IsWithin(primitive.material, model.materials.size()) &&
         std::ranges::all_of(primitive.mappings,
                             [&](const GlbMapping& mapping) {
                               return IsWithin(mapping.variant, model.variants.size()) &&
                                      IsWithin(mapping.material, model.materials.size());
                             }) &&
         std::ranges::all_of(primitive.indices, [&](uint32_t i) { return i < count; });
}

void PadTo4(char filler, std::string& bytes) {
  bytes.resize((bytes.size() + 3) / 4 * 4, filler);
}

Json JsonOf(const GlbMaterial& material) {
  Json pbr = {
      {"baseColorFactor", {material.colour.x(), material.colour.y(), material.colour.z(), 1.0f}},
      {"metallicFactor", 0},
      {"roughnessFactor", material.roughness}};
  if (material.texture >= 0) pbr["baseColorTexture"] = {{"index", material.texture}};
  Json json = {
      {"name", material.name}, {"pbrMetallicRoughness", pbr}, {"doubleSided", material.two_sided}};
  if (material.cut_out) {
    json["alphaMode"] = "MASK";
    json["alphaCutoff"] = 0.5;
  }
  if (material.unlit) json["extensions"] = {{kUnlit, Json::object()}};
  return json;
}

class GlbBuilder {
 public:
  explicit GlbBuilder(const GlbModel& model) : model_(model) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "stucco"}};
    const Eigen::Vector3d& offset = model.offset;
    if (!offset.isZero(0)) {
      json_["asset"]["extras"]["offset"] = {offset.x(), offset.y(), offset.z()};
    }
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", Json::array()}}});
    for (const char* name : {"nodes", "meshes", "materials", "accessors", "bufferViews"}) {
      json_[name] = Json::array();
    }
  }

  std::string Build() {
    for (const GlbMaterial& material : model_.materials) {
      json_["materials"].push_back(JsonOf(material));
    }
    if (std::ranges::any_of(model_.materials, &GlbMaterial::unlit)) {
      json_["extensionsUsed"].push_back(kUnlit);
    }
    AddVariants();
    for (const GlbMesh& mesh : model_.meshes) AddMesh(mesh);
    AddTextures();
    PadTo4(0, binary_);
    json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    return Assemble();
  }

 private:
  void AddVariants() {
    if (model_.variants.empty()) return;
    json_["extensionsUsed"].push_back(kVariants);
    Json& variants = json_["extensions"][kVariants]["variants"];
    for (const std::string& name : model_.variants) variants.push_back({{"name", name}});
  }

  size_t AddView(size_t from, int target) {
    Json view = {{"buffer", 0}, {"byteOffset", from}, {"byteLength", binary_.size() - from}};
    if (target != 0) view["target"] = target;
    json_["bufferViews"].push_back(view);
    return json_["bufferViews"].size() - 1;
  }

  template <typename T>
  size_t AddAccessor(const std::vector<T>& values, int target, Json accessor) {
    const size_t from = binary_.size();
    binary_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    accessor["bufferView"] = AddView(from, target);
    accessor["count"] = values.size();
    json_["accessors"].push_back(accessor);
    return json_["accessors"].size() - 1;
  }

  Json JsonOfPrimitive(const GlbPrimitive& primitive) {
    assert(IsSound(primitive, model_));
    Eigen::Vector3f low = primitive.positions[0];
    Eigen::Vector3f high = low;
    for (const Eigen::Vector3f& p : primitive.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    Json attributes;
    attributes["POSITION"] = AddAccessor(primitive.positions, kArrayBuffer,
                                         {{"componentType", kFloat},
                                          {"type", "VEC3"},
                                          {"min", {low.x(), low.y(), low.z()}},
                                          {"max", {high.x(), high.y(), high.z()}}});
    if (!primitive.normals.empty()) {
      attributes["NORMAL"] = AddAccessor(primitive.normals, kArrayBuffer,
                                         {{"componentType", kFloat}, {"type", "VEC3"}});
    }
    if (!primitive.uv.empty()) {
      attributes["TEXCOORD_0"] =
          AddAccessor(primitive.uv, kArrayBuffer, {{"componentType", kFloat}, {"type", "VEC2"}});
    }
    const size_t indices = AddAccessor(primitive.indices, kElementArrayBuffer,
                                       {{"componentType", kUnsignedInt}, {"type", "SCALAR"}});
    Json json = {
        {"attributes", attributes}, {"indices", indices}, {"material", primitive.material}};
    for (const GlbMapping& mapping : primitive.mappings) {
      json["extensions"][kVariants]["mappings"].push_back(
          {{"material", mapping.material}, {"variants", Json::array({mapping.variant})}});
    }
    return json;
  }

  void AddMesh(const GlbMesh& mesh) {
    Json primitives = Json::array();
    for (const GlbPrimitive& primitive : mesh.primitives) {
      primitives.push_back(JsonOfPrimitive(primitive));
    }
    json_["scenes"][0]["nodes"].push_back(json_["nodes"].size());
    json_["nodes"].push_back({{"name", mesh.name}, {"mesh", json_["meshes"].size()}});
    json_["meshes"].push_back({{"name", mesh.name}, {"primitives", primitives}});
  }

  void AddTextures() {
    if (model_.textures.empty()) return;  // glTF has no empty lists
    const int wrap = model_.repeat_textures ? kRepeat : kClampToEdge;
    json_["samplers"] = Json::array({{{"magFilter", kLinear},
                                      {"minFilter", kLinearMipmapLinear},
                                      {"wrapS", wrap},
                                      {"wrapT", wrap}}});
    json_["textures"] = Json::array();
    json_["images"] = Json::array();
    for (size_t i = 0; i < model_.textures.size(); ++i) {
      const size_t from = binary_.size();
      binary_ += model_.textures[i].bytes;
      const size_t view = AddView(from, 0);
      PadTo4(0, binary_);
      json_["images"].push_back({{"mimeType", model_.textures[i].mime_type}, {"bufferView", view}});
      json_["textures"].push_back({{"sampler", 0}, {"source", i}});
    }
  }

  // Header, then the chunks JSON and BIN, as the specification's section 4.4 has them.
  std::string Assemble() const {
    std::string text = json_.dump();
    PadTo4(' ', text);
    const size_t size = 12 + 8 + text.size() + 8 + binary_.size();
    if (size > std::numeric_limits<uint32_t>::max()) {
      throw Error(ErrorKind::kStageFailed, fmt::format("a GLB file cannot hold {} bytes", size),
                  "make the texels larger or the scene smaller");
    }
    const auto number = [](size_t value) {
      const auto word = static_cast<uint32_t>(value);
      return std::string(reinterpret_cast<const char*>(&word), sizeof(word));
    };
    std::string glb = "glTF" + number(2) + number(size);
    glb.reserve(size);
    glb += number(text.size()) + "JSON" + text;
    glb += number(binary_.size()) + std::string("BIN\0", 4);
    glb += binary_;
    return glb;
  }

  const GlbModel& model_;
  Json json_;
  std::string binary_;
};

}  // namespace

std::string GlbBytes(const GlbModel& model) {
  return GlbBuilder(model).Build();
}

}  // namespace stucco
