// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/internal/export_city.h"

#include <fmt/format.h>

#include <cassert>
#include <string>
#include <system_error>

#include "pipeline/engine/shell.h"
#include "pipeline/verbs/internal/city_in_crs.h"
#include "pipeline/verbs/internal/export_files.h"
#include "proxy/output/cityjson.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/georef.h"
#include "survey/model_look.h"
#include "survey/proxy.h"
#include "survey/survey_folder.h"
#include "survey/utf8.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// "castle_appearance" for castle.city.json: two exports into one folder keep their pictures apart.
std::string PicturesFolderOf(const fs::path& out) {
  fs::path name = out.filename();
  if (!IsPrintableUtf8(name.string())) {
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: its name is not valid UTF-8 or has control characters, so that it "
                            "cannot name the folder of its pictures",
                            out.string()),
                "choose a plain name");
  }
  for (const char* extension : {".json", ".city"}) {
    if (name.extension() == extension) name = name.stem();
  }
  return name.string() + "_appearance";
}

TexturedCity CityOf(const fs::path& survey, const ExportRequest& request, ExportReport& report) {
  std::error_code error;
  SurveyLooks looks;
  if (!request.epoch.empty()) {
    looks.looks = {ReadLook(survey, request.epoch)};
  } else if (fs::exists(survey / kTexturesFile, error)) {
    looks = ReadLooks(survey);
  } else {
    return {ReadFile(survey / kCityJsonFile), {}};
  }
  report.notes = NotesOf(looks);
  TexturedCity city =
      TexturedCityJson(ReadProxy(survey / kFacetsFile), looks.looks, PicturesFolderOf(request.out));
  // Nothing is painted: what the stage proxy wrote is the same.
  if (city.pictures.empty()) city.text = ReadFile(survey / kCityJsonFile);
  return city;
}

}  // namespace

ExportReport ExportCity(const fs::path& survey, const ExportRequest& request) {
  std::error_code error;
  assert(fs::exists(survey / kCityJsonFile, error));
  if (fs::is_directory(request.out, error)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: is a folder", request.out.string()),
                "name a file, such as castle.city.json");
  }
  ExportReport report;
  TexturedCity city = CityOf(survey, request, report);
  if (!request.crs.empty()) {
    const CityFrame frame{ReadGeoref(survey / kGeorefFile), ReadProxy(survey / kFacetsFile).up};
    city.text = CityInCrs(city.text, frame, request.crs);
  }
  if (city.outdated > 0) {
    report.notes.push_back(
        fmt::format("pictures of an earlier model left out: {}; run stucco texture {} to paint the "
                    "facets again",
                    city.outdated, ShellWord(survey.string())));
  }
  const fs::path beside = request.out.parent_path();
  // Writing the file says what is wrong with it.
  if (!beside.empty()) fs::create_directories(beside, error);
  if (!city.pictures.empty()) {
    report.pictures = static_cast<int>(city.pictures.size());
    report.pictures_folder = beside / PicturesFolderOf(request.out);
    RequireFree(report.pictures_folder, request.overwrite);
    for (const CityPicture& picture : city.pictures) {
      CopyFile(picture.image, beside / picture.name);
    }
  }
  // Last, so that it names what is there.
  WriteFileAtomically(request.out, city.text);
  return report;
}

}  // namespace stucco
