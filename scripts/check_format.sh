#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Lists the tracked C++ files that clang-format would change; with --fix it formats them.
set -euo pipefail

usage="usage: ${0##*/} [--fix]"
if (($# > 1)) || [[ ${1:---fix} != --fix ]]; then
  echo "$usage" >&2
  exit 2
fi

cd "$(dirname "$0")/.."
formatter=${CLANG_FORMAT:-clang-format}
if ! command -v "$formatter" >/dev/null; then
  echo "$formatter is not installed (Debian package clang-format); CLANG_FORMAT names another" >&2
  exit 2
fi

mapfile -d '' -t tracked < <(git ls-files -z -- '*.h' '*.cpp')
files=()
for file in "${tracked[@]}"; do
  # A file that was deleted but not yet committed is still tracked.
  [[ -f $file ]] && files+=("$file")
done
((${#files[@]} > 0)) || { echo "no tracked .h or .cpp files" >&2; exit 2; }

if [[ ${1:-} == --fix ]]; then
  "$formatter" -i "${files[@]}"
  exit 0
fi

offenders=()
for file in "${files[@]}"; do
  "$formatter" --dry-run -Werror "$file" 2>/dev/null || offenders+=("$file")
done
if ((${#offenders[@]} > 0)); then
  printf '%s\n' "${offenders[@]}"
  echo "${#offenders[@]} of ${#files[@]} files are not formatted; $0 --fix formats them" >&2
  exit 1
fi
echo "${#files[@]} files are formatted."
