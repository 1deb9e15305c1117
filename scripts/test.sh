#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Everything that must hold before a change is accepted, cheapest first: packages, checkers of file
# formats where npm is there, formatting, build with warnings as errors, every exported header compiled
# by itself, clang-tidy on what changed where it is installed, all tests. CTest's summary is the last
# thing printed and its exit code is this script's.
set -eu
cd "$(dirname "$0")/.."
scripts/setup.sh
scripts/install_checkers.sh
scripts/check_format.sh
scripts/build.sh dev all all_verify_interface_header_sets
scripts/slowest_units.py build/dev/.ninja_log
scripts/tidy.sh
exec ctest --preset dev
