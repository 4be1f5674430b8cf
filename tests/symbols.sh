#!/bin/sh
# What a program that links vesica can collide with: every global symbol of libvesica.a begins with ves_; what the C++ of the
# bridge adds is mangled, and weak where it is a template's, so that another program's copy is as good. And every function of
# the installed headers is in the library (or inline), and called by tests/api*.c, which see nothing but those headers.
set -eu
place=$(mktemp -d) && trap 'rm -rf "$place"' EXIT
headers=$1/include/vesica
nm -g --defined-only "$2/libvesica.a" | awk 'NF == 3 {print $2, $3}' | sort -u >"$place/symbols"
# u, V, W: one for the whole program, weak objects and functions; what sanitizers add says so in its name
awk '!($2 ~ /^ves_/ || ($1 ~ /^[uVW]$/ && $2 ~ /^(DW\.ref\.)?(_Z|__gxx_)/) || $2 ~ /^(__odr_)?[at]san[._]/)' "$place/symbols" >"$place/strange"
[ ! -s "$place/strange" ] || { echo "symbols of others in libvesica.a:" && cat "$place/strange" && exit 1; }

# Declared: a name before a parenthesis that is no member and no comment. ves_try_status is a macro's.
cat "$headers"/*.h | sed 's://.*::; s:/\*.*\*/::; /^ *\/\*/,/\*\//d; /#define/d' |
  grep -oE '\<ves_[a-z0-9_]+\(' | tr -d '(' | sort -u >"$place/functions"
[ "$(wc -l <"$place/functions")" -gt 40 ] || { echo "only these functions were found:" && cat "$place/functions" && exit 1; }
status=0
while read -r name; do
  grep -qE " $name\$" "$place/symbols" || grep -qE "static inline .*\<$name\(" "$headers"/*.h ||
    { echo "$name is declared, but nowhere defined" && status=1; }
  grep -qE "\<$name\(" "$1"/tests/api*.c || { echo "$name is not called by tests/api*.c" && status=1; }
done <"$place/functions"
! grep -n '#include "' "$1"/tests/api*.c || { echo "tests/api*.c see more than the installed headers" && status=1; }
exit $status
