#!/bin/sh
# sanitized.sh BUILD PROGRAM [ARGUMENT...]: runs a program built with sanitizers and fails when it or any of its children
# reported anything, a leak included. (Criterion's test processes answer before the leak check runs, so a leak alone would pass.)
set -u
logs=$(mktemp -d "$1/sanitizer.XXXXXX") || exit 1
shift
common=log_path=$logs/report:allocator_may_return_null=1
ASAN_OPTIONS=$common:${ASAN_OPTIONS:-} UBSAN_OPTIONS=$common:print_stacktrace=1:${UBSAN_OPTIONS:-} "$@"
code=$?
for report in "$logs"/*; do
  [ -e "$report" ] || continue
  cat "$report" && code=1
done
rm -rf "$logs"
exit "$code"
