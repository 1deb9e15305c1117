// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/read_map.h"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <map>

#include "plan/map/internal/attributes.h"
#include "plan/map/internal/ogr.h"
#include "plan/map/internal/read_cityjson.h"
#include "survey/city_model.h"
#include "survey/error.h"
#include "survey/quiet_gdal.h"

namespace stucco::plan {
namespace {

constexpr double kMetresPerLevel = 3;  // to undersides: the convention of Simple 3D Buildings
// To tops. New houses have 3 m, those of 1900 have 4: what is too high costs a photo of the sky,
// what is too low the upper end of a wall.
constexpr double kMostMetresPerLevel = 4;
constexpr double kLeastMetresPerLevel = 2;   // a height below that is a mistake
constexpr double kObstacleRadius_m = 3;      // the crown of a young tree; more than wires sway
constexpr double kHighestBuilding_m = 1000;  // higher is a mistake in the map

// By which names attributes go, as Normalized gives them.
constexpr std::array kIdNames = {"id",          "osm_id",   "osm_way_id", "uid", "gml_id",
                                 "building_id", "objectid", "ogc_fid",    "gid", "fid"};
constexpr std::array kHeightNames = {"height", "building_height", "measuredheight", "hoehe", "h"};
constexpr std::array kLevelsNames = {"building_levels", "levels"};
constexpr std::array kRoofHeightNames = {"roof_height"};
constexpr std::array kRoofLevelsNames = {"roof_levels"};
constexpr std::array kRadiusNames = {"radius", "radius_m"};
constexpr std::array kDiameterNames = {"diameter_crown", "crown_diameter", "width"};
constexpr std::array kMinHeightNames = {"min_height", "building_min_height"};
constexpr std::array kMinLevelNames = {"building_min_level", "min_level"};
constexpr std::array kBuildingWords = {"building", "gebaeude", "gebäude", "pand",
                                       "batiment", "bâtiment", "edific",  "footprint"};

// The driver's own settings turn closed ways into areas for `building` only and hide the heights.
constexpr char kOsmSettings[] =
    "closed_ways_are_polygons=building,building:part\n"
    "attribute_name_laundering=no\n"
    "[multipolygons]\n"
    "osm_id=yes\n"
    "attributes=building,building:part,height,building:height,min_height,building:min_height,"
    "building:levels,building:min_level,roof:height,roof:levels\n";
constexpr char kOsmSettingsPath[] = "/vsimem/stucco_osm.ini";

// Lower case, with '_' for what stands between words: building:levels is building_levels.
std::string Normalized(std::string_view name) {
  std::string normalized;
  for (const char c : name) {
    if (c == '@') continue;  // of ids in exports of OpenStreetMap
    normalized += c == ':' || c == '-' || c == ' ' || c == '.' ? '_'
                  : c >= 'A' && c <= 'Z'                       ? static_cast<char>(c - 'A' + 'a')
                                                               : c;
  }
  return normalized;
}

// Attributes of a layer by what they mean, the one to ask first in front.
struct Columns {
  std::vector<int> id;
  std::vector<int> height;
  std::vector<int> levels;
  std::vector<int> roof_height;
  std::vector<int> roof_levels;
  std::vector<int> radius;
  std::vector<int> diameter;
  std::vector<int> min_height;
  std::vector<int> min_level;
  std::vector<int> building;
  std::vector<int> part;
  std::vector<int> relation;  // id of a relation of OpenStreetMap
};

std::vector<std::string> ColumnNames(OGRLayer& layer) {
  std::vector<std::string> names;
  OGRFeatureDefn& definition = *layer.GetLayerDefn();
  names.reserve(definition.GetFieldCount());
  for (int i = 0; i < definition.GetFieldCount(); ++i) {
    names.emplace_back(definition.GetFieldDefn(i)->GetNameRef());
  }
  return names;
}

template <class Names>
std::vector<int> FindColumns(const std::vector<std::string>& columns, const Names& names) {
  constexpr size_t kShapefileLetters = 10;  // longer names are cut
  std::vector<int> found;
  for (const std::string_view name : names) {
    for (size_t i = 0; i < columns.size(); ++i) {
      const std::string column = Normalized(columns[i]);
      const bool is_cut = column.size() == kShapefileLetters && name.starts_with(column);
      if (column == name || is_cut) found.push_back(static_cast<int>(i));
    }
  }
  return found;
}

std::vector<int> NamedColumn(const std::vector<std::string>& columns, const std::string& name,
                             const std::string& option, const std::filesystem::path& path) {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found != columns.end()) return {static_cast<int>(found - columns.begin())};
  throw Error(ErrorKind::kUsage,
              fmt::format("{}: has no attribute {:?} (--{})", path.string(), name, option),
              fmt::format("give one of {}", fmt::join(columns, ", ")));
}

Columns ColumnsOf(OGRLayer& layer, const std::filesystem::path& path, const PlanOptions& options) {
  const std::vector<std::string> names = ColumnNames(layer);
  Columns columns{.id = FindColumns(names, kIdNames),
                  .height = FindColumns(names, kHeightNames),
                  .levels = FindColumns(names, kLevelsNames),
                  .roof_height = FindColumns(names, kRoofHeightNames),
                  .roof_levels = FindColumns(names, kRoofLevelsNames),
                  .radius = FindColumns(names, kRadiusNames),
                  .diameter = FindColumns(names, kDiameterNames),
                  .min_height = FindColumns(names, kMinHeightNames),
                  .min_level = FindColumns(names, kMinLevelNames),
                  .building = FindColumns(names, std::array{"building"}),
                  .part = FindColumns(names, std::array{"building_part"}),
                  .relation = {}};
  if (options.id_field.empty()) {
    columns.relation = FindColumns(names, std::array{"osm_id"});
  } else {
    columns.id = NamedColumn(names, options.id_field, "id-field", path);
  }
  if (!options.height_field.empty()) {
    columns.height = NamedColumn(names, options.height_field, "height-field", path);
    columns.levels.clear();
    columns.roof_height.clear();
  }
  return columns;
}

// The first of these attributes that the feature has.
std::string Text(OGRFeature& feature, const std::vector<int>& columns) {
  for (const int column : columns) {
    if (!feature.IsFieldSetAndNotNull(column)) continue;
    std::string text = feature.GetFieldAsString(column);
    if (!text.empty()) return text;
  }
  return "";
}

// The first of these attributes that is a length. Many maps say 0 for what is not known.
std::optional<double> FirstLength(OGRFeature& feature, const std::vector<int>& columns) {
  for (const int column : columns) {
    if (!feature.IsFieldSetAndNotNull(column)) continue;
    const auto length = internal::ParseLength(feature.GetFieldAsString(column));
    if (length && *length != 0) return length;
  }
  return std::nullopt;
}

// From the storeys; building:levels counts none that are in the roof.
std::optional<double> GuessedHeight(OGRFeature& feature, const Columns& columns) {
  const auto levels = FirstLength(feature, columns.levels);
  if (!levels || !(*levels > 0)) return std::nullopt;
  const double roof_levels = FirstLength(feature, columns.roof_levels).value_or(0);
  const double roof =
      FirstLength(feature, columns.roof_height).value_or(roof_levels * kMostMetresPerLevel);
  const double height = *levels * kMostMetresPerLevel + std::max(roof, 0.0);
  return height <= kHighestBuilding_m ? std::optional(height) : std::nullopt;
}

std::optional<double> Underside(OGRFeature& feature, const Columns& columns) {
  if (const auto height = FirstLength(feature, columns.min_height)) return height;
  const auto level = FirstLength(feature, columns.min_level);
  return level ? std::optional(*level * kMetresPerLevel) : std::nullopt;
}

// The roof is a part of the height: where it is stated to be higher than the whole, the stated
// height is that of the eaves.
double WithRoof(double height, OGRFeature& feature, const Columns& columns) {
  const double roof = FirstLength(feature, columns.roof_height).value_or(0);
  return roof >= height ? height + roof : height;
}

void ReadHeights(OGRFeature& feature, const Columns& columns, RepairLog& repairs,
                 MapFeature& result) {
  const std::string stated = Text(feature, columns.height);
  const auto height = FirstLength(feature, columns.height);
  const auto underside = Underside(feature, columns);
  if (!stated.empty() && !internal::ParseLength(stated)) {
    repairs.Add(result.building, fmt::format("height {:?} is no length; ignored", stated));
  }
  result.guessed_height_m = GuessedHeight(feature, columns);
  const double least = FirstLength(feature, columns.levels).value_or(0) * kLeastMetresPerLevel;
  if (height && *height > 0 && *height <= kHighestBuilding_m && !(*height < least)) {
    result.height_m = WithRoof(*height, feature, columns);
  } else if (height) {
    repairs.Add(result.building,
                fmt::format("height {} m is impossible{}; ignored", *height,
                            *height > 0 && *height < least ? " for its storeys" : ""));
  }
  if (!underside) return;
  const double top = result.height_m.value_or(result.guessed_height_m.value_or(kHighestBuilding_m));
  if (*underside > 0 && *underside < top) {
    result.min_height_m = *underside;
  } else {
    repairs.Add(result.building, fmt::format("min_height {} m is impossible; ignored", *underside));
  }
}

// Of points and lines.
double Radius(OGRFeature& feature, const Columns& columns) {
  constexpr double kMost_m = 100;
  const auto across = FirstLength(feature, columns.diameter);
  const auto radius = FirstLength(feature, columns.radius);
  const double stated = radius ? *radius : across ? *across / 2 : kObstacleRadius_m;
  return stated > 0 && stated <= kMost_m ? stated : kObstacleRadius_m;
}

bool MayHavePolygons(OGRLayer& layer) {
  switch (wkbFlatten(layer.GetGeomType())) {
    case wkbNone:
    case wkbPoint:
    case wkbMultiPoint:
    case wkbLineString:
    case wkbMultiLineString:
    case wkbCircularString:
    case wkbCompoundCurve:
    case wkbMultiCurve:
      return false;
    default:
      return true;
  }
}

bool NamesBuildings(OGRLayer& layer) {
  const std::string name = Normalized(layer.GetName());
  return std::any_of(kBuildingWords.begin(), kBuildingWords.end(),
                     [&](const char* word) { return name.find(word) != std::string::npos; });
}

constexpr char kGiveBuildings[] =
    "give a map with the outlines of buildings as areas, not as points or lines";
constexpr char kGiveAreas[] =
    "give polygons, not points or lines, or leave the option out if there are none";
constexpr char kGiveObstacles[] =
    "give points, lines or polygons, or leave the option out if there are none";

[[noreturn]] void FailNoPolygons(const std::filesystem::path& path, const std::string& layer,
                                 const char* remedy) {
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: {}has no polygons", path.string(),
                          layer.empty() ? "" : fmt::format("layer {:?} ", layer)),
              remedy);
}

