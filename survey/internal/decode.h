// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <string_view>

namespace stucco::internal {

// As the file has the pixels (B G R, 8 or 16 bits); empty where OpenCV cannot read it.
cv::Mat DecodeByOpenCv(std::string_view bytes);

}  // namespace stucco::internal
