// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>

#include "evaluate/picture/picture_pair.h"

namespace stucco::evaluate {

// Learned perceptual similarity (Zhang, Isola, Efros, Shechtman, Wang: "The Unreasonable
// Effectiveness of Deep Features as a Perceptual Metric", 2018) by a network that the user brings,
// as an ONNX file with two inputs "in0" and "in1", each 1 x 3 x 256 x 256 (or of free height and
// width), red, green, blue from -1 to 1, and one output: the distance, or a map whose mean it is.
// One call at a time.
class Lpips {
 public:
  // Throws Error (kBadInput): no such file, no ONNX, other inputs, an output that is not finite.
  explicit Lpips(const std::filesystem::path& model);
  ~Lpips();
  Lpips(Lpips&&) noexcept;
  Lpips& operator=(Lpips&&) noexcept;

  // Mean over tiles of 256 x 256 pixels, by their pixels in the mask; what lies outside it is
  // filled from the truth in both pictures. Tiles less than half inside the mask are left out;
  // kNotMeasured where no tile is left or the picture is smaller than one.
  double Distance(const PicturePair& pair) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stucco::evaluate
