#!/bin/sh
# One, two and three ranks leave the same bytes as a run alone, also where they are killed or stopped and go on with
# another number of them. Builds vesica with MPI in a folder of its own.
set -eu
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
build=$2/mpi work=$(mktemp -d "$2/ranks.XXXXXX")
trap 'rm -rf "$work"' EXIT
cmake -S "$1" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DVESICA_MPI=ON -DVESICA_TESTS=OFF -DVESICA_BENCH=OFF >/dev/null
cmake --build "$build" --target vesica >/dev/null
cd "$work"

ranks() { count=$1 && shift && mpirun --oversubscribe -n "$count" "$build/vesica" run "$@" --progress none >out 2>&1; }
same() {
  for file in result.json trace.jsonl journal problem.yaml run.json best.vtp; do cmp "$1/$file" "$2/$file"; done
  [ ! -e "$2/lock" ] && [ ! -e "$2/journal.part" ]
}

printf '%s\n' 'vesica: 1' 'variables: {R: [1.1, 3, 5]}' 'shape: {closed: true}' 'measures: {hh: {integral: "H^2"}}' \
  'minimize: hh' 'search: [{anneal: {evaluations: 400}}, {polish: {}}]' 'patches:' \
  '  t: {surface: {formula: ["(R + cos(u))*cos(v)", "(R + cos(u))*sin(v)", "sin(u)"]}, domain: {u: [0, 2*pi], v: [0, 2*pi]}}' >torus.yaml
for problem in torus.yaml "$1/problems/vesicle/book.yaml" "$1/problems/curvature.yaml"; do
  name=$(basename "$problem" .yaml)
  "$2/vesica" run "$problem" --evaluations 20000 --out "$name" --progress none >out 2>&1
  for n in 1 2 3; do
    ranks $n "$problem" --evaluations 20000 --out "$name$n"
    same "$name" "$name$n"
  done
done

"$2/vesica" run "$1/problems/curvature.yaml" --evaluations 300000 --out whole --progress none >out 2>&1
for signal in KILL TERM; do
  for n in 2 3; do
    run=$signal$n
    mpirun --oversubscribe -n $n "$build/vesica" run "$1/problems/curvature.yaml" --evaluations 300000 --out "$run" \
      --progress none >out 2>&1 &
    child=$!
    until [ "$(stat -c %s "$run/journal" 2>/dev/null || echo 0)" -gt 2000000 ]; do sleep 0.02; done
    kill -s $signal $child
    wait $child && { echo "$run: it was done before" >&2 && exit 1; } || true
    until ranks $((5 - n)) --resume "$run"; do # ranks that outlive mpirun for a moment
      grep -q 'wait until it is done' out || { cat out >&2 && exit 1; }
      sleep 0.2
    done
    same whole "$run"
  done
done
# Sweeps: the walks of one folder.
sweep() { count=$1 && shift && mpirun --oversubscribe -n "$count" "$build/vesica" sweep "$@" --progress none >out 2>&1; }
same_sweep() {
  diff -r --exclude=times.jsonl --exclude=walks "$1" "$2"
  [ ! -e "$2/lock" ] && [ ! -e "$2/helpers" ]
}
cp "$1/problems/vesicle/book.yaml" membrane.yaml
printf '%s\n' 'sweep:' '  over: {nu: {from: 0.7, to: 0.9, step: 0.02, walk: both}}' \
  '  branches: {oblate: {set: {zn: 0.5, zs: -0.5, R: 1.3}}, prolate: {set: {zn: 1.6, zs: -1.6, R: 0.7}}}' >>membrane.yaml
"$2/vesica" sweep membrane.yaml --out alone --progress none >out 2>&1
for n in 1 2 3; do
  sweep $n membrane.yaml --out together$n
  same_sweep alone together$n
done
for signal in KILL TERM; do
  for n in 2 3; do
    mpirun --oversubscribe -n $n "$build/vesica" sweep membrane.yaml --out sweep$signal$n --progress none >out 2>&1 &
    child=$!
    until [ -s "sweep$signal$n/walks/0001.jsonl" ]; do sleep 0.02; done
    kill -s $signal $child
    wait $child && { echo "sweep$signal$n: it was done before" >&2 && exit 1; } || true
    until sweep $((5 - n)) --resume "sweep$signal$n"; do
      grep -q 'wait until it is done' out || { cat out >&2 && exit 1; }
      sleep 0.2
    done
    same_sweep alone "sweep$signal$n"
  done
done

# A benchmark: the ranks share out its runs; what one process, or another number of ranks, has begun goes on.
cat >suite.yaml <<EOF
vesica: 1
suite: ranks
problems: [{function: rastrigin, n: 3, rotate: true}, {function: g05}, {file: $1/problems/bottle.yaml}]
methods: {auto: {search: auto}, nm: {nlopt: LN_NELDERMEAD}, anneal: {search: [{anneal: {}}], gradients: false}}
seeds: 4
budget: {per_dimension: 3000}
EOF
bench() { count=$1 && shift && mpirun --oversubscribe -n "$count" "$build/vesica" bench "$@" --progress none >out 2>&1; }
same_bench() {
  cmp "$1/report.json" "$2/report.json" && diff -r "$1/journals" "$2/journals" && cmp "$1/runs.jsonl" "$2/runs.jsonl"
  [ ! -e "$2/lock" ] && [ -z "$(ls "$2" | grep 'runs\.[0-9]')" ]
}
"$2/vesica" bench suite.yaml --out bench --jobs 1 >out 2>&1
for n in 1 2 3; do
  bench $n suite.yaml --out bench$n
  same_bench bench bench$n
done
for signal in KILL TERM; do
  run=bench$signal
  mpirun --oversubscribe -n 3 "$build/vesica" bench suite.yaml --out "$run" --progress none >out 2>&1 &
  child=$!
  until [ "$(cat "$run"/runs*.jsonl 2>/dev/null | wc -l)" -gt 5 ]; do sleep 0.02; done
  kill -s $signal $child
  wait $child || true
  until bench 2 --resume "$run"; do
    grep -q 'wait until it is done' out || { cat out >&2 && exit 1; }
    sleep 0.2
  done
  same_bench bench "$run"
done
# What one rank has left cannot be read when it is over: the others' lines, and its own, stay.
cat >odd.yaml <<EOF
vesica: 1
suite: odd
problems: [{function: sphere, n: 2}]
methods: {auto: {search: auto}, odd: {program: [sh, -c, "[ -e odd/was ] || mv odd/times.1.jsonl odd/was; mkdir odd/times.1.jsonl; read a; exit 3"]}}
seeds: 8
EOF
bench 2 odd.yaml --out odd && exit 1
grep -q 'cannot read "odd/times.1.jsonl"' out
[ "$(cat odd/runs.jsonl odd/runs.1.jsonl | wc -l)" -eq 16 ]
rmdir odd/times.1.jsonl && mv odd/was odd/times.1.jsonl
bench 2 --resume odd
grep -q '16 of 16 runs are there already' out
bench 2 suite.yaml --no-files && exit 1
grep -q 'not with --no-files' out
echo "1, 2 and 3 ranks: the same bytes"
