// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/position_witnesses.h"

namespace stucco {

std::vector<bool> PositionWitnesses(const std::vector<PoseRecord>& records, const Scene& scene) {
  std::vector<bool> tells(records.size());
  for (size_t i = 0; i < records.size(); ++i) {
    tells[i] = scene.photos[i].pose && records[i].position && !records[i].may_be_bays_off;
  }
  return tells;
}

}  // namespace stucco
