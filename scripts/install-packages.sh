#!/bin/sh
# Installs the Debian 12 packages that Boxwood builds and runs with, if any is missing. Needs root only then.
set -eu
packages="g++ cmake make ninja-build ccache mold
libtbb-dev libfmt-dev libhwy-dev libeigen3-dev libassimp-dev nlohmann-json3-dev libcli11-dev libstb-dev libtinyexr-dev libembree-dev
libglfw3-dev libimgui-dev libgl-dev xvfb libgl1-mesa-dri xdotool
libboost-math-dev libsqlite3-dev libtoml11-dev libgtest-dev libbenchmark-dev zlib1g-dev
chromium nodejs npm
glmark2-data"
if [ "${1:-}" = --lint ]; then packages="$packages clang-format clang-tidy"; fi

missing=""
for package in $packages; do
  dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

echo "installing:$missing"
run=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "these packages are missing; as root run: apt-get install$missing" >&2; exit 1; }
  run=sudo
fi
export DEBIAN_FRONTEND=noninteractive
$run apt-get update -q >/dev/null
# shellcheck disable=SC2086
$run apt-get install -y -q --no-install-recommends $missing >/dev/null
