// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/report/made_survey.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "survey/colmap_io.h"
#include "survey/image.h"
#include "survey/point_cloud.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

constexpr double kHeight = 9;
constexpr int kPhotos = 24;

std::string PhotoPath(int i) {
  return fmt::format("flight {}/DJI_{:04}.JPG", 1 + i / 12, i);
}

Facet MakeFacet(const std::string& id, FacetClass facet_class, std::vector<Eigen::Vector3d> outer) {
  Facet facet;
  facet.id = id;
  facet.facet_class = facet_class;
  facet.normal = (outer[1] - outer[0]).cross(outer[2] - outer[0]).normalized();
  facet.offset = facet.normal.dot(outer[0]);
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < outer.size(); ++i) {
    twice_area += outer[i].cross(outer[(i + 1) % outer.size()]);
  }
  facet.area = std::abs(twice_area.dot(facet.normal)) / 2;
  facet.outer = std::move(outer);
  facet.rms = 0.018;
  facet.support = static_cast<int>(facet.area * 90);
  facet.seen = 0.93;
  facet.inferred = 0.07;
  facet.source = "planes";
  return facet;
}

// A box of walls with a flat roof, turned by `angle`.
Building MakeBuilding(int number, const Eigen::Vector2d& at, double length, double width,
                      double angle) {
  const std::string id = fmt::format("B{:04}", number);
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d across(-along.y(), along.x());
  const Eigen::Vector2d corners[] = {at, at + length * along, at + length * along + width * across,
                                     at + width * across};
  const auto lifted = [](const Eigen::Vector2d& p, double z) {
    return Eigen::Vector3d(p.x(), p.y(), z);
  };
  Building building;
  building.id = id;
  building.watertight = number == 1;
  building.source = "cloud";
  std::vector<Eigen::Vector3d> roof;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % 4];
    building.facets.push_back(
        MakeFacet(fmt::format("{}/W{:02}", id, i + 1), FacetClass::kWall,
                  {lifted(a, 0), lifted(b, 0), lifted(b, kHeight), lifted(a, kHeight)}));
    roof.push_back(lifted(a, kHeight));
  }
  building.facets.push_back(MakeFacet(id + "/R1", FacetClass::kRoof, roof));
  return building;
}

TexturedFacet MakeTexture(const Facet& facet, int kind) {
  TexturedFacet texture;
  texture.id = facet.id;
  std::string file = facet.id;
  for (char& c : file) c = c == '/' ? '_' : c;
  texture.image = "textures/" + file + ".png";
  texture.label_image = "labels/" + file + ".png";
  texture.orthophoto = "orthophotos/" + file + ".png";
  const Eigen::Vector3d side = facet.outer[1] - facet.outer[0];
  texture.metres_per_texel = 0.03;
  texture.width_px = std::max(8, static_cast<int>(side.norm() / 0.03));
  texture.height_px = std::max(8, static_cast<int>(facet.area / side.norm() / 0.03));
  texture.origin = facet.outer.back();
  texture.u_axis = side.normalized();
  texture.v_axis = -Eigen::Vector3d::UnitZ();
  texture.photos = {PhotoPath(kind), PhotoPath(kind + 1), PhotoPath(kind + 5)};
  texture.gains = {{PhotoPath(kind), 1.02}, {PhotoPath(kind + 1), 0.97}, {PhotoPath(kind + 5), 1}};
  const bool poor = kind % 7 == 3;
  const bool middling = kind % 5 == 2;
  texture.painted = poor ? 0.48 : middling ? 0.83 : 0.985;
  texture.inpainted = poor ? 0.31 : middling ? 0.08 : 0.012;
  texture.misregistration_px = poor ? 3.4 : 0.8;
  texture.gsd_m = middling ? 0.021 : 0.012;
  texture.sharpness = 340 - 10 * kind;
  texture.q_s = poor ? 0.41 : 0.86;
  texture.q_d = middling ? 0.52 : 0.77;
  texture.q_u = 0.64;
  texture.q_c = texture.painted;
  return texture;
}

