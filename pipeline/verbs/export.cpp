// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/export.h"

#include <fmt/format.h>

#include <algorithm>

#include "exchange/blocks_exchange.h"
#include "exchange/nerfstudio.h"
#include "pipeline/engine/settings.h"
#include "pipeline/engine/shell.h"
#include "pipeline/verbs/internal/export_city.h"
#include "pipeline/verbs/internal/export_files.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/georef.h"
#include "survey/options.h"
#include "survey/survey_folder.h"
#include "survey/texture_set.h"
#include "texture/output/tiles_3d.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

const ExportFormat& Format(const std::string& name) {
  const std::vector<ExportFormat>& formats = ExportFormats();
  const auto nearest = std::min_element(
      formats.begin(), formats.end(), [&](const ExportFormat& a, const ExportFormat& b) {
        return EditDistance(a.name, name) < EditDistance(b.name, name);
      });
  if (nearest->name == name) {
    return *nearest;
  }
  std::string names;
  for (const ExportFormat& format : formats) {
    names += (names.empty() ? "" : ", ") + format.name;
  }
  throw Error(ErrorKind::kUsage, fmt::format("there is no export format \"{}\"", name),
              EditDistance(nearest->name, name) <= 2
                  ? fmt::format("did you mean {}?", nearest->name)
                  : fmt::format("the formats are {}", names));
}

void RequireMade(const fs::path& survey, const fs::path& file, const std::string& stage) {
  std::error_code error;
  if (!fs::exists(survey / file, error)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is not there: {} has not run", (survey / file).string(), stage),
                fmt::format("run it first: stucco {} {}", stage, ShellWord(survey.string())));
  }
}

// model.obj names model.mtl, and that names pictures below textures/.
void CopyObj(const fs::path& texture, const fs::path& out) {
  CopyFile(texture / "model.obj", out / "model.obj");
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(texture)) {
    const fs::path relative = entry.path().lexically_relative(texture);
    if (entry.is_regular_file() &&
        (relative.extension() == ".mtl" || *relative.begin() == "textures")) {
      CopyFile(entry.path(), out / relative);
    }
  }
}

// The frame is no part of COLMAP's format, nor of nerfstudio's.
void ExportPoses(const fs::path& survey, const std::string& format, const fs::path& out,
                 const fs::path& photos) {
  const Reconstruction model = ReadColmapModel(survey / kSparseFolder);
  std::error_code error;
  const Georef georef =
      fs::exists(survey / kGeorefFile, error) ? ReadGeoref(survey / kGeorefFile) : Georef();
  const ModelToWrite what{model, georef, photos};
  if (format == "blocksexchange") {
    if (!out.parent_path().empty()) fs::create_directories(out.parent_path(), error);
    WriteBlocksExchange(what, out);
    return;
  }
  if (format == "nerfstudio") {
    WriteNerfstudio(what, out);
  } else {
    format == "colmap-txt" ? WriteColmapText(model, out) : WriteColmapBinary(model, out);
  }
  WriteGeoref(georef, out / "georef.json");
}

void ExportTiles(const fs::path& survey, const fs::path& out, int threads) {
  const Proxy proxy = ReadProxy(survey / kFacetsFile);
  const TextureSet textures = ReadTextureSet(survey / kTexturesFile);
  std::error_code error;
  const Georef georef =
      fs::exists(survey / kGeorefFile, error) ? ReadGeoref(survey / kGeorefFile) : Georef();
  Tiles3dOptions options;
  options.threads = threads;
  WriteTiles3d({proxy, textures, survey / "texture"}, georef, out, options);
}

}  // namespace

const std::vector<ExportFormat>& ExportFormats() {
  static const std::vector<ExportFormat> formats = {
      {"colmap-txt", "folder with cameras.txt, images.txt, points3D.txt", "calib"},
      {"colmap-bin", "folder with cameras.bin, images.bin, points3D.bin", "calib"},
      {"blocksexchange", "file: BlocksExchange XML 2.1 with poses, lenses and tie points", "calib"},
      {"nerfstudio", "folder with transforms.json and sparse_pc.ply", "calib"},
      {"obj", "folder with model.obj, its .mtl and its textures", "texture"},
      {"glb", "file: textured model as binary glTF", "texture"},
      {"3dtiles", "folder with tileset.json: textured model as 3D Tiles 1.1, with levels of detail",
       "texture"},
      {"ply", "file: dense point cloud", "dense"},
      {"cityjson",
       "file: the planar model as CityJSON 2.0, once textured with its pictures in a folder beside "
       "it; with --crs in that system",
       "proxy"}};
  return formats;
}

ExportReport ExportSurvey(const fs::path& survey, const ExportRequest& request,
                          const StageTable& table) {
  const ExportFormat& chosen = Format(request.format);
  const auto prepare = [&](const fs::path& made) {
    RequireMade(survey, made, chosen.stage);
    RequireFree(request.out, request.overwrite);
  };
  if (!request.crs.empty() && chosen.name != "cityjson") {
    throw Error(ErrorKind::kUsage, fmt::format("--crs: is no choice for {}", chosen.name),
                "leave it out, or take --format cityjson");
  }
  if (chosen.stage == "calib") {
    prepare(kSparseFolder);
    ExportPoses(survey, chosen.name, request.out, LoadSettings(survey, table, {}).photos);
  } else if (chosen.name == "3dtiles") {
    prepare(kTexturesFile);
    ExportTiles(survey, request.out, ResolvedThreads(LoadSettings(survey, table, {}).run));
  } else if (chosen.name == "obj") {
    prepare("texture/model.obj");
    CopyObj(survey / "texture", request.out);
  } else if (chosen.name == "cityjson") {
    prepare(kCityJsonFile);
    return ExportCity(survey, request);
  } else {
    const fs::path file =
        chosen.name == "glb" ? fs::path("texture/model.glb") : fs::path(kCloudFile);
    prepare(file);
    CopyFile(survey / file, request.out);
  }
  return {};
}

}  // namespace stucco
