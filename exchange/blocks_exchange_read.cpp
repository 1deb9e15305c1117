// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "exchange/blocks_exchange.h"
#include "exchange/internal/blocks_exchange_photos.h"
#include "exchange/intersect_rays.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/text.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// "ENU:latitude,longitude", of WGS 84 and on the ellipsoid; some write a height, too.
Georef ReadEnu(const XmlFile& file, const pugi::xml_node& srs, std::string_view definition) {
  Georef georef;
  georef.frame = "enu";
  georef.metric = true;
  georef.up = Eigen::Vector3d::UnitZ();
  georef.source = "file";
  std::string_view rest = definition.substr(definition.find(':') + 1);
  double* const fields[] = {&georef.origin_latitude_deg, &georef.origin_longitude_deg,
                            &georef.origin_height_m};
  size_t count = 0;
  while (!rest.empty() && count < std::size(fields)) {
    const size_t comma = rest.find(',');
    const auto number = ParseNumber<double>(Trim(rest.substr(0, comma)));
    if (!number || !std::isfinite(*number)) count = 0;
    if (!number || !std::isfinite(*number)) break;
    *fields[count++] = *number;
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
  }
  if (count < 2 || !(std::abs(georef.origin_latitude_deg) <= 90) ||
      !(std::abs(georef.origin_longitude_deg) <= 360)) {
    file.Fail(srs, fmt::format("\"{}\" is no place on the earth", definition));
  }
  return georef;
}

// Says in the result what the frame of the poses is.
void ReadFrame(const XmlFile& file, const pugi::xml_node& block, const std::string& id,
               ExchangedModel& result) {
  if (id.empty()) return;  // local
  const pugi::xml_node systems =
      file.root().child("BlocksExchange").child("SpatialReferenceSystems");
  const auto all = systems.children("SRS");
  const auto srs = std::ranges::find_if(
      all, [&](const pugi::xml_node& each) { return TextOf(each, "Id") == id; });
  if (srs == all.end()) file.Fail(block, fmt::format("there is no SRS with the Id {}", id));
  const std::string definition = TextOf(*srs, "Definition");
  if (definition.empty()) file.Fail(*srs, "it has no Definition");
  if (definition.starts_with("ENU:")) {
    result.georef = ReadEnu(file, *srs, definition);
  } else if (!definition.starts_with("LOCAL")) {
    const fs::path beside = file.path().parent_path() / definition;
    std::error_code error;
    const bool is_file = definition.size() < 256 && fs::is_regular_file(beside, error);
    result.crs = is_file ? ReadFile(beside) : definition;
  }
}

