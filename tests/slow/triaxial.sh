#!/bin/sh
# The triaxial vesicle against Surface Evolver: our surface as 168 triangles, let go under the same three constraints (area, volume, integral of H),
# refined and let go again. Its energies must fall towards ours, and extrapolated (errors go with the area of a triangle) meet it.
set -eu
place=$(mktemp -d) && trap 'rm -rf "$place"' EXIT
cd "$place"
"$2/vesica" run "$1/problems/vesicle/triaxial.yaml" --out t --progress none >run.txt 2>&1
"$2/vesica" export t --to off --grid 4x12 --out mesh >mesh.txt 2>&1
awk -f "$1/tests/slow/triaxial.awk" nu=0.9 m=1.04 mesh/t.off >t.fe
cat >script <<'END'
tell := { printf "level %d %.8f %.8f %.8f %.8f\n", facet_count, bend.value/4/pi, ar.value/4/pi, mc.value/4/pi, body[1].volume*3/4/pi; }
{u; V; u; V; g 10} 5; {hessian_seek} 2; tell
r; {u; V; g 20} 8; {hessian_seek} 6; tell
r; {u; V; g 20} 8; {hessian_seek} 8; tell
r; {u; V; g 20} 8; {hessian_seek} 8; tell
q
q
END
evolver -x t.fe <script >evolver.txt 2>&1 || true
awk -v ours="$(sed -n 's/.*"objective":\([^,]*\),.*/\1/p' t/result.json | head -n 1)" '
  $1 == "level" {
    for (k = 4; k <= 6; k++) off += ($k - (k == 4 ? 1 : k == 5 ? 1.04 : 0.9))^2
    e[++n] = $3; print $2, "triangles:", $3
  }
  END {
    limit = e[4] - (e[3] - e[4]) / 3
    printf "extrapolated: %.7f ours: %.7f\n", limit, ours
    if (n != 4 || off > 1e-12 || ours < 1) exit 1
    for (k = 1; k <= 4; k++) if (e[k] < ours || (k > 1 && e[k] > e[k - 1])) exit 1
    if (limit > ours * (1 + 3e-5) || limit < ours * (1 - 3e-5)) exit 1
  }' evolver.txt || { cat evolver.txt; exit 1; }
