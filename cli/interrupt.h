// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/engine/engine.h"

namespace stucco {

// From here on the first SIGINT or SIGTERM only sets a flag, which the result tells of, so that the
// running work can stop between two units; a second one ends the program at once (exit code 130).
// Either way the survey can be resumed.
Platform CatchInterrupts();

}  // namespace stucco