uint8_t Byte(double share) {
  return static_cast<uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

class TiePointReader {
 public:
  TiePointReader(const BlockPhotos& photos, std::string srs_id, ExchangedModel& result)
      : photos_(photos), srs_id_(std::move(srs_id)), result_(result) {}

  // Tie points are children of `parent`, whose coordinate system is `srs_id`.
  void Read(const XmlFile& file, const pugi::xml_node& parent, const std::string& srs_id) {
    for (const pugi::xml_node node : parent.children("TiePoint")) {
      const std::string own_srs = TextOf(node, "SRSId");
      if ((own_srs.empty() ? srs_id : own_srs) != srs_id_) {
        file.Fail(node, "its coordinate system is not that of the poses",
                  "export the block with everything in one coordinate system");
      }
      ReadPoint(file, node);
    }
  }

  int without_position() const { return without_position_; }

 private:
  void ReadPoint(const XmlFile& file, const pugi::xml_node& node) {
    ExchangedPoint point;
    const pugi::xml_node color = node.child("Color");
    const char* const names[] = {"Red", "Green", "Blue"};
    for (size_t i = 0; i < point.rgb.size(); ++i) {
      point.rgb[i] = Byte(file.FindNumber(color, names[i]).value_or(0.5));
    }
    for (const pugi::xml_node seen : node.children("Measurement")) {
      const int64_t id = file.Integer(seen, "PhotoId");
      if (!photos_.all.contains(id)) {
        file.Fail(seen, fmt::format("there is no photo with the Id {}", id));
      }
      const Eigen::Vector2d pixel(file.Number(seen, "x"), file.Number(seen, "y"));
      const auto photo = photos_.posed.find(id);
      if (photo == photos_.posed.end()) continue;
      point.pixels.emplace_back(photo->second, pixel + Eigen::Vector2d::Constant(kPixelCentre));
    }
    if (point.pixels.size() < 2) return;
    const auto position = PositionOf(file, node, point);
    without_position_ += !position;
    if (!position) return;
    point.position = *position;
    AddSeenPoint(point, result_.model);
  }

  std::optional<Eigen::Vector3d> PositionOf(const XmlFile& file, const pugi::xml_node& node,
                                            const ExchangedPoint& point) const {
    if (const pugi::xml_node position = node.child("Position")) return file.Vector(position);
    // Rays of poses on a map would first have to be brought into the world.
    return result_.crs.empty() ? IntersectRays(point, result_.model) : std::nullopt;
  }

  const BlockPhotos& photos_;
  std::string srs_id_;
  ExchangedModel& result_;
  int without_position_ = 0;
};

void ReadTiePoints(const XmlFile& file, const pugi::xml_node& block, const BlockPhotos& photos,
                   ExchangedModel& result) {
  const std::string srs_id = *photos.srs_ids.begin();
  TiePointReader reader(photos, srs_id, result);
  const pugi::xml_node points = block.child("TiePoints");
  const std::string own_srs = TextOf(points, "SRSId");
  const std::string points_srs = own_srs.empty() ? TextOf(block, "SRSId") : own_srs;
  reader.Read(file, points, points_srs);
  std::string apart = TextOf(points, "Path");
  if (!apart.empty()) {
    std::replace(apart.begin(), apart.end(), '\\', '/');
    const XmlFile other(file.path().parent_path() / apart);
    reader.Read(other, other.root(), points_srs);
    reader.Read(other, other.root().child("TiePoints"), points_srs);
  }
  if (reader.without_position() > 0) {
    result.notes.push_back(
        fmt::format("{} tie points have no position and are left out", reader.without_position()));
  }
}

pugi::xml_node ChooseBlock(const XmlFile& file, ExchangedModel& result) {
  const pugi::xml_node root = file.root().child("BlocksExchange");
  if (!root) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is no BlocksExchange file", file.path().string()),
                "export the block as BlocksExchange XML");
  }
  pugi::xml_node best;
  int most = 0;
  int blocks = 0;
  for (const pugi::xml_node block : root.children("Block")) {
    ++blocks;
    const int posed = CountPosed(block);
    if (posed <= most) continue;
    most = posed;
    best = block;
  }
  if (!best) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: no photo in it has a pose with rotation", file.path().string()),
                "export the block after its aerotriangulation, with rotations as matrices");
  }
  if (blocks > 1) {
    result.notes.push_back(
        fmt::format("of its {} blocks the one with the most poses was taken", blocks));
  }
  return best;
}

}  // namespace

ExchangedModel ReadBlocksExchange(const fs::path& path, const PhotoIndex& photos) {
  const XmlFile file(path);
  ExchangedModel result;
  const pugi::xml_node block = ChooseBlock(file, result);
  result.format = fmt::format("BlocksExchange {}",
                              file.root().child("BlocksExchange").attribute("version").as_string());
  const BlockPhotos found = ReadBlockPhotos(file, block, photos, result);
  if (found.srs_ids.size() > 1) {
    file.Fail(block, "its photos are in several coordinate systems",
              "export the block with everything in one coordinate system");
  }
  ReadFrame(file, block, *found.srs_ids.begin(), result);
  ReadTiePoints(file, block, found, result);
  const size_t left_out = found.all.size() - found.posed.size();
  if (left_out > 0) result.notes.push_back(fmt::format("{} photos in it have no pose", left_out));
  const auto controls = block.child("ControlPoints").children("ControlPoint");
  if (controls.begin() != controls.end()) {
    result.notes.emplace_back("its control points are not read; its poses already obey them");
  }
  return result;
}

}  // namespace stucco
