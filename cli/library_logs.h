// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace stucco {

// Keeps what Ceres (through glog) and OpenCV log about their inner workings off standard error.
// What matters of it reaches the user through the stages.
void SilenceLibraryLogs();

}  // namespace stucco
