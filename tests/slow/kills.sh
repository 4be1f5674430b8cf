#!/bin/sh
# A hundred kills at random moments: a run that is killed and resumed until it is done leaves the same bytes as one
# that nobody touched, whatever the number of threads of each life.
set -eu
vesica=$2/vesica kills=0 runs=0 fail= seed=${3:-1}
work=$(mktemp -d "$2/kills.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
problem=$1/problems/curvature.yaml

# A whole number from 1 to $1.
random() {
  seed=$(((seed * 1103515245 + 12345) % 2147483648))
  number=$((seed / 65536 % $1 + 1))
}

begin=$(date +%s%N)
"$vesica" run "$problem" --evaluations 400000 --jobs 2 --out whole --progress none >out 2>err
whole=$((($(date +%s%N) - begin) / 1000000)) # ms: lives are shorter at first, then longer, so that a run comes to its end
while [ "$kills" -lt 100 ]; do
  runs=$((runs + 1))
  code=137 lives=0
  set -- "$problem" --evaluations 400000 --out "run$runs"
  while [ "$code" != 0 ]; do
    random 3
    jobs=$number
    random 1000
    life=$((number * whole * (12 + lives) / 20000 + 1))
    lives=$((lives + 1)) code=0
    timeout -s KILL "$(printf '%d.%03d' $((life / 1000)) $((life % 1000)))" "$vesica" run "$@" --jobs "$jobs" --progress none >out 2>err || code=$?
    case $code in
    0) ;;
    137) kills=$((kills + 1)) ;;
    2) grep -q 'wait until it is done' err && sleep 0.1 || fail=1 ;; # the last life is not quite over
    *) fail=1 ;;
    esac
    [ -z "$fail" ] || { cat err >&2 && echo "run $runs: exit $code after $kills kills" >&2 && exit 1; }
    [ ! -f "run$runs/run.json" ] || set -- --resume "run$runs"
    [ -f "run$runs/run.json" ] || rm -rf "run$runs" # killed before it had begun
  done
  for file in result.json trace.jsonl journal problem.yaml run.json best.vtp; do
    cmp "whole/$file" "run$runs/$file"
  done
  left=$(ls -A "run$runs" | grep -v -x -e 'best\..*' -e start.vtp -e '.*\.json' -e trace.jsonl -e journal -e problem.yaml -e log.txt || true)
  [ -z "$left" ] || { echo "run $runs left $left" >&2 && exit 1; }
done
echo "$kills kills of $runs runs: the same bytes"
