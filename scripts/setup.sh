#!/bin/sh
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what Stucco is built with (packages.txt) on Debian 12. Does nothing, and needs no network
# and no rights, when everything is there already.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
packages=$(sed 's/#.*//' "$here/packages.txt" | tr -s ' \n' ' ')

if ! command -v dpkg-query >/dev/null 2>&1; then
  echo "setup: this script knows Debian 12 only. Install the equivalents of these packages, then" >&2
  echo "setup: run scripts/build.sh: $packages" >&2
  exit 1
fi

missing=
for package in $packages; do
  state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "setup: not root and no sudo. Ask an administrator to run: apt-get install$missing" >&2
    exit 1
  fi
  as_root=sudo
fi
echo "setup: installing$missing" >&2
# Not exported: sudo drops the environment, env puts it back.
apt="$as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y"
$apt update >&2
# shellcheck disable=SC2086  # a list of words is meant
$apt install --no-install-recommends $missing >&2