// What is read of a map.
struct Content {
  bool points_and_lines = false;  // beside areas
  const char* remedy = "";        // where there is nothing of it
};
constexpr Content kBuildings{.remedy = kGiveBuildings};
constexpr Content kAreas{.remedy = kGiveAreas};
constexpr Content kObstacles{.points_and_lines = true, .remedy = kGiveObstacles};

OGRLayer& ChooseLayer(GDALDataset& dataset, const std::filesystem::path& path,
                      const std::string& wanted, const Content& content, RepairLog& repairs) {
  std::vector<std::string> names;
  std::vector<OGRLayer*> candidates;
  for (OGRLayer* layer : dataset.GetLayers()) {
    names.emplace_back(layer->GetName());
    if (content.points_and_lines || MayHavePolygons(*layer)) candidates.push_back(layer);
  }
  if (!wanted.empty()) {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found != names.end()) return *dataset.GetLayer(static_cast<int>(found - names.begin()));
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: has no layer {:?} (--map-layer)", path.string(), wanted),
                fmt::format("give one of {}", fmt::join(names, ", ")));
  }
  if (candidates.empty()) FailNoPolygons(path, "", content.remedy);
  const auto named = std::find_if(candidates.begin(), candidates.end(),
                                  [](OGRLayer* layer) { return NamesBuildings(*layer); });
  OGRLayer& chosen = named != candidates.end() ? **named : *candidates.front();
  if (candidates.size() > 1) {
    repairs.Add("", fmt::format("layer {:?} read, one of {} with areas (--map-layer names another)",
                                chosen.GetName(), candidates.size()));
  }
  return chosen;
}

