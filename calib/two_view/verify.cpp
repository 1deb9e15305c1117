// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/two_view/verify.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <random>

#include "calib/features/chance.h"
#include "calib/scene/triangulate.h"
#include "survey/error.h"
#include "survey/median.h"

namespace stucco {
namespace {

// Findings that wrong matches may give in all pairs of photos like this one, on average.
const double kLogFalseAlarms = std::log(1e-3);
// Standard deviations of Fisher's z: one of ten thousand pairs of wrong matches is beyond.
constexpr double kFollowing = 3.7;
// A share of what F explains that does not lie on a plane by chance, but would on a scene's
// largest.
constexpr double kOnAPlane = 0.35;
constexpr double kNearlyAll = 0.8;
// Places that differ by less than the limit do not tell whether they follow each other.
constexpr double kLeastSpread_px2 = 1;
// A wrong focal length and a lens not calibrated yet bend rays: times the limit per standard
// deviation of the focal length.
constexpr double kWiderByFocal = 10;
constexpr int kManyRounds = 10000;
constexpr int kFewRounds = 2000;  // among matches most of which agree
constexpr size_t kRays = 250;     // of such matches, enough for an essential matrix

cv::UsacParams Usac(double threshold, int seed) {
  cv::UsacParams params;
  params.confidence = 0.9999;
  params.maxIterations = kManyRounds;
  params.threshold = threshold;
  params.isParallel = false;
  params.randomGeneratorState = seed;
  params.score = cv::SCORE_METHOD_MAGSAC;
  params.sampler = cv::SAMPLING_UNIFORM;
  params.loMethod = cv::LOCAL_OPTIM_SIGMA;
  params.loIterations = 10;
  params.loSampleSize = 50;
  return params;
}

std::vector<cv::Point2d> ToOpenCv(const std::vector<Eigen::Vector2d>& points) {
  std::vector<cv::Point2d> result;
  result.reserve(points.size());
  for (const Eigen::Vector2d& p : points) result.emplace_back(p.x(), p.y());
  return result;
}

Eigen::Matrix3d ToEigen(const cv::Mat& m) {
  Eigen::Matrix3d result;
  for (int r = 0; r < 3; ++r) {
    for (int col = 0; col < 3; ++col) result(r, col) = m.at<double>(r, col);
  }
  return result;
}

// Squared Sampson distance (Hartley & Zisserman 2004, eq. 11.9).
double SampsonSquared(const Eigen::Matrix3d& f, const Eigen::Vector2d& a,
                      const Eigen::Vector2d& b) {
  const Eigen::Vector3d fa = f * a.homogeneous();
  const Eigen::Vector3d fb = f.transpose() * b.homogeneous();
  const double e = b.homogeneous().dot(fa);
  const double denominator = fa.head<2>().squaredNorm() + fb.head<2>().squaredNorm();
  return denominator > 0 ? e * e / denominator : std::numeric_limits<double>::infinity();
}

double TransferSquared(const Eigen::Matrix3d& h, const Eigen::Vector2d& a,
                       const Eigen::Vector2d& b) {
  const Eigen::Vector3d mapped = h * a.homogeneous();
  if (std::abs(mapped.z()) < 1e-12) return std::numeric_limits<double>::infinity();
  return (mapped.hnormalized() - b).squaredNorm();
}

Eigen::Matrix3d Kabsch(const std::vector<Eigen::Vector3d>& from,
                       const std::vector<Eigen::Vector3d>& to, const std::vector<int>& indices) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const int i : indices) covariance += to[i] * from[i].transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1,
                        (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

// Nothing where there are too few rays.
std::optional<Eigen::Matrix3d> FindEssential(const std::vector<Eigen::Vector2d>& first,
                                             const std::vector<Eigen::Vector2d>& second,
                                             double max_error, int rounds) {
  if (first.size() < 8) return std::nullopt;
  // OpenCV's USAC works in pixels: an arbitrary focal length keeps its thresholds in a sane range.
  constexpr double kFocal = 1000;
  const cv::Mat k = (cv::Mat_<double>(3, 3) << kFocal, 0, 0, 0, kFocal, 0, 0, 0, 1);
  std::vector<Eigen::Vector2d> a(first.size());
  std::vector<Eigen::Vector2d> b(second.size());
  for (size_t i = 0; i < first.size(); ++i) {
    a[i] = first[i] * kFocal;
    b[i] = second[i] * kFocal;
  }
  cv::UsacParams params = Usac(max_error * kFocal, 0);
  params.maxIterations = rounds;
  cv::Mat mask;
  const cv::Mat e = cv::findEssentialMat(ToOpenCv(a), ToOpenCv(b), k, k, cv::noArray(),
                                         cv::noArray(), mask, params);
  if (e.rows != 3) return std::nullopt;
  return ToEigen(e);
}

// The places that matches join.
struct Joined {
  std::vector<Eigen::Vector2d> first;
  std::vector<Eigen::Vector2d> second;

  size_t size() const { return first.size(); }
};

Joined Subset(const Joined& joined, const std::vector<char>& in) {
  Joined some;
  for (size_t i = 0; i < in.size(); ++i) {
    if (!in[i]) continue;
    some.first.push_back(joined.first[i]);
    some.second.push_back(joined.second[i]);
  }
  return some;
}

// At most `count` of them, spread evenly.
Joined Thinned(const Joined& joined, size_t count) {
  const size_t step = joined.size() / count + 1;
  Joined some;
  for (size_t i = 0; i < joined.size(); i += step) {
    some.first.push_back(joined.first[i]);
    some.second.push_back(joined.second[i]);
  }
  return some;
}

// Length of the diagonal and area of what the points span.
struct Extent {
  double diagonal_px = 0;
  double area_px2 = 0;
};

Extent ExtentOf(const std::vector<Eigen::Vector2d>& points) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : points) box.extend(p);
  if (box.isEmpty()) return {};
  return {box.diagonal().norm(), box.volume()};
}

