#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a photo folder from nothing to the report and prints what it cost and what came out.
#
#   bench/run_set.sh PHOTOS OUT [arguments for `stucco run`, e.g. --set calib.max_image_px=1600]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
stucco=${STUCCO:-$here/../build/dev/cli/stucco}
[ $# -ge 2 ] || { sed -n '4,6s/^# \{0,1\}//p' "$0" >&2; exit 2; }
photos=$1
out=$2
shift 2
[ ! -e "$out" ] || { echo "run_set: $out exists; a fresh run needs a fresh folder" >&2; exit 2; }
mkdir -p "$(dirname "$out")"
"$stucco" init "$out" --photos "$photos" >&2
code=0
"$here/measure.py" "$out.cost.json" "$stucco" run "$out" "$@" >&2 || code=$?
"$here/key_figures.py" "$out" "$out.cost.json"
exit $code