std::string CrsOf(OGRLayer& layer) {
  const OGRSpatialReference* reference = layer.GetSpatialRef();
  if (reference == nullptr) return "";
  char* text = nullptr;
  const char* const format[] = {"FORMAT=WKT2_2018", nullptr};
  if (reference->exportToWkt(&text, format) != OGRERR_NONE) return "";
  std::string crs(text);
  CPLFree(text);
  return crs;
}

// Whether features have numbers of their own beside their attributes, as GeoJSON allows; GDAL
// counts from 0 where they have none.
bool HasOwnFids(OGRLayer& layer) {
  const QuietGdal quiet;
  layer.ResetReading();
  GIntBig place = 0;
  for (; const OGRFeatureUniquePtr feature{layer.GetNextFeature()}; ++place) {
    if (feature->GetFID() != place) return true;
  }
  return false;
}

// Features of a layer in the order of the file.
class LayerReader {
 public:
  struct Kind {
    bool is_osm = false;
    bool points_and_lines = false;
  };
  LayerReader(OGRLayer& layer, const Columns& columns, const Kind& kind, RawMap& map)
      : layer_(layer),
        columns_(columns),
        is_osm_(kind.is_osm),
        points_and_lines_(kind.points_and_lines),
        map_(map) {
    use_fid_ =
        *layer.GetFIDColumn() != '\0' || (!is_osm_ && columns.id.empty() && HasOwnFids(layer));
  }

