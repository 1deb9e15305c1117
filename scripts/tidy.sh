#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs clang-tidy on the sources that changed, the newest first: what is not committed, then what was
# committed since the branch left its upstream or, where nothing is ahead of it (a fresh clone), in
# the last commits; of a changed header the sources of its name. With --all on every source. Where
# clang-tidy is not installed (Debian package clang-tidy), it says so and is done.
set -euo pipefail
cd "$(dirname "$0")/.."
readonly most=40 # about five minutes on two cores
readonly last_commits=50 # a landing, as a rule
modules=$(ls -d */CMakeLists.txt | sed 's,/.*,,' | grep -vx tests | paste -sd '|')
readonly modules

usage="usage: ${0##*/} [--all]"
if (($# > 1)) || [[ ${1:---all} != --all ]]; then
  echo "$usage" >&2
  exit 2
fi
if ! command -v clang-tidy >/dev/null; then
  echo "tidy: clang-tidy is not installed; nothing was checked"
  exit 0
fi

git_here() { git -c safe.directory="$PWD" "$@"; }

changed() {
  local base commits
  base=$(git_here merge-base HEAD '@{upstream}' 2>/dev/null || true)
  commits=("$base..HEAD")
  [[ -n $base && $base != "$(git_here rev-parse HEAD)" ]] || commits=("-$last_commits" HEAD)
  git_here ls-files --others --exclude-standard
  git_here diff --name-only HEAD
  git_here log --name-only --format= "${commits[@]}"
}

sources() {
  if [[ ${1:-} == --all ]]; then
    git_here ls-files
  elif git_here rev-parse HEAD >/dev/null 2>&1; then
    changed | sed 's/\.h$/.cpp/; s,internal/,,'
  fi | grep -E "^($modules)/.*\.cpp$" | awk '!seen[$0]++' | while read -r file; do
    [[ ! -f $file ]] || echo "$file"
  done
}

mapfile -t files < <(sources "${1:-}" || true)
if ((${#files[@]} > most)) && [[ ${1:-} != --all ]]; then
  echo "tidy: ${#files[@]} sources changed; the newest $most are checked, scripts/tidy.sh --all checks all"
  files=("${files[@]:0:most}")
fi
((${#files[@]} > 0)) || { echo "tidy: no source changed"; exit 0; }
# Each source alone, without precompiled headers, which are GCC's: so it also finds a header that a
# source forgot.
cmake --preset dev -B build/tidy -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_UNITY_BUILD=OFF >/dev/null
sed -i 's/ -fpch-preprocess//' build/tidy/compile_commands.json
# GCC's own warning options mean nothing to clang.
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" \
  clang-tidy --quiet -p build/tidy --extra-arg=-Wno-unknown-warning-option 2>/dev/null
echo "tidy: ${#files[@]} sources are clean"
