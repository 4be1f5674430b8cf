#!/bin/sh
# Vesicles beside Surface Evolver: at each of its three levels ours has less excess over the exact energy, and what it measures of our surface, as
# triangles, converges to what we measure. Times are printed, not judged.
set -eu
python3 "$1/bench/peers/evolver/compare.py" "$2" --repeats 1 --check
