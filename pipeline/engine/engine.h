// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The front door of the engine: what programs and their verbs need of it. The engine's other
// headers are for the engine, pipeline/verbs and their tests.

#include "pipeline/engine/console.h"    // IWYU pragma: export
#include "pipeline/engine/exit_code.h"  // IWYU pragma: export
#include "pipeline/engine/platform.h"   // IWYU pragma: export
#include "pipeline/engine/resources.h"  // IWYU pragma: export
#include "pipeline/engine/run.h"        // IWYU pragma: export
#include "pipeline/engine/settings.h"   // IWYU pragma: export
#include "pipeline/engine/shell.h"      // IWYU pragma: export
#include "pipeline/engine/stages.h"     // IWYU pragma: export
#include "pipeline/engine/status.h"     // IWYU pragma: export
