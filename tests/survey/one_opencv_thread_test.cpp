// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/one_opencv_thread.h"

#include <gtest/gtest.h>

#include <opencv2/core/utility.hpp>

namespace stucco::test {
namespace {

TEST(OneOpenCvThread, GivesTheOthersBack) {
  const int before = cv::getNumThreads();
  cv::setNumThreads(3);
  {
    const OneOpenCvThread outer;
    EXPECT_EQ(cv::getNumThreads(), 1);
    {
      const OneOpenCvThread inner;
      EXPECT_EQ(cv::getNumThreads(), 1);
    }
    EXPECT_EQ(cv::getNumThreads(), 1);
  }
  EXPECT_EQ(cv::getNumThreads(), 3);
  cv::setNumThreads(before);
}

}  // namespace
}  // namespace stucco::test
