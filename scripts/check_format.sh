#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Lists the C++ files (tracked ones, in a checkout) that clang-format would change; with --fix it formats them.
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

# Not every tree is a checkout (a release archive, a container's copy), and a checkout may belong to
# another user, which git refuses unless it is told.
list_sources() {
  git -c safe.directory="$PWD" ls-files -z -- '*.h' '*.cpp' 2>/dev/null ||
    find . \( -name .git -o -name build -o -name node_modules \) -prune -o \
      -type f \( -name '*.h' -o -name '*.cpp' \) -printf '%P\0'
}

mapfile -d '' -t tracked < <(list_sources)
files=()
for file in "${tracked[@]}"; do
  # A file that was deleted but not yet committed is still tracked.
  [[ -f $file ]] && files+=("$file")
done
((${#files[@]} > 0)) || { echo "no .h or .cpp files" >&2; exit 2; }

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
