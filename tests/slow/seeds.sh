#!/bin/sh
# Twenty seeds of the two curvature problems all end in the best optimum: their own `expect` lines say which. Fifty of the
# discocyte all end on the oblate branch, at its energy: the file is one descent without random numbers.
set -eu
for problem in curvature curvature-twist; do
  for seed in $(seq 1 20); do
    "$2/vesica" run "$1/problems/$problem.yaml" --seed "$seed" --no-files --progress none >/dev/null 2>&1 || {
      echo "$problem, seed $seed: an expectation does not hold" >&2
      exit 1
    }
  done
  echo "$problem: 20 of 20 seeds"
done
kinds=$(for seed in $(seq 1 50); do
  "$2/vesica" run "$1/problems/vesicle/discocyte.yaml" --seed "$seed" --no-files --progress none 2>/dev/null || echo "seed $seed failed"
done | grep -E "^  kind |failed" | sort | uniq -c | sed 's/^ *//')
echo "discocyte: $kinds"
test "$kinds" = "50   kind   oblate   start oblate"