// What is looked for among matches, and the chance that a wrong match agrees with it if keypoints
// lie anywhere.
struct Model {
  std::function<bool(const Eigen::Vector2d&, const Eigen::Vector2d&)> agrees;
  int sample_size = 7;
  int models_per_sample = 1;
  double chance_anywhere = 0;
};

// How many of wrong matches agree: keypoints of different matches joined.
double ShareOfMisjoined(const Joined& joined, const Model& model) {
  constexpr size_t kEnough = 20000;
  const size_t count = joined.size();
  if (count < 2) return 1;
  const size_t rounds = std::min(count - 1, kEnough / count + 1);
  size_t agreeing = 0;
  for (size_t round = 1; round <= rounds; ++round) {
    const size_t shift = std::max(round, count * round / (rounds + 1));
    for (size_t i = 0; i < count; ++i) {
      agreeing += model.agrees(joined.first[i], joined.second[(i + shift) % count]);
    }
  }
  return static_cast<double>(agreeing) / static_cast<double>(rounds * count);
}

// What a model explains.
struct Explained {
  std::vector<char> which;  // by match
  int count = 0;
  bool above_chance = false;

  int CountAboveChance() const { return above_chance ? count : 0; }
  bool Believes(size_t match) const { return above_chance && which[match]; }
};

Explained Explain(const Joined& joined, const Model& model) {
  Explained explained;
  for (size_t i = 0; i < joined.size(); ++i) {
    explained.which.push_back(model.agrees(joined.first[i], joined.second[i]));
    explained.count += explained.which.back();
  }
  // Keypoints in a narrow band, or in a corner, agree more easily than those anywhere.
  const double chance =
      std::max({std::min(1.0, model.chance_anywhere), ShareOfMisjoined(joined, model),
                ShareOfMisjoined(Subset(joined, explained.which), model)});
  const ChanceFinding finding{static_cast<int>(joined.size()), explained.count, model.sample_size,
                              model.models_per_sample, chance};
  explained.above_chance = LogFalseAlarms(finding) < kLogFalseAlarms;
  return explained;
}

