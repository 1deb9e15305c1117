#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Calibrates the same photos with COLMAP (CPU SIFT, one shared camera, defaults otherwise) and with
# Stucco at the same image size, and measures both against the true cameras.
#
#   bench/compare_colmap.sh SET [--size PX] [--known] [--out DIR] [--stucco PROGRAM]
#
# SET holds images/ and gt_dense_cameras/ (Strecha's format) or truth/ (a COLMAP text model) beside
# photos/. With --known both are given the camera matrix of the first true camera and hold it.
# Results stay in DIR; a second call with the same DIR measures again only what was deleted there.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
stucco=$here/../build/dev/cli/stucco
size=1600
known=
out=
set_dir=
while [ $# -gt 0 ]; do
  case $1 in
    --size) size=$2; shift ;;
    --out) out=$2; shift ;;
    --stucco) stucco=$2; shift ;;
    --known) known=yes ;;
    -*) echo "compare_colmap: unknown option $1" >&2; exit 2 ;;
    *) set_dir=$(cd "$1" && pwd) ;;
  esac
  shift
done
[ -n "$set_dir" ] || { sed -n '4,11s/^# \{0,1\}//p' "$0" >&2; exit 2; }

photos=$set_dir/images
truth=$set_dir/gt_dense_cameras
[ -d "$photos" ] || photos=$set_dir/photos
[ -d "$truth" ] || truth=$set_dir/truth
[ -n "$out" ] || out=$here/../build/bench/$(basename "$set_dir")-$size${known:+-known}
mkdir -p "$out"
out=$(cd "$out" && pwd)
export QT_QPA_PLATFORM=offscreen

matrix=
if [ -n "$known" ]; then
  first=$(find "$truth" -name '*.camera' | sort | head -n 1)
  [ -n "$first" ] || { echo "compare_colmap: --known needs *.camera files" >&2; exit 2; }
  matrix=$(tr -s ' \n' ' ' <"$first" | awk '{print $1 "," $5 "," $3 "," $6}')
fi

# For a shell of its own, so that the three steps are measured as one command. It gets photos,
# folder, size and matrix as $1 to $4: pasted into the text, an apostrophe in a path would break it.
# shellcheck disable=SC2016  # that shell expands them
colmap_steps='
set -e
colmap feature_extractor --database_path "$2/db" --image_path "$1" \
  --ImageReader.single_camera 1 --SiftExtraction.use_gpu 0 --SiftExtraction.max_image_size "$3" \
  ${4:+--ImageReader.camera_model PINHOLE --ImageReader.camera_params "$4"}
colmap exhaustive_matcher --database_path "$2/db" --SiftMatching.use_gpu 0
colmap mapper --database_path "$2/db" --image_path "$1" --output_path "$2/sparse" \
  ${4:+--Mapper.ba_refine_focal_length 0 --Mapper.ba_refine_principal_point 0 \
  --Mapper.ba_refine_extra_params 0}
'

run_colmap() {
  rm -rf "$out/colmap"
  mkdir -p "$out/colmap/sparse"
  "$here/measure.py" "$out/colmap.new" sh -c "$colmap_steps" colmap_steps \
    "$photos" "$out/colmap" "$size" "$matrix" >"$out/colmap/log" 2>&1
  mkdir -p "$out/colmap/text"
  colmap model_converter --input_path "$out/colmap/sparse/0" --output_path "$out/colmap/text" \
    --output_type TXT >>"$out/colmap/log" 2>&1
  mv "$out/colmap.new" "$out/colmap.json"
}

run_stucco() {
  rm -rf "$out/survey" "$out/text"
  "$stucco" init "$out/survey" --photos "$photos" >&2
  "$here/measure.py" "$out/stucco.new" "$stucco" run "$out/survey" --until calib \
    --set calib.max_image_px="$size" \
    ${known:+--set ingest.prior_camera="$matrix" --set ingest.prior_camera_fixed=true} >&2
  "$stucco" export "$out/survey" --format colmap-txt -o "$out/text" >&2
  mv "$out/stucco.new" "$out/stucco.json"
}

[ -f "$out/colmap.json" ] || run_colmap
[ -f "$out/stucco.json" ] || run_stucco

row() { # name, model folder, costs
  "$here/eval_poses.py" "$2" "$truth" --json >"$out/errors.json"
  python3 - "$1" "$out/errors.json" "$3" <<'EOF'
import json
import sys
errors, cost = (json.load(open(path)) for path in sys.argv[2:4])
print(f"| {sys.argv[1]} | {errors['posed']} / {errors['total']} "
      f"| {1000 * errors['position_mean_m']:.2f} | {1000 * errors['position_max_m']:.2f} "
      f"| {errors['rotation_mean_deg']:.4f} | {cost['wall_s']:.0f} | {cost['cpu_s']:.0f} "
      f"| {cost['peak_memory_mb']:.0f} |")
EOF
}
echo "$(basename "$set_dir") at $size px${known:+, known camera matrix held}:"
printf '| %s | %s |\n' "program | posed | position mean mm | max mm" \
  "rotation mean deg | wall s | CPU s | memory MB"
echo "| --- | --- | --- | --- | --- | --- | --- | --- |"
row "COLMAP" "$out/colmap/text" "$out/colmap.json"
row "Stucco" "$out/text" "$out/stucco.json"