void AddPhotos(MadeSurvey& made) {
  CapturedCamera camera;
  camera.key = "DJI|FC6310R";
  camera.label = "DJI FC6310R, 5472 x 3648, 8.8 mm";
  camera.focal_source = "exif_35mm";
  camera.intrinsics.id = CameraId{1};
  camera.intrinsics.model = CameraModel::kOpenCv;
  camera.intrinsics.width_px = 5472;
  camera.intrinsics.height_px = 3648;
  camera.intrinsics.params = {3700, 3700, 2736, 1824, 0, 0, 0, 0};
  made.captures.cameras.push_back(camera);
  made.sparse.cameras[CameraId{1}] = camera.intrinsics;
  for (int i = 0; i < kPhotos; ++i) {
    CapturedPhoto photo;
    photo.path = PhotoPath(i);
    photo.usable = i != 20 && i != 21;
    photo.width_px = 5472;
    photo.height_px = 3648;
    photo.camera = photo.usable ? 0 : -1;
    if (i == 20) photo.why = "the file is empty; copy the photo from the camera again";
    if (i == 21) {
      photo.why = "identical to " + PhotoPath(3) + "; nothing to do";
      photo.duplicate_of = PhotoPath(3);
    }
    made.captures.photos.push_back(photo);
  }
}

void AddCalibration(MadeSurvey& made) {
  Calibration& calibration = made.calibration;
  calibration.photos_total = 22;
  calibration.photos_posed = 21;
  calibration.reprojection_error_px = 0.61;
  calibration.points = 18432;
  calibration.mean_track_length = 4.7;
  calibration.prior_rms_horizontal_m = 0.043;
  calibration.prior_rms_vertical_m = 0.071;
  calibration.unposed = {{PhotoPath(19),
                          "7 matches with its best neighbour, 30 are needed; fly "
                          "closer to the other photos"}};
  for (int i = 0; i < 19; ++i) {
    calibration.photos.push_back(
        {PhotoPath(i), 0.5 + 0.01 * i, 1200 - 20 * i, 0.03 + 0.002 * i, i == 7, 0.9 - 0.01 * i});
    RegisteredImage posed;
    posed.id = PhotoId{static_cast<uint32_t>(i + 1)};
    posed.camera = CameraId{1};
    posed.name = PhotoPath(i);
    const double angle = i * 0.33;
    const Eigen::Vector3d center(20 + 42 * std::cos(angle), 12 + 34 * std::sin(angle), 22);
    posed.cam_from_world.translation = -center;
    made.sparse.photos[posed.id] = posed;
  }
  CalibratedCamera camera;
  camera.id = 1;
  camera.label = made.captures.cameras[0].label;
  camera.model = "OPENCV";
  camera.names = {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"};
  camera.params = {3688.2, 3688.9, 2740.1, 1819.6, -0.0052, 0.0113, 0.0004, -0.0002};
  camera.sigma = {1.9, 1.9, 0.8, 0.9, 0.0002, 0.0006, 0.00003, 0};
  camera.held = {"p2"};
  calibration.cameras.push_back(camera);
  calibration.findings = {"1 GPS position is 9.2 m from the others' agreement and was not used"};
}

// A wall with windows; every texel belongs to a photo, to the filled-in corner or to none.
void WritePictures(const TexturedFacet& texture, int kind, const std::filesystem::path& folder) {
  const cv::Size size(texture.width_px, texture.height_px);
  Image image{size.width, size.height, 3, {}};
  image.data.resize(size_t{3} * size.area());
  cv::Mat wall(size, CV_8UC3, image.data.data());
  const cv::Scalar colors[] = {{201, 184, 160}, {176, 106, 84}, {214, 208, 196}, {150, 140, 128}};
  wall.setTo(colors[kind % 4]);
  for (int y = 0; y < size.height; y += 8) {
    cv::line(wall, {0, y}, {size.width, y}, colors[kind % 4] * 0.94);
  }
  for (int y = 30; y + 70 < size.height; y += 95) {
    for (int x = 30; x + 44 < size.width; x += 84) {
      cv::rectangle(wall, {x - 4, y - 4, 52, 72}, {240, 238, 232}, cv::FILLED);
      cv::rectangle(wall, {x, y, 44, 64}, {58, 72, 88}, cv::FILLED);
      cv::line(wall, {x + 22, y}, {x + 22, y + 64}, {240, 238, 232}, 3);
    }
  }
  Image labels{size.width, size.height, 1, {}};
  labels.data.resize(size.area());
  cv::Mat label(size, CV_8UC1, labels.data.data());
  label.setTo(1);
  label.colRange(size.width / 3, 2 * size.width / 3).setTo(2);
  label.colRange(2 * size.width / 3, size.width).setTo(3);
  const int filled = static_cast<int>(texture.inpainted * size.width);
  label(cv::Rect(0, size.height / 2, filled, size.height - size.height / 2)).setTo(255);
  label.rowRange(0, size.height / 20).setTo(0);
  std::filesystem::create_directories((folder / texture.image).parent_path());
  std::filesystem::create_directories((folder / texture.label_image).parent_path());
  WriteImage(image, folder / texture.image);
  WriteImage(labels, folder / texture.label_image);
}

}  // namespace

