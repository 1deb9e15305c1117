// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/internal/costs.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

// Compares a cost's Jacobians with central differences of its residuals.
void CheckJacobians(const ceres::CostFunction& cost, std::vector<std::vector<double>> blocks,
                    double tolerance) {
  const int rows = cost.num_residuals();
  std::vector<const double*> pointers;
  std::vector<std::vector<double>> jacobians;
  std::vector<double*> jacobian_pointers;
  for (const auto& block : blocks) jacobians.emplace_back(rows * block.size());
  for (size_t b = 0; b < blocks.size(); ++b) {
    pointers.push_back(blocks[b].data());
    jacobian_pointers.push_back(jacobians[b].data());
  }
  std::vector<double> residuals(rows), plus(rows), minus(rows);
  ASSERT_TRUE(cost.Evaluate(pointers.data(), residuals.data(), jacobian_pointers.data()));
  for (size_t b = 0; b < blocks.size(); ++b) {
    for (size_t i = 0; i < blocks[b].size(); ++i) {
      const double value = blocks[b][i];
      const double step = 1e-6 * std::max(1.0, std::abs(value));
      blocks[b][i] = value + step;
      ASSERT_TRUE(cost.Evaluate(pointers.data(), plus.data(), nullptr));
      blocks[b][i] = value - step;
      ASSERT_TRUE(cost.Evaluate(pointers.data(), minus.data(), nullptr));
      blocks[b][i] = value;
      for (int r = 0; r < rows; ++r) {
        const double numeric = (plus[r] - minus[r]) / (2 * step);
        EXPECT_NEAR(jacobians[b][r * blocks[b].size() + i], numeric,
                    tolerance * std::max(1.0, std::abs(numeric)))
            << "block " << b << ", parameter " << i << ", residual " << r;
      }
    }
  }
}

const Eigen::Quaterniond kRotation(Eigen::AngleAxisd(0.4,
                                                     Eigen::Vector3d(1, -2, 0.5).normalized()));
const Eigen::Vector3d kTranslation(0.3, -0.2, 6);
const Eigen::Vector3d kPoint(0.9, 0.7, 1.5);

std::vector<double> AsVector(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
const std::vector<double> kPose = {kRotation.x(),   kRotation.y(),    kRotation.z(),
                                   kRotation.w(),   kTranslation.x(), kTranslation.y(),
                                   kTranslation.z()};

template <int kNumParams>
void CheckReprojection(CameraModel model) {
  const Camera camera = MadeCamera(model);
  const Eigen::Vector2d pixel = *camera.Project(kRotation * kPoint + kTranslation);
  const ReprojectionCost<kNumParams> cost(pixel - Eigen::Vector2d(3, -1), 2.0);
  const double* blocks[] = {camera.params.data(), kPose.data(), kPoint.data()};
  double residual[2];
  ASSERT_TRUE(cost.Evaluate(blocks, residual, nullptr));
  EXPECT_NEAR(residual[0], 1.5, 1e-10);
  EXPECT_NEAR(residual[1], -0.5, 1e-10);
  CheckJacobians(cost, {camera.params, kPose, AsVector(kPoint)}, 1e-5);

  const Eigen::Vector3d behind(0, 0, -30);
  blocks[2] = behind.data();
  EXPECT_FALSE(cost.Evaluate(blocks, residual, nullptr));
}

TEST(ReprojectionCost, IsRightForPinhole) {
  CheckReprojection<4>(CameraModel::kPinhole);
}
TEST(ReprojectionCost, IsRightForOpenCv) {
  CheckReprojection<8>(CameraModel::kOpenCv);
}
TEST(ReprojectionCost, IsRightForFullOpenCv) {
  CheckReprojection<12>(CameraModel::kFullOpenCv);
}

template <int kNumParams>
void CheckDistortion(CameraModel model) {
  const Camera camera = MadeCamera(model);
  for (double x = -0.6; x < 0.61; x += 0.15) {
    for (double y = -0.45; y < 0.46; y += 0.15) {
      const Eigen::Vector2d pixel = DistortRay<kNumParams>(camera.params.data(), x, y, nullptr);
      const Eigen::Vector2d expected = camera.Distort({x, y});
      EXPECT_NEAR(pixel[0], expected.x(), 1e-9);
      EXPECT_NEAR(pixel[1], expected.y(), 1e-9);
    }
  }
}

TEST(DistortRay, EqualsTheCameraOfSurvey) {
  CheckDistortion<4>(CameraModel::kPinhole);
  CheckDistortion<8>(CameraModel::kOpenCv);
  CheckDistortion<12>(CameraModel::kFullOpenCv);
}

TEST(PositionCost, MeasuresTheCentreInStandardDeviations) {
  const Pose pose{kRotation, kTranslation};
  const Eigen::Vector3d measured = pose.Center() - Eigen::Vector3d(0.2, -0.4, 3);
  const std::unique_ptr<ceres::CostFunction> cost(PositionCost::Create(measured, {0.1, 0.2, 1.5}));
  const double* blocks[] = {kPose.data()};
  double residual[3];
  ASSERT_TRUE(cost->Evaluate(blocks, residual, nullptr));
  EXPECT_NEAR(residual[0], 2, 1e-9);
  EXPECT_NEAR(residual[1], -2, 1e-9);
  EXPECT_NEAR(residual[2], 2, 1e-9);
  CheckJacobians(*cost, {kPose}, 1e-6);
}

template <int kNumParams>
void CheckPrior(CameraModel model) {
  const Camera camera = MadeCamera(model);
  auto* functor = new IntrinsicsPriorCost<kNumParams>;
  functor->expected.setZero();
  functor->inverse_sigma.setConstant(0.5);
  functor->inverse_sigma[2] = 0;
  functor->inverse_aspect_sigma = 100;
  functor->aspect = 1;
  const ceres::AutoDiffCostFunction<IntrinsicsPriorCost<kNumParams>, kNumParams + 1, kNumParams>
      cost(functor);
  const double* blocks[] = {camera.params.data()};
  std::vector<double> residuals(kNumParams + 1);
  ASSERT_TRUE(cost.Evaluate(blocks, residuals.data(), nullptr));
  EXPECT_NEAR(residuals[0], 500, 1e-9);
  EXPECT_EQ(residuals[2], 0);
  EXPECT_NEAR(residuals[kNumParams], 0.1, 1e-9);
  CheckJacobians(cost, {camera.params}, 1e-6);
}

TEST(IntrinsicsPriorCost, IsRight) {
  CheckPrior<4>(CameraModel::kPinhole);
  CheckPrior<8>(CameraModel::kOpenCv);
  CheckPrior<12>(CameraModel::kFullOpenCv);
}

}  // namespace
}  // namespace stucco::test
