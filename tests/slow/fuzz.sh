#!/bin/sh
# Ten minutes of the reader's fuzz target under sanitizers.
set -eu
build=$1/build/sanitize
[ -x "$build/fuzz_problem" ] || { echo "build the preset sanitize first" && exit 1; }
exec sh "$1/src/setup/sanitized.sh" "$build" "$build/fuzz_problem" 600
