// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/photo_set.h"

namespace stucco {

double FocalSigmaRatio(const CapturedCamera& camera) {
  if (camera.fixed) return 0;
  if (camera.focal_source == "option" || camera.focal_source == "dewarp") return 0.02;
  return camera.focal_source == "default" ? 0.5 : 0.1;
}

}  // namespace stucco
