// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/one_opencv_thread.h"

#include <opencv2/core/utility.hpp>

namespace stucco {

OneOpenCvThread::OneOpenCvThread() : before_(cv::getNumThreads()) {
  cv::setNumThreads(1);
}

OneOpenCvThread::~OneOpenCvThread() {
  cv::setNumThreads(before_);
}

}  // namespace stucco
