#!/bin/sh
# install-packages.sh [PACKAGE…]: installs the Debian 12 packages that Boxwood builds and runs with, and those named, if any
# is missing. Needs root only then.
set -eu
packages="g++ cmake make ninja-build ccache mold
libtbb-dev libfmt-dev libhwy-dev libeigen3-dev libassimp-dev nlohmann-json3-dev libcli11-dev libstb-dev libtinyexr-dev libembree-dev
libglfw3-dev libimgui-dev libgl-dev xvfb libgl1-mesa-dri xdotool
pybind11-dev python3-dev python3-numpy python3-pytest
libboost-math-dev libsqlite3-dev libtoml11-dev libgtest-dev libbenchmark-dev zlib1g-dev
chromium nodejs
glmark2-data"
# Some packages of nodejs bring npm along, and none other can then be installed.
command -v npm >/dev/null || packages="$packages npm"
packages="$packages $*"

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
