// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/engine/settings.h"

namespace stucco {

// Takes what the user should know although the work can begin, and what to do about it.
using WarnUser = std::function<void(const std::string& what, const std::string& remedy)>;

// A look at all that can be known before hours of work on `stages`. Throws Error for what must stop
// the run.
using Precheck = std::function<void(const Settings& settings,
                                    const std::vector<std::string>& stages, const WarnUser& warn)>;

struct RunOptions {
  std::string until;             // last stage; empty: the table's last
  std::string from;              // first stage; those before it are taken as they are
  std::string goal;              // this stage with all that it needs, and nothing else
  bool force = false;            // run again what is up to date (with a goal: only the goal)
  std::vector<std::string> set;  // "calib.max_image_px=1600", for this run only
  int threads = 0;               // 0: as survey.toml says
  double memory_limit_gb = 0;    // 0: as survey.toml says
  std::string command = "run";   // for the lock and the event log
  Precheck precheck;             // called with the lock held; empty: nothing is looked at
};

}  // namespace stucco
