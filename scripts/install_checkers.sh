#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs official checkers of file formats from npm into build/checkers, for tests that skip without
# them. Does nothing when they are there, or where there is no npm or no network.
set -eu
cd "$(dirname "$0")/.."
validator=gltf-validator@2.0.0-dev.3.10 # Khronos, Apache-2.0
if [ -d build/checkers/node_modules/gltf-validator ]; then exit 0; fi
if ! command -v npm >/dev/null 2>&1; then
  echo "install_checkers: no npm: tests with the Khronos validator will be skipped" >&2
  exit 0
fi
mkdir -p build/checkers
if ! timeout 120 npm install --prefix build/checkers --no-save --no-package-lock --no-audit --no-fund \
    --ignore-scripts "$validator" >build/checkers/npm.log 2>&1; then
  echo "install_checkers: npm failed (build/checkers/npm.log): tests with $validator are skipped" >&2
fi
