#!/bin/sh
# The phase diagram of vesicles: transitions within 0.0005 and ends of branches within 0.002 of what is known of them, and
# every value of nu and c0 has a good point.
# 0.5912, 0.6511 and 0.8237: where the exact energies of tests/vesicle_exact.h cross. Oblates end where their lowest axisymmetric
# mode loses its stiffness, at 0.5104 (tests/stability.c), stomatocytes at 0.6609, by the same: its squares at 0.656, 0.658
# and 0.660, 0.0657, 0.0409 and 0.0129 (vesica stability), fall to 0 there.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$2/vesica" sweep "$1/problems/vesicle/phase.yaml" --out "$folder/phase" --progress none >"$folder/screen" 2>&1
cat "$folder/screen"

# near WHAT NUMBER WANT WITHIN
near() {
  awk -v a="$2" -v b="$3" -v d="$4" 'BEGIN { exit !(a != "" && a - b <= d && b - a <= d) }' || {
    echo "$1: $2, not $3 +- $4" >&2
    exit 1
  }
}
crossing() { sed -n "s/^  changes .*from $1, c0 = $3, .* to $2, c0 = $3, .* cross at \([0-9.]*\).*/\1/p" "$folder/screen"; }
ending() { sed -n "s/^  ends  *$1, c0 = 0, $2, followed to nu = \([0-9.]*\);.*/\1/p" "$folder/screen"; }
near "stomatocyte to oblate" "$(crossing stomatocyte oblate 0)" 0.5912 0.0005
near "oblate to prolate" "$(crossing oblate prolate 0)" 0.6511 0.0005
near "pear to prolate, c0 = 3" "$(crossing pear prolate 3)" 0.8237 0.0005
near "end of the stomatocytes" "$(ending stomatocyte up)" 0.6609 0.002
near "end of the oblates" "$(ending oblate down)" 0.5104 0.002
