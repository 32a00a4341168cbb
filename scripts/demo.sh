#!/bin/sh
# The main job on a scanned mesh and a procedural scene: which structure traces them fastest, and what it costs.
# usage: demo.sh BOXWOOD OUTPUT_DIR
set -eu
boxwood=$1
out=$2
bunny=/usr/share/glmark2/models/bunny.obj
mkdir -p "$out"
"$boxwood" compare "$bunny" "generate:stadium" --size 512x512 --repeat 7 --images "$out" --force | tee "$out/compare.txt"
echo
"$boxwood" inspect "$bunny" -a default | tee "$out/inspect.txt"
echo
rm -rf "$out/study"  # of the last demo
"$boxwood" study demo --out "$out/study"
"$boxwood" report "$out/study/store.sqlite" -o "$out/report.html" --force >/dev/null
echo
echo "The table is in $out/compare.txt, the tree's statistics in $out/inspect.txt, renderings and heat maps are:"
ls "$out"/*.png
echo "The report, for a browser, is $out/report.html"
