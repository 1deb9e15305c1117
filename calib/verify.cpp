// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/verify.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <random>

#include "calib/triangulate.h"
#include "survey/error.h"
#include "survey/median.h"

namespace stucco {
namespace {

cv::UsacParams Usac(double threshold, int seed) {
  cv::UsacParams params;
  params.confidence = 0.9999;
  params.maxIterations = 10000;
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
  std::vector<Eigen::Vector2d> a;
  std::vector<Eigen::Vector2d> b;
  for (const Match& match : matches) {
    a.push_back(first[match.first]);
    b.push_back(second[match.second]);
  }
  const auto cv_a = ToOpenCv(a);
  const auto cv_b = ToOpenCv(b);
  const cv::UsacParams params = Usac(options.max_error_px, options.seed);
  cv::Mat mask;
  PairGeometry pair;
  const cv::Mat f = cv::findFundamentalMat(cv_a, cv_b, mask, params);
  const cv::Mat h = cv::findHomography(cv_a, cv_b, mask, params);
  const double limit = options.max_error_px * options.max_error_px;
  std::vector<char> by_f(matches.size(), 0);
  std::vector<char> by_h(matches.size(), 0);
  if (f.rows == 3) {
    pair.fundamental = ToEigen(f);
    for (size_t i = 0; i < a.size(); ++i)
      by_f[i] = SampsonSquared(pair.fundamental, a[i], b[i]) < limit;
  }
  if (h.rows == 3) {
    const Eigen::Matrix3d homography = ToEigen(h);
    for (size_t i = 0; i < a.size(); ++i) by_h[i] = TransferSquared(homography, a[i], b[i]) < limit;
  }
  pair.num_fundamental = static_cast<int>(std::count(by_f.begin(), by_f.end(), 1));
  pair.num_homography = static_cast<int>(std::count(by_h.begin(), by_h.end(), 1));
  if (std::max(pair.num_fundamental, pair.num_homography) < options.min_inliers)
    return std::nullopt;
  for (size_t i = 0; i < matches.size(); ++i) {
    if (by_f[i] || by_h[i]) pair.inliers.push_back(matches[i]);
  }
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
  // OpenCV's USAC works in pixels: an arbitrary focal length keeps its thresholds in a sane range.
  constexpr double kFocal = 1000;
  const cv::Mat k = (cv::Mat_<double>(3, 3) << kFocal, 0, 0, 0, kFocal, 0, 0, 0, 1);
  std::vector<Eigen::Vector2d> a(first.size());
  std::vector<Eigen::Vector2d> b(second.size());
  for (size_t i = 0; i < first.size(); ++i) {
    a[i] = first[i] * kFocal;
    b[i] = second[i] * kFocal;
  }
  cv::Mat mask;
  const cv::Mat e = cv::findEssentialMat(ToOpenCv(a), ToOpenCv(b), k, k, cv::noArray(),
                                         cv::noArray(), mask, Usac(max_error * kFocal, 0));
  if (e.rows != 3) return std::nullopt;
  const Eigen::Matrix3d essential = ToEigen(e);
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
