// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace stucco {

// From here on the first SIGINT or SIGTERM only sets a flag, so that the running stage can stop
// between two units; a second one ends the program at once (exit code 130). Either way the survey
// can be resumed.
void CatchInterrupts();

// True once SIGINT or SIGTERM was received.
bool Interrupted();

// For tests: as if no signal had come, or as if one had.
void SetInterrupted(bool interrupted);

}  // namespace stucco
