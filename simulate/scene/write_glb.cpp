// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "simulate/scene/internal/glb.h"
#include "simulate/scene/scene_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/parallel.h"

namespace stucco::simulate {
namespace internal {
namespace {

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 specification.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kRepeat = 10497;
constexpr int kLinear = 9729;
constexpr int kLinearMipmapLinear = 9987;
constexpr int kJpegQuality = 93;

static_assert(std::numeric_limits<float>::is_iec559 && sizeof(Eigen::Vector3f) == 12 &&
              sizeof(Eigen::Vector2f) == 8);

template <typename T>
void Append(const std::vector<T>& values, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

void PadTo4(char filler, std::string& bytes) {
  bytes.resize((bytes.size() + 3) / 4 * 4, filler);
}

Json MaterialOf(const Material& material) {
  Json pbr = {
      {"baseColorFactor", {material.colour.x(), material.colour.y(), material.colour.z(), 1.0f}},
      {"metallicFactor", 0},
      {"roughnessFactor", 1 - material.gloss}};
  if (material.texture >= 0) pbr["baseColorTexture"] = {{"index", material.texture}};
  Json json = {{"name", material.name}, {"pbrMetallicRoughness", pbr}, {"doubleSided", true}};
  if (material.cut_out) {
    json["alphaMode"] = "MASK";
    json["alphaCutoff"] = 0.5;
  }
  return json;
}

// The vertices of some triangles, and the triangles in terms of those.
struct Part {
  std::vector<Eigen::Vector3f> positions;  // y up
  std::vector<Eigen::Vector2f> uv;
  std::vector<uint32_t> indices;
};

Part PartOf(const Scene& scene, const std::vector<int>& triangles) {
  Part part;
  std::map<int, uint32_t> index_of;
  for (const int triangle : triangles) {
    for (const int vertex : scene.triangles[triangle]) {
      const auto [known, is_new] =
          index_of.emplace(vertex, static_cast<uint32_t>(part.positions.size()));
      if (is_new) {
        const Eigen::Vector3f& p = scene.positions[vertex];
        part.positions.emplace_back(p.x(), p.z(), -p.y());
        part.uv.push_back(scene.uv[vertex]);
      }
      part.indices.push_back(known->second);
    }
  }
  return part;
}

class GlbBuilder {
 public:
  explicit GlbBuilder(const Scene& scene) : scene_(scene) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "stucco"}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", Json::array()}}});
    for (const char* name : {"nodes", "meshes", "materials", "accessors", "bufferViews"}) {
      json_[name] = Json::array();
    }
  }

  std::string Build(const std::vector<EncodedImage>& textures) {
    for (const Material& material : scene_.materials) {
      json_["materials"].push_back(MaterialOf(material));
    }
    AddElements();
    AddTextures(textures);
    PadTo4(0, binary_);
    json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    return Assemble();
  }

 private:
  size_t AddView(size_t from, int target) {
    Json view = {{"buffer", 0}, {"byteOffset", from}, {"byteLength", binary_.size() - from}};
    if (target != 0) view["target"] = target;
    json_["bufferViews"].push_back(view);
    return json_["bufferViews"].size() - 1;
  }

  template <typename T>
  size_t AddAccessor(const std::vector<T>& values, int target, Json accessor) {
    const size_t from = binary_.size();
    Append(values, binary_);
    accessor["bufferView"] = AddView(from, target);
    accessor["count"] = values.size();
    json_["accessors"].push_back(accessor);
    return json_["accessors"].size() - 1;
  }

  Json PrimitiveOf(const Part& part, int material) {
    Eigen::Vector3f low = part.positions[0];
    Eigen::Vector3f high = low;
    for (const Eigen::Vector3f& p : part.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const size_t positions = AddAccessor(part.positions, kArrayBuffer,
                                         {{"componentType", kFloat},
                                          {"type", "VEC3"},
                                          {"min", {low.x(), low.y(), low.z()}},
                                          {"max", {high.x(), high.y(), high.z()}}});
    const size_t uv =
        AddAccessor(part.uv, kArrayBuffer, {{"componentType", kFloat}, {"type", "VEC2"}});
    const size_t indices = AddAccessor(part.indices, kElementArrayBuffer,
                                       {{"componentType", kUnsignedInt}, {"type", "SCALAR"}});
    return {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uv}}},
            {"indices", indices},
            {"material", material}};
  }

  void AddElements() {
    std::vector<std::map<int, std::vector<int>>> parts(scene_.elements.size());
    for (size_t i = 0; i < scene_.triangles.size(); ++i) {
      parts[scene_.elements_of[i]][scene_.materials_of[i]].push_back(static_cast<int>(i));
    }
    for (size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].empty()) continue;
      Json primitives = Json::array();
      for (const auto& [material, triangles] : parts[i]) {
        primitives.push_back(PrimitiveOf(PartOf(scene_, triangles), material));
      }
      json_["scenes"][0]["nodes"].push_back(json_["nodes"].size());
      json_["nodes"].push_back({{"name", scene_.elements[i]}, {"mesh", json_["meshes"].size()}});
      json_["meshes"].push_back({{"name", scene_.elements[i]}, {"primitives", primitives}});
    }
  }

  void AddTextures(const std::vector<EncodedImage>& textures) {
    if (textures.empty()) return;  // glTF has no empty lists
    json_["samplers"] = Json::array({{{"magFilter", kLinear},
                                      {"minFilter", kLinearMipmapLinear},
                                      {"wrapS", kRepeat},
                                      {"wrapT", kRepeat}}});
    json_["textures"] = Json::array();
    json_["images"] = Json::array();
    for (size_t i = 0; i < textures.size(); ++i) {
      const size_t from = binary_.size();
      binary_ += textures[i].bytes;
      const size_t view = AddView(from, 0);
      PadTo4(0, binary_);
      json_["images"].push_back({{"mimeType", textures[i].mime_type}, {"bufferView", view}});
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

  const Scene& scene_;
  Json json_;
  std::string binary_;
};

}  // namespace

EncodedImage EncodeForGlb(const Image& image) {
  const bool alpha = image.channels == 4;
  const cv::Mat pixels(image.height_px, image.width_px, CV_8UC(image.channels),
                       const_cast<uint8_t*>(image.data.data()));
  cv::Mat swapped = pixels;
  if (image.channels > 1) {
    cv::cvtColor(pixels, swapped, alpha ? cv::COLOR_RGBA2BGRA : cv::COLOR_RGB2BGR);
  }
  std::vector<uint8_t> bytes;
  const std::vector<int> quality = {cv::IMWRITE_JPEG_QUALITY, kJpegQuality};
  if (!cv::imencode(alpha ? ".png" : ".jpg", swapped, bytes,
                    alpha ? std::vector<int>{} : quality)) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("a picture of {} x {} pixels cannot be encoded", image.width_px,
                            image.height_px));
  }
  return {std::string(bytes.begin(), bytes.end()), alpha ? "image/png" : "image/jpeg"};
}

void WriteGlbFile(const Scene& scene, const std::vector<EncodedImage>& textures,
                  const std::filesystem::path& path) {
  WriteFileAtomically(path, GlbBuilder(scene).Build(textures));
}

}  // namespace internal

void WriteGlb(const Scene& scene, const std::filesystem::path& path) {
  std::vector<internal::EncodedImage> textures(scene.textures.size());
  ParallelFor(textures.size(), std::numeric_limits<int>::max(),
              [&](size_t i) { textures[i] = internal::EncodeForGlb(scene.textures[i]); });
  internal::WriteGlbFile(scene, textures, path);
}

}  // namespace stucco::simulate
