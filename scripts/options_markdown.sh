#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes docs/options.md from the options as the built program knows them. A test compares both.
set -eu
cd "$(dirname "$0")/.."
stucco=${1:-build/dev/cli/stucco}
"$stucco" options >docs/options.md.new
mv docs/options.md.new docs/options.md