MadeSurvey MakeSurvey(const MadeSurveyOptions& options) {
  MadeSurvey made;
  AddPhotos(made);
  AddCalibration(made);
  made.georef.metric = options.metric;
  if (options.metric) {
    made.georef.frame = "enu";
    made.georef.origin_latitude_deg = 45.0315957;
    made.georef.origin_longitude_deg = 7.6204659;
    made.georef.origin_height_m = 305.1;
    made.georef.source = "gps";
  } else {
    made.georef.source = "none";
    made.calibration.prior_rms_horizontal_m = -1;
    made.calibration.prior_rms_vertical_m = -1;
    made.calibration.findings = {"6 photos were taken from one point"};
    for (CalibratedPhoto& photo : made.calibration.photos) photo.prior_residual_m = -1;
  }
  made.proxy.metric = options.metric;
  made.proxy.findings = {"B0002: wings that the map lacks lean on it, 34 m2"};
  int kind = 0;
  for (int i = 0; i < options.buildings; ++i) {
    made.proxy.buildings.push_back(MakeBuilding(i + 1, {22.0 * (i % 3), 26.0 * (i / 3)},
                                                14 + 3 * (i % 2), 9 + 2 * (i % 3), 0.12 * i));
    for (Facet& facet : made.proxy.buildings.back().facets) {
      made.textures.facets.push_back(MakeTexture(facet, kind % 15));
      if (kind == 9) {
        made.textures.facets.back().image.clear();
        made.textures.facets.back().label_image.clear();
        made.textures.facets.back().photos.clear();
        made.textures.facets.back().painted = 0;
        facet.seen = 0.1;
        facet.inferred = 0.9;
      }
      ++kind;
    }
  }
  made.textures.model_glb = "model.glb";
  made.textures.model_obj = "model.obj";
  return made;
}

void WriteSurvey(const MadeSurvey& made, const std::filesystem::path& survey) {
  for (const char* folder : {"ingest", "calib", "dense", "proxy", "texture"}) {
    std::filesystem::create_directories(survey / folder);
  }
  WriteCaptures(made.captures, survey / kCapturesFile);
  WriteCalibration(made.calibration, survey / kCalibrationFile);
  WriteGeoref(made.georef, survey / kGeorefFile);
  WriteColmapBinary(made.sparse, survey / kSparseFolder);
  WritePly({}, survey / kCloudFile);
  WriteProxy(made.proxy, survey / kFacetsFile);
  WriteTextureSet(made.textures, survey / kTexturesFile);
  int kind = 0;
  for (const TexturedFacet& texture : made.textures.facets) {
    if (!texture.image.empty()) WritePictures(texture, kind, survey / "texture");
    ++kind;
  }
}

bool Has(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

}  // namespace stucco