// The smaller canonical correlation of the places in both photos (Hotelling, "Relations between two
// sets of variates", 1936): what an epipolar geometry explains follows across the lines; where it
// is a scene, places along them follow too.
double SmallerCorrelation(const Joined& joined) {
  Eigen::Vector2d mean_a = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_b = Eigen::Vector2d::Zero();
  const auto count = static_cast<double>(joined.size());
  for (size_t i = 0; i < joined.size(); ++i) {
    mean_a += joined.first[i] / count;
    mean_b += joined.second[i] / count;
  }
  Eigen::Matrix2d aa = Eigen::Matrix2d::Identity() * kLeastSpread_px2 * count;
  Eigen::Matrix2d bb = aa;
  Eigen::Matrix2d ab = Eigen::Matrix2d::Zero();
  for (size_t i = 0; i < joined.size(); ++i) {
    const Eigen::Vector2d a = joined.first[i] - mean_a;
    const Eigen::Vector2d b = joined.second[i] - mean_b;
    aa += a * a.transpose();
    bb += b * b.transpose();
    ab += a * b.transpose();
  }
  const Eigen::Matrix2d root_a = aa.llt().matrixL();
  const Eigen::Matrix2d root_b = bb.llt().matrixL();
  const Eigen::Matrix2d whitened = root_a.inverse() * ab * root_b.inverse().transpose();
  return Eigen::JacobiSVD<Eigen::Matrix2d>(whitened).singularValues()[1];
}

// Whether places along epipolar lines follow each other by more than chance (Fisher's
// transformation), or a good part lies on a plane.
bool FollowAlongLines(const Joined& joined, const Explained& by_f, const Explained& by_h) {
  if (by_h.count >= kOnAPlane * by_f.count) return true;
  const double correlation = std::min(SmallerCorrelation(Subset(joined, by_f.which)), 1 - 1e-9);
  return std::atanh(correlation) * std::sqrt(std::max(1, by_f.count - 5)) > kFollowing;
}

// Whether the essential matrix of the matches in `known` explains each of them. Nothing where it
// explains too few for the metadata to be right.
std::optional<std::vector<char>> ConfirmByCameras(const Joined& joined,
                                                  const std::vector<char>& known,
                                                  const VerifyOptions& options) {
  const PairCameras& cameras = *options.cameras;
  Joined rays;
  std::vector<size_t> of_match;
  for (size_t i = 0; i < known.size(); ++i) {
    if (!known[i]) continue;
    const auto a = cameras.first.Unproject(joined.first[i]);
    const auto b = cameras.second.Unproject(joined.second[i]);
    if (!a || !b) continue;
    rays.first.push_back(*a);
    rays.second.push_back(*b);
    of_match.push_back(i);
  }
  const double wider = 1 + kWiderByFocal * cameras.focal_sigma_ratio;
  const double limit =
      options.max_error_px * wider * 2 / (cameras.first.FocalX() + cameras.second.FocalX());
  const Joined some = Thinned(rays, kRays);
  const auto essential = FindEssential(some.first, some.second, limit, kFewRounds);
  if (!essential) return std::nullopt;
  std::vector<char> confirmed(known.size(), 0);
  for (size_t i = 0; i < of_match.size(); ++i) {
    confirmed[of_match[i]] =
        SampsonSquared(*essential, rays.first[i], rays.second[i]) < limit * limit;
  }
  const auto count = std::count(confirmed.begin(), confirmed.end(), 1);
  if (2 * count < std::count(known.begin(), known.end(), 1)) return std::nullopt;
  return confirmed;
}

// Whether more matches off a plane agree on an epipole than chance lets: with a plane known, two
// matches determine it.
bool AgreeOffThePlane(const Joined& joined, const Model& f, const Explained& by_h) {
  std::vector<char> off_plane = by_h.which;
  for (char& each : off_plane) each = !each;
  Model epipole = f;
  epipole.sample_size = 2;
  epipole.models_per_sample = 1;
  return Explain(Subset(joined, off_plane), epipole).above_chance;
}

Model FundamentalModel(const Eigen::Matrix3d& f, double limit_px, const Extent& extent) {
  Model model;
  model.agrees = [f, limit_px](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return SampsonSquared(f, a, b) < limit_px * limit_px;
  };
  model.sample_size = 7;
  model.models_per_sample = 3;
  model.chance_anywhere = 2 * limit_px * extent.diagonal_px / extent.area_px2;
  return model;
}

