// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/read_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "exchange/blocks_exchange.h"
#include "exchange/bundler.h"
#include "exchange/opensfm.h"
#include "exchange/realitycapture.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/georef.h"
#include "survey/text.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr char kWhatIsRead[] =
    "name a COLMAP folder (cameras, images, points3D), a bundle.out, a BlocksExchange XML, an "
    "OpenSfM reconstruction.json, a folder of RealityCapture XMP files, a PLY cloud, or a model of "
    "buildings (CityJSON, OBJ, GLB, glTF)";

constexpr char kUtf8Mark[] = "\xef\xbb\xbf";

// The beginning of a text file, without the mark of UTF-8 and blanks; empty where it cannot be read
// or is no text. Folders of photos are full of pictures, which the first byte tells.
std::string HeadOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const int first = file.peek();
  constexpr int kAscii = 0x80;
  if (first >= kAscii && first != static_cast<unsigned char>(kUtf8Mark[0])) return {};
  std::string head(1 << 16, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(file.gcount()));
  std::string_view text = head;
  if (text.starts_with(kUtf8Mark)) text.remove_prefix(3);
  return std::string(Trim(text));
}

bool Holds(std::string_view text, std::string_view word) {
  return text.find(word) != std::string_view::npos;
}

std::optional<ModelFormat> FormatOf(const fs::path& file) {
  const std::string head = HeadOf(file);
  if (head.starts_with("# Bundle file")) return ModelFormat::kBundler;
  // A zip archive may be anything; the extension tells it from a mission.
  if (head.starts_with("PK\x03\x04") && file.extension() == ".xmlz") {
    return ModelFormat::kBlocksExchange;
  }
  if (head.starts_with("<") && Holds(head, "<BlocksExchange")) return ModelFormat::kBlocksExchange;
  if (head.starts_with("[") && (Holds(head, "\"cameras\"") || Holds(head, "\"shots\"") ||
                                file.filename() == "reconstruction.json")) {
    return ModelFormat::kOpenSfm;
  }
  return std::nullopt;
}

// Files that are taken for a model and are none of these, and what to do.
void FailWhatIsKnown(const fs::path& file) {
  struct Known {
    std::string_view begins, holds;
    const char* what;
    const char* remedy;
  };
  const std::array<Known, 5> known = {
      {{"<", "<ATExport", "an ATExport, which is a report without tie points",
        "export the block as BlocksExchange XML"},
       {"<", "<chunk", "a camera file of Metashape",
        "export the cameras as BlocksExchange XML or as Bundler"},
       {"<", "capturingreality.com/ns/xcr", "an XMP file of one photo",
        "name the folder of the XMP files"},
       {"NVM_V3", "", "an NVM file of VisualSFM", "export the model as Bundler or COLMAP"},
       {"{", "\"transform_matrix\"", "a transforms.json of nerfstudio, which has no points",
        "import the model that it was made from"}}};
  const std::string head = HeadOf(file);
  for (const Known& each : known) {
    if (!head.starts_with(each.begins) || !Holds(head, each.holds)) continue;
    throw Error(ErrorKind::kBadInput, fmt::format("{}: is {}", file.string(), each.what),
                each.remedy);
  }
}

bool IsColmap(const fs::path& folder) {
  const std::array names = {"cameras.bin", "cameras.txt", "images.bin", "images.txt"};
  return std::ranges::any_of(names, [&](const char* name) {
    std::error_code error;
    return fs::exists(folder / name, error);
  });
}

// Models that lie in a folder, or where projects of OpenSfM and Bundler have them.
std::vector<RecognizedModel> ModelsIn(const fs::path& folder) {
  std::vector<RecognizedModel> models;
  if (IsColmap(folder)) models.push_back({ModelFormat::kColmap, folder});
  std::vector<fs::path> files = {folder / "bundle/bundle.out",
                                 folder / "opensfm/reconstruction.json"};
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    if (!fs::is_regular_file(file, error)) continue;
    if (const auto format = FormatOf(file)) models.push_back({*format, file});
  }
  if (models.empty() && !FindRealityCaptureFiles(folder).empty()) {
    models.push_back({ModelFormat::kRealityCapture, folder});
  }
  return models;
}

ExchangedModel ReadColmap(const fs::path& folder, const PhotoIndex& photos) {
  ExchangedModel result;
  result.format = "COLMAP";
  result.model = ReadColmapModel(folder);
  std::vector<std::string> names;
  for (const auto& [id, photo] : result.model.photos) names.push_back(photo.name);
  const std::vector<std::string> paths = photos.Require(names);
  auto path = paths.begin();
  for (auto& [id, photo] : result.model.photos) photo.name = *path++;
  // As our own export writes it.
  std::error_code error;
  if (fs::is_regular_file(folder / "georef.json", error)) {
    const Georef georef = ReadGeoref(folder / "georef.json");
    if (georef.frame == "enu") result.georef = georef;
  }
  return result;
}

ExchangedModel Read(const RecognizedModel& source, const PhotoIndex& photos) {
  switch (source.format) {
    case ModelFormat::kColmap:
      return ReadColmap(source.path, photos);
    case ModelFormat::kBundler:
      return ReadBundler(source.path, photos);
    case ModelFormat::kBlocksExchange:
      return ReadBlocksExchange(source.path, photos);
    case ModelFormat::kOpenSfm:
      return ReadOpenSfm(source.path, photos);
    case ModelFormat::kRealityCapture:
      return ReadRealityCapture(source.path, photos);
  }
  throw std::logic_error("unknown model format");
}

}  // namespace

RecognizedModel RecognizeModel(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: is not there", path.string()), kWhatIsRead);
  }
  if (!fs::is_directory(path, error)) {
    if (const auto format = FormatOf(path)) return {*format, path};
    FailWhatIsKnown(path);
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is no model of a format that is read", path.string()),
                kWhatIsRead);
  }
  const std::vector<RecognizedModel> models = ModelsIn(path);
  if (models.size() == 1) return models.front();
  if (models.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: holds no model of a format that is read", path.string()),
                kWhatIsRead);
  }
  std::vector<std::string> names;
  names.reserve(models.size());
  for (const RecognizedModel& model : models) names.push_back(model.path.string());
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: holds several models: {}", path.string(), fmt::join(names, ", ")),
              "name one of them");
}

ExchangedModel ReadModel(const RecognizedModel& source, const PhotoIndex& photos) {
  ExchangedModel result = Read(source, photos);
  if (const auto problem = FindProblem(result.model)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", source.path.string(), *problem),
                "export the model again");
  }
  return result;
}

}  // namespace stucco
