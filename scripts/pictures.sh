#!/bin/sh
# The pictures of the README: a scanned bunny, and what tracing it costs in two structures, in one scale.
# usage: pictures.sh BOXWOOD OUTPUT_DIR
set -eu
boxwood=$1
out=$2
bunny=/usr/share/glmark2/models/bunny.obj
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$boxwood" render "$bunny" --integrator ao --spp 32 --size 320x320 -o "$work/ao.png"
"$boxwood" compare "$bunny" -a "median > binary" -a default --rays primary --repeat 1 --size 320x320 --images "$work" >/dev/null
mv "$work/ao.png" "$out/bunny.png"
mv "$work"/bunny-heat-01-*.png "$out/bunny-median.png"
mv "$work"/bunny-heat-02-*.png "$out/bunny-default.png"