Model HomographyModel(const Eigen::Matrix3d& h, double limit_px, const Extent& extent) {
  Model model;
  model.agrees = [h, limit_px](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return TransferSquared(h, a, b) < limit_px * limit_px;
  };
  model.sample_size = 4;
  model.chance_anywhere = std::numbers::pi * limit_px * limit_px / extent.area_px2;
  return model;
}

// Zero where there is none: it explains nothing.
struct Matrices {
  Eigen::Matrix3d fundamental = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d homography = Eigen::Matrix3d::Zero();
};

Matrices FindMatrices(const Joined& joined, const VerifyOptions& options) {
  const auto first = ToOpenCv(joined.first);
  const auto second = ToOpenCv(joined.second);
  const cv::UsacParams params = Usac(options.max_error_px, options.seed);
  cv::Mat mask;
  const cv::Mat f = cv::findFundamentalMat(first, second, mask, params);
  const cv::Mat h = cv::findHomography(first, second, mask, params);
  Matrices found;
  if (f.rows == 3) found.fundamental = ToEigen(f);
  if (h.rows == 3) found.homography = ToEigen(h);
  return found;
}

// Which matches stay of what F and the homography explain, where one of them is above chance.
std::vector<char> Believed(const Joined& joined, const Model& f, const Explained& by_f,
                           const Explained& by_h, const VerifyOptions& options) {
  std::vector<char> either(joined.size(), 0);
  for (size_t i = 0; i < either.size(); ++i) {
    either[i] = by_f.Believes(i) || by_h.Believes(i);
  }
  if (!by_f.above_chance) return either;
  std::optional<std::vector<char>> confirmed;
  if (options.cameras) confirmed = ConfirmByCameras(joined, either, options);
  if (!confirmed) {
    const bool is_plane = by_h.above_chance && by_h.count >= kNearlyAll * by_f.count;
    if (!is_plane || AgreeOffThePlane(joined, f, by_h)) return either;
    confirmed = by_h.which;
  }
  for (size_t i = 0; i < either.size(); ++i) {
    either[i] = either[i] && (by_h.Believes(i) || (*confirmed)[i]);
  }
  return either;
}

}  // namespace

std::optional<PairGeometry> VerifyPair(const std::vector<Eigen::Vector2d>& first,
                                       const std::vector<Eigen::Vector2d>& second,
                                       const std::vector<Match>& matches,
                                       const VerifyOptions& options) {
  assert(std::ranges::all_of(matches, [&](const Match& match) {
    return static_cast<size_t>(match.first) < first.size() &&
           static_cast<size_t>(match.second) < second.size();
  }));
  if (static_cast<int>(matches.size()) < options.min_inliers) return std::nullopt;
  Joined joined;
  for (const Match& match : matches) {
    joined.first.push_back(first[match.first]);
    joined.second.push_back(second[match.second]);
  }
  const Matrices found = FindMatrices(joined, options);
  const Extent extent = ExtentOf(second);
  const Model f_model = FundamentalModel(found.fundamental, options.max_error_px, extent);
  const Explained by_f = Explain(joined, f_model);
  const Explained by_h =
      Explain(joined, HomographyModel(found.homography, options.max_error_px, extent));
  const int most = std::max(by_f.CountAboveChance(), by_h.CountAboveChance());
  if (most < options.min_inliers || !FollowAlongLines(joined, by_f, by_h)) return std::nullopt;
  const std::vector<char> believed = Believed(joined, f_model, by_f, by_h, options);
  PairGeometry pair{{}, found.fundamental, by_f.count, by_h.count};
  for (size_t i = 0; i < matches.size(); ++i) {
    if (believed[i]) pair.inliers.push_back(matches[i]);
  }
  if (static_cast<int>(pair.inliers.size()) < options.min_inliers) return std::nullopt;
  return pair;
}

std::string Serialize(const std::optional<PairGeometry>& pair) {
  if (!pair) return {};
  std::string bytes(sizeof(double) * 9 + sizeof(int32_t) * 2, '\0');
  std::memcpy(bytes.data(), pair->fundamental.data(), sizeof(double) * 9);
  const int32_t counts[2] = {pair->num_fundamental, pair->num_homography};
  std::memcpy(bytes.data() + sizeof(double) * 9, counts, sizeof(counts));
  bytes.append(reinterpret_cast<const char*>(pair->inliers.data()),
               pair->inliers.size() * sizeof(Match));
  return bytes;
}

