#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Configures and builds a preset (dev unless named): scripts/build.sh [PRESET] [TARGET...]
# In a build folder that it makes, eight sources of a folder are compiled as one: from nothing that
# takes half the time. To compile each alone, which is quicker from change to change, configure
# first: cmake --preset dev
set -eu
cd "$(dirname "$0")/.."
preset=${1:-dev}
[ $# -eq 0 ] || shift
launcher=
if command -v ccache >/dev/null 2>&1; then
  launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache
  # What it asks for before it caches units that use precompiled headers, besides what is set.
  CCACHE_SLOPPINESS="pch_defines,time_macros,$(ccache --get-config sloppiness)"
  export CCACHE_SLOPPINESS
  export CCACHE_PCH_EXTSUM=1
  # By the compiler's list of headers instead of a preprocessor run of its own before each unit.
  export CCACHE_DEPEND=1
fi
together=
[ -f "build/$preset/CMakeCache.txt" ] || together=-DCMAKE_UNITY_BUILD=ON
cmake --preset "$preset" $launcher $together >&2
cmake --build --preset "$preset" ${1:+--target "$@"} >&2