  void Read() {
    const QuietGdal quiet;
    layer_.ResetReading();
    while (const OGRFeatureUniquePtr feature{layer_.GetNextFeature()}) ReadFeature(*feature);
    const std::string message = QuietGdal::Message();
    if (CPLGetLastErrorType() == CE_Failure) {
      throw Error(
          ErrorKind::kBadInput,
          fmt::format("{}: damaged after {} features: {}", map_.path.string(), place_, message),
          "export the map again");
    }
    if (without_area_ > 0) {
      map_.repairs.Add("", fmt::format("{} features without an area left out", without_area_));
    }
  }

 private:
  void ReadFeature(OGRFeature& feature) {
    const bool is_part = IsTagged(feature, columns_.part) && !IsTagged(feature, columns_.building);
    if (is_osm_ && !is_part && !IsTagged(feature, columns_.building)) return;
    ++place_;
    OGRGeometry* geometry = feature.GetGeometryRef();
    if (geometry != nullptr) geometry->flattenTo2D();
    MapFeature result;
    if (geometry != nullptr) result.polygons = internal::RawPolygons(*geometry);
    if (points_and_lines_ && geometry != nullptr && result.polygons.empty()) {
      result.polygons = internal::RawLines(*geometry);
      result.radius_m = Radius(feature, columns_);
    }
    if (result.polygons.empty()) {
      ++without_area_;
      return;
    }
    result.is_part = is_part;
    result.has_open_ring = internal::HasOpenRing(*geometry);
    const std::string own = OwnId(feature);
    result.building = ids_.Next(own, place_);
    if (ids_.renamed()) map_.repairs.Add(result.building, internal::kRenamed);
    ReadHeights(feature, columns_, map_.repairs, result);
    map_.features.push_back(std::move(result));
  }

  static bool IsTagged(OGRFeature& feature, const std::vector<int>& column) {
    const std::string value = Text(feature, column);
    return !value.empty() && value != "no";
  }

  std::string OwnId(OGRFeature& feature) const {
    std::string own = Text(feature, columns_.id);
    // A relation and a way may share a number.
    if (is_osm_ && !Text(feature, columns_.relation).empty()) own = fmt::format("R{}", own);
    if (own.empty() && use_fid_) own = std::to_string(feature.GetFID());
    return own;
  }

  OGRLayer& layer_;
  const Columns& columns_;
  bool is_osm_;
  bool points_and_lines_;
  RawMap& map_;
  bool use_fid_ = false;
  internal::BuildingIds ids_;
  int place_ = 0;
  int without_area_ = 0;
};

GDALDatasetUniquePtr OpenMap(const std::filesystem::path& path) {
  const std::string settings(kOsmSettings);
  VSILFILE* file = VSIFOpenL(kOsmSettingsPath, "wb");
  VSIFWriteL(settings.data(), 1, settings.size(), file);
  VSIFCloseL(file);
  return internal::OpenDataset(path, GDAL_OF_VECTOR,
                               {fmt::format("CONFIG_FILE={}", kOsmSettingsPath)});
}

RawMap ReadLayer(const std::filesystem::path& path, const PlanOptions& options,
                 const Content& content) {
  RawMap map;
  map.path = path;
  const GDALDatasetUniquePtr dataset = OpenMap(path);
  const bool is_osm = std::string_view(dataset->GetDriverName()) == "OSM";
  if (is_osm) dataset->ExecuteSQL("SET interest_layers = multipolygons", nullptr, nullptr);
  OGRLayer& layer = is_osm ? *dataset->GetLayerByName("multipolygons")
                           : ChooseLayer(*dataset, path, options.map_layer, content, map.repairs);
  const Columns columns = ColumnsOf(layer, path, options);
  map.crs = CrsOf(layer);
  LayerReader(layer, columns, {is_osm, content.points_and_lines}, map).Read();
  if (map.features.empty()) FailNoPolygons(path, layer.GetName(), content.remedy);
  return map;
}

}  // namespace

RawMap ReadMap(const std::filesystem::path& path, const PlanOptions& options) {
  if (LooksLikeCityJson(path)) return internal::ReadCityJson(path, options);
  return ReadLayer(path, options, kBuildings);
}

RawMap ReadAreas(const std::filesystem::path& path) {
  return ReadLayer(path, {}, kAreas);
}

RawMap ReadObstacleMap(const std::filesystem::path& path) {
  return ReadLayer(path, {}, kObstacles);
}

}  // namespace stucco::plan
