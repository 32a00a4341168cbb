#!/bin/sh
# usage: test-summary.sh TESTING_DIR...: adds up the JUnit files and prints the one line that says how it went.
set -eu
# count FILE NAME: the value of an attribute of the file's test suite, which ctest writes one to a line.
count() { head -n 12 "$1" | sed -n "s/^[[:space:]]*$2=\"\([0-9]*\)\".*/\1/p" | head -n 1; }
total=0 failed=0 skipped=0
for dir in "$@"; do
  file=$dir/junit.xml
  total=$((total + $(count "$file" tests)))
  failed=$((failed + $(count "$file" failures)))
  skipped=$((skipped + $(count "$file" skipped) + $(count "$file" disabled)))
done
echo "$((total - failed - skipped)) passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
