#!/bin/sh
# Fuzzes every target for some minutes with libFuzzer under ASan and UBSan; for the night.
# usage: fuzz.sh [SECONDS_PER_TARGET [TARGET...]]
# New inputs are gathered in build/fuzz/corpus; what was found is kept in build/fuzz/found, and the exit code is then 1.
set -eu
cd "$(dirname "$0")/.."
seconds=${1:-300}
[ $# -eq 0 ] || shift
command -v clang++ >/dev/null || { echo "fuzzing needs clang: apt-get install clang" >&2; exit 1; }
# One instruction set, the best of this machine, since clang takes minutes for each; the ordinary tests run all.
cmake -G Ninja -S . -B build/fuzz -DCMAKE_CXX_COMPILER=clang++ -DBOXWOOD_FUZZ=ON -DBOXWOOD_UNITY=ON -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS_DEBUG="-O1 -march=native -DHWY_COMPILE_ONLY_STATIC" -DBOXWOOD_APPS=OFF -DBOXWOOD_EXAMPLES=OFF -DBOXWOOD_PYTHON=OFF -DBOXWOOD_WITH_EMBREE=OFF >/dev/null
cmake --build build/fuzz --target fuzz
targets=${*:-$(ls tests/fuzz/corpus)}
status=0
for target in $targets; do
  gathered=build/fuzz/corpus/$target
  mkdir -p "$gathered" build/fuzz/found
  echo "== $target"
  BOXWOOD_FUZZ_TARGET=$target build/fuzz/tests/fuzz -max_total_time="$seconds" -timeout=20 -rss_limit_mb=3000 -malloc_limit_mb=1500 \
    -max_len=8192 -print_final_stats=1 -verbosity=0 -artifact_prefix="build/fuzz/found/$target-" "$gathered" "tests/fuzz/corpus/$target" || status=1
done
exit $status
