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
#include "pipeline/verbs/internal/stage_options.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/georef.h"
#include "survey/model_look.h"
#include "survey/options.h"
#include "survey/survey_folder.h"
#include "texture/options/texture_options.h"
#include "texture/output/tiles_3d.h"
#include "texture/output/write_glb.h"

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

// As many as may be encoded at once: half of the memory is for what else is held.
int ThreadsFor(std::span<const ModelLook> looks, int atlas_px, const ExportRequest& request,
               const RunSettings& run) {
  const double memory_gb =
      request.memory_limit_gb > 0 ? request.memory_limit_gb : run.memory_limit_gb;
  return EncodingThreads(looks, atlas_px, static_cast<uint64_t>(memory_gb * (1 << 30)) / 2,
                         request.threads > 0 ? request.threads : ResolvedThreads(run));
}

void ExportTiles(const fs::path& survey, const ExportRequest& request, const RunSettings& run) {
  const Proxy proxy = ReadProxy(survey / kFacetsFile);
  const ModelLook look = ReadLook(survey, request.epoch);
  std::error_code error;
  const Georef georef =
      fs::exists(survey / kGeorefFile, error) ? ReadGeoref(survey / kGeorefFile) : Georef();
  Tiles3dOptions options;
  options.threads = ThreadsFor({&look, 1}, 0, request, run);
  WriteTiles3d(proxy, look, georef, request.out, options);
}

// The stage's file, unless there are epochs to show beside it.
ExportReport ExportGlb(const fs::path& survey, const ExportRequest& request,
                       const StageTable& table) {
  std::error_code error;
  SurveyLooks looks;
  if (request.epoch.empty() && fs::exists(survey / kEpochsFolder, error)) looks = ReadLooks(survey);
  ExportReport report;
  report.notes = NotesOf(looks);
  if (looks.looks.size() <= 1) {
    CopyFile(LookFolder(survey, request.epoch) / "model.glb", request.out);
    return report;
  }
  const Settings settings = LoadSettings(survey, table, OptionsAsMade(survey, table, "texture"));
  const auto options = OptionsOf<TextureOptions>(settings, "texture");
  const std::string glb =
      GlbOfLooks(ReadProxy(survey / kFacetsFile), looks.looks,
                 {.max_px = options.glb_max_px,
                  .jpeg_quality = options.glb_quality,
                  .threads = ThreadsFor(looks.looks, options.glb_atlas_px, request, settings.run),
                  .most_texels = 1e6 * options.glb_megapixels,
                  .atlas_px = options.glb_atlas_px,
                  .relief = options.glb_relief});
  if (!request.out.parent_path().empty()) fs::create_directories(request.out.parent_path(), error);
  WriteFileAtomically(request.out, glb);
  return report;
}

}  // namespace

const std::vector<ExportFormat>& ExportFormats() {
  static const std::vector<ExportFormat> formats = {
      {"colmap-txt", "folder with cameras.txt, images.txt, points3D.txt", "calib"},
      {"colmap-bin", "folder with cameras.bin, images.bin, points3D.bin", "calib"},
      {"blocksexchange", "file: BlocksExchange XML 2.1 with poses, lenses and tie points", "calib"},
      {"nerfstudio", "folder with transforms.json and sparse_pc.ply", "calib"},
      {"obj", "folder with model.obj, its .mtl and its textures", "texture"},
      {"glb", "file: textured model as binary glTF, epochs as variants", "texture"},
      {"3dtiles", "folder with tileset.json: textured model as 3D Tiles 1.1, with levels of detail",
       "texture"},
      {"ply", "file: dense point cloud", "dense"},
      {"cityjson",
       "file: the planar model as CityJSON 2.0, once textured with its pictures in a folder beside "
       "it, epochs as themes; with --crs in that system",
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
  if (!request.epoch.empty() && chosen.stage != "texture" && chosen.name != "cityjson") {
    throw Error(ErrorKind::kUsage, fmt::format("--epoch: is no choice for {}", chosen.name),
                "leave it out, or take a textured model, such as --format glb");
  }
  if (chosen.stage == "calib") {
    prepare(kSparseFolder);
    ExportPoses(survey, chosen.name, request.out, LoadSettings(survey, table, {}).photos);
  } else if (chosen.name == "3dtiles") {
    prepare(kTexturesFile);
    ExportTiles(survey, request, LoadSettings(survey, table, {}).run);
  } else if (chosen.name == "obj") {
    prepare("texture/model.obj");
    CopyObj(LookFolder(survey, request.epoch), request.out);
  } else if (chosen.name == "cityjson") {
    prepare(kCityJsonFile);
    return ExportCity(survey, request);
  } else if (chosen.name == "glb") {
    prepare("texture/model.glb");
    return ExportGlb(survey, request, table);
  } else {
    prepare(kCloudFile);
    CopyFile(survey / kCloudFile, request.out);
  }
  return {};
}

}  // namespace stucco
