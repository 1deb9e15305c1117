// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/library_logs.h"

#include <glog/logging.h>

#include <opencv2/core/utils/logger.hpp>

namespace stucco {

void SilenceLibraryLogs() {
  FLAGS_minloglevel = google::GLOG_FATAL;
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

}  // namespace stucco
