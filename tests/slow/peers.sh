#!/bin/sh
# What vesica writes, opened by other programs: VTP by VTK, STL by a reader that looks for open edges.
set -eu # Debian's own python3: the one that python3-vtk9 is for
place=$(mktemp -d) && trap 'rm -rf "$place"' EXIT
for problem in bottle curvature surfaces/cup; do
  mkdir -p "$place/$problem"
  "$2/vesica" export "$1/problems/$problem.yaml" --to vtp,stl --spines --out "$place/$problem"
  /usr/bin/python3 "$1/tests/slow/vtp.py" "$place/$problem"/*.vtp
done
/usr/bin/python3 "$1/tests/slow/stl.py" "$place/bottle"/*.stl
