#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# From nothing to a finished survey: installs what is missing, builds, runs the sample survey in
# build/demo/survey and prints the path of its report as the last line. Interrupted, it goes on
# where it was; delete build/demo to see it from the start.
set -eu
cd "$(dirname "$0")/.."
scripts/setup.sh
scripts/build.sh dev cli
stucco=build/dev/cli/stucco
survey=build/demo/survey
mkdir -p build/demo
# A copy, so that you can add and remove photos and run again without changing the repository. The
# second step makes it whole or not there at all.
[ -d build/demo/photos ] || {
  rm -rf build/demo/photos.new
  cp -r data/sample/photos build/demo/photos.new
  mv build/demo/photos.new build/demo/photos
}
[ -f "$survey/survey.toml" ] || "$stucco" init "$survey" --photos build/demo/photos >&2
"$stucco" run "$survey" >&2
echo "$PWD/$survey/report/report.html"
