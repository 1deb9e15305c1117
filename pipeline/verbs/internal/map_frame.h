// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "survey/georef.h"
#include "survey/reconstruction.h"

namespace stucco {

// Takes a model from a map (ExchangedModel::crs) into the frame east, north, up of the mean of its
// cameras, and says where that is. Points and cameras are moved one by one, so that scale and
// convergence of the map leave nothing behind; heights stay as they are, whatever they count from.
// Throws Error (kBadInput), which names `file`, where PROJ does not know the map or a camera is
// beyond it.
Georef MoveFromMap(const std::string& crs, const std::string& file, Reconstruction& model);

// Takes points east, north and high in `crs`, in its units, into the frame of a georef ("enu").
// Heights stay as they are, whatever they count from. Throws Error (kBadInput), which names `file`,
// where PROJ does not know the system or a point has no place in it.
void MovePointsFromMap(const std::string& crs, const std::string& file, const Georef& georef,
                       std::span<Eigen::Vector3d> points);

}  // namespace stucco
