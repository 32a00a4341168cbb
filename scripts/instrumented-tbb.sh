#!/bin/sh
# instrumented-tbb.sh FOLDER: oneTBB with the thread sanitizer compiled in, installed into FOLDER unless it is there. From
# the source package of the Debian release; the lists of apt on this machine stay as they are. The library that Debian
# builds hides from the sanitizer what orders its tasks, so everything that tasks hand on would be taken for a race.
set -eu
mkdir -p "$1"
folder=$(cd "$1" && pwd)
config=$folder/lib/cmake/TBB/TBBConfig.cmake
[ ! -e "$config" ] || exit 0

work=$folder/work
rm -rf "$work"
mkdir -p "$work/lists/partial" "$work/cache/archives/partial"
cd "$work"
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian $release main" > sources.list
apt() {
  apt-get -q -o APT::Sandbox::User= -o Dir::Etc::sourcelist="$work/sources.list" -o Dir::Etc::sourceparts=- \
    -o Dir::State::lists="$work/lists" -o Dir::Cache="$work/cache" "$@"
}
echo "building oneTBB for the thread sanitizer (once, a few minutes)"
if ! { apt update && apt source onetbb; } > log 2>&1; then
  cat log >&2
  echo "the source package onetbb did not come from deb.debian.org: check the network, then run this again" >&2
  exit 1
fi
# Not its allocator: memory that moves between threads through an allocator unknown to the sanitizer looks like a race, too.
if ! { cmake -G Ninja -S onetbb-*/ -B build -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_SANITIZE=thread -DTBB_TEST=OFF \
         -DTBB_STRICT=OFF -DTBB_ENABLE_IPO=OFF -DTBBMALLOC_BUILD=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON \
         -DCMAKE_INSTALL_PREFIX="$folder" -DCMAKE_INSTALL_LIBDIR=lib &&
       cmake --build build && cmake --install build; } > log 2>&1; then
  tail -40 log >&2
  exit 1
fi
rm -rf "$work"
