#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# From nothing to a finished survey: installs what is missing, builds, makes a hamlet, plans its
# survey, flies it with a virtual drone, reconstructs it, measures the result against the truth and
# prints the path of the report as the last line. Interrupted, it goes on where it was; delete
# build/demo to see it from the start.
set -eu
cd "$(dirname "$0")/.."
scripts/setup.sh
scripts/build.sh dev cli
stucco=build/dev/cli/stucco
demo=build/demo
survey=$demo/survey
mkdir -p "$demo"
if [ ! -f "$demo/scene/scene.json" ]; then # written last
  rm -rf "$demo/scene"
  "$stucco" simulate city -o "$demo/scene" --style hamlet >&2
fi
# A small camera, and few pairs and small pictures below: ten minutes instead of hours.
[ -f "$survey/plan/plan.json" ] || "$stucco" plan "$demo/scene/map.geojson" -o "$survey" \
  --camera 17.3x13mm,12.29mm,1000x750 --gsd 0.05 --altitude 25 >&2
"$stucco" simulate "$demo/scene" "$survey" -o "$survey" --held-out 4 >&2
"$stucco" run "$survey" --set calib.exhaustive_below=30 --set calib.neighbours=12 \
  --set calib.max_features=5000 --set dense.max_sources=4 --set dense.max_image_px=640 >&2
"$stucco" evaluate "$survey" --truth "$demo/scene" >&2
report=$PWD/$survey/report/report.html
if [ -n "${DISPLAY:-}" ] && command -v xdg-open > /dev/null; then
  xdg-open "$report" > /dev/null 2>&1 &
fi
echo "$report"
