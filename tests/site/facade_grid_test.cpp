// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/facade_grid.h"

#include <gtest/gtest.h>

#include "tests/site/made_site.h"

namespace stucco {
namespace {

TEST(FacadeGrid, HasCellsOfAboutASquareMetre) {
  const Site site = LoneHouse();
  const FacadeGrid grid(site.facades[0]);
  EXPECT_EQ(grid.columns, 20);
  EXPECT_EQ(grid.rows, 9);
  EXPECT_NEAR((grid.Center(0) - Eigen::Vector3d(0.5, 0, 0.5)).norm(), 0, 1e-9);
  EXPECT_NEAR((grid.Center(21) - Eigen::Vector3d(1.5, 0, 1.5)).norm(), 0, 1e-9);
  EXPECT_NEAR(grid.Along(39).to_m, 20, 1e-9);
  EXPECT_NEAR(grid.Heights(179).to_m, 9, 1e-9);
}

TEST(FacadeGrid, OfSmallAndLargeFacadesHasAFewAndNotTooManyCells) {
  Facade facade = LoneHouse().facades[0];
  facade.b = {0.4, 0};
  facade.z_m = {0, 0.5};
  EXPECT_EQ(FacadeGrid(facade).columns, 3);
  EXPECT_EQ(FacadeGrid(facade).rows, 2);
  facade.b = {300, 0};
  facade.z_m = {0, 60};
  EXPECT_LE(FacadeGrid(facade).size(), 450U);
  EXPECT_GE(FacadeGrid(facade).size(), 350U);
}

}  // namespace
}  // namespace stucco