std::optional<PairGeometry> DeserializePair(std::string_view bytes) {
  if (bytes.empty()) return std::nullopt;
  constexpr size_t kHead = sizeof(double) * 9 + sizeof(int32_t) * 2;
  if (bytes.size() < kHead || (bytes.size() - kHead) % sizeof(Match) != 0) {
    throw Error(ErrorKind::kBadInput, "matches: the checkpoint is damaged");
  }
  PairGeometry pair;
  std::memcpy(pair.fundamental.data(), bytes.data(), sizeof(double) * 9);
  int32_t counts[2];
  std::memcpy(counts, bytes.data() + sizeof(double) * 9, sizeof(counts));
  pair.num_fundamental = counts[0];
  pair.num_homography = counts[1];
  pair.inliers.resize((bytes.size() - kHead) / sizeof(Match));
  std::memcpy(pair.inliers.data(), bytes.data() + kHead, bytes.size() - kHead);
  return pair;
}

std::optional<RelativePose> EstimateRelativePose(const std::vector<Eigen::Vector2d>& first,
                                                 const std::vector<Eigen::Vector2d>& second,
                                                 double max_error) {
  assert(first.size() == second.size());
  if (first.size() < 8) return std::nullopt;
  const auto found = FindEssential(first, second, max_error, kManyRounds);
  if (!found) return std::nullopt;
  const Eigen::Matrix3d& essential = *found;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(essential, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  Eigen::Matrix3d v = svd.matrixV();
  if (u.determinant() < 0) u = -u;
  if (v.determinant() < 0) v = -v;
  Eigen::Matrix3d w;
  w << 0, -1, 0, 1, 0, 0, 0, 0, 1;

  RelativePose best;
  for (int solution = 0; solution < 4; ++solution) {
    Pose pose;
    pose.rotation =
        Eigen::Quaterniond(Eigen::Matrix3d(u * (solution & 1 ? w.transpose() : w) * v.transpose()));
    pose.translation = u.col(2) * (solution & 2 ? -1 : 1);
    int count = 0;
    std::vector<double> angles;
    for (size_t i = 0; i < first.size(); ++i) {
      if (SampsonSquared(essential, first[i], second[i]) > max_error * max_error) continue;
      const auto point = TriangulateTwoRays(first[i], second[i], pose);
      if (!point) continue;
      ++count;
      const Eigen::Vector3d ray = *point - pose.Center();
      angles.push_back(std::atan2(point->cross(ray).norm(), point->dot(ray)));
    }
    if (count <= best.num_inliers) continue;
    best = {pose, count, *Median(std::move(angles))};
  }
  if (best.num_inliers < 8) return std::nullopt;
  return best;
}

int CountRotationInliers(const std::vector<Eigen::Vector2d>& first,
                         const std::vector<Eigen::Vector2d>& second, double max_error, int seed) {
  constexpr int kRounds = 200;
  assert(first.size() == second.size());
  const int count = static_cast<int>(first.size());
  if (count < 2) return 0;
  std::vector<Eigen::Vector3d> a(count);
  std::vector<Eigen::Vector3d> b(count);
  for (int i = 0; i < count; ++i) {
    a[i] = first[i].homogeneous().normalized();
    b[i] = second[i].homogeneous().normalized();
  }
  const auto inliers_of = [&](const Eigen::Matrix3d& rotation) {
    std::vector<int> inliers;
    for (int i = 0; i < count; ++i) {
      if ((rotation * a[i]).cross(b[i]).squaredNorm() < max_error * max_error) inliers.push_back(i);
    }
    return inliers;
  };
  std::mt19937 random(seed);
  std::vector<int> best;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<int> sample = {static_cast<int>(random() % count),
                                     static_cast<int>(random() % count)};
    std::vector<int> inliers = inliers_of(Kabsch(a, b, sample));
    if (inliers.size() <= best.size()) continue;
    std::vector<int> refined = inliers_of(Kabsch(a, b, inliers));
    best = refined.size() > inliers.size() ? std::move(refined) : std::move(inliers);
  }
  return static_cast<int>(best.size());
}

}  // namespace stucco
