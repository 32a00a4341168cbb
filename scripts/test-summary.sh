#!/bin/sh
# usage: test-summary.sh TESTING_DIR...: adds up the JUnit files and prints the one line that says how it went.
set -eu
total=0 failed=0 skipped=0
for dir in "$@"; do
  header=$(grep -m1 -o '<testsuite [^>]*' "$dir/junit.xml" || sed -n '1,8p' "$dir/junit.xml" | tr '\n' ' ')
  count() { printf '%s' "$header" | grep -o "$1=\"[0-9]*\"" | head -n 1 | tr -dc 0-9; }
  total=$((total + $(count tests))) failed=$((failed + $(count failures))) skipped=$((skipped + $(count skipped) + $(count disabled)))
done
echo "$((total - failed - skipped)) passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
