#!/bin/sh
# usage: lint.sh BUILD_DIR. Fails on a source that clang-format would change or that clang-tidy complains about.
set -eu
git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run -Werror
git ls-files 'src/*.cpp' 'apps/*.cpp' | xargs -P "$(nproc)" -n 4 clang-tidy -p "$1" --quiet 2>/dev/null
