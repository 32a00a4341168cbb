#!/bin/sh
# Makes a small report and looks at it in Chromium. usage: run.sh BOXWOOD WORK_FOLDER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
boxwood=$1
work=$2
for tool in node npm chromium; do
  command -v "$tool" >/dev/null || { echo "the browser test needs $tool: run 'make deps'" >&2; exit 1; }
done
mkdir -p "$work"
cp "$here/package.json" "$here/package-lock.json" "$here/report_test.js" "$work"
cd "$work"
[ -d node_modules/playwright-core ] || npm ci --silent --no-audit --no-fund
rm -rf study report.html
"$boxwood" study "$here/small.toml" --out study >/dev/null
"$boxwood" report study/store.sqlite -o report.html >/dev/null
exec node --test report_test.js
