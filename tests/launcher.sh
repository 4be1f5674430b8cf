#!/bin/sh
# The launcher ./vesica, on a machine made of small scripts: what it installs, asks, builds and passes on.
set -u
source=$1
place=$(mktemp -d) && trap 'rm -rf "$place"' EXIT
root="$place/a check out" # with blanks
bin=$place/bin
mkdir -p "$root/src/setup" "$root/include" "$bin"
cp "$source/vesica" "$root" && cp "$source"/src/setup/packages*.txt "$root/src/setup"

script() { printf '#!/bin/sh\n%s\n' "$2" >"$bin/$1" && chmod +x "$bin/$1"; }
script id 'cat '"$place/uid"
script dpkg-query 'for p in "$@"; do grep -qx "$p" '"$place/lack"' || echo "ii  $p"; done'
script apt-get 'echo "apt-get $*" >>'"$place/log"'
case "$*" in
*-s*) echo "Inst libyaml-dev (0.2.5)" ;;
*install*) [ ! -f '"$place/offline"' ] || { echo "no network"; exit 100; }; : >'"$place/lack"' ;;
esac'
script apt-cache 'printf "Size: 2000000\nInstalled-Size: 7000\n"'
script sudo '[ -f '"$place/sudo"' ] && [ "$1" = -n ] && shift && echo sudo >>'"$place/log"' && exec "$@"'
script cmake 'echo "cmake $*" >>'"$place/log"' && echo noise
case "$1" in
--preset) mkdir -p build/$2 && : >build/$2/build.ninja && echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" >build/$2/CMakeCache.txt &&
  echo "${3#-D}" | sed "s/=/:BOOL=/" >>build/$2/CMakeCache.txt ;;
--build) grep -q broken "'"$root"'/src/a.c" && echo "a.c:1: error" && exit 1
  printf "#!/bin/sh\necho \"program \$*\"\nexit 7\n" >"$2/vesica" && chmod +x "$2/vesica" ;;
esac'
script ctest 'echo "ctest $*" >>'"$place/log"'; [ ! -f '"$place/failing"' ]'
PATH=$bin:$PATH && export PATH

failures=0
# launch CODE ARGUMENT...: runs ./vesica from elsewhere; output in $out and $err, what was called in $log.
launch() {
  want=$1 && shift
  : >"$place/log"
  (cd / && "$root/vesica" "$@") >"$place/out" 2>"$place/err" </dev/null
  got=$?
  out=$(cat "$place/out") err=$(cat "$place/err") log=$(cat "$place/log")
  [ "$got" = "$want" ] || bad "exit code of 'vesica $*': got $got, want $want"
}
bad() { failures=$((failures + 1)) && printf 'FAILED %s: %s\nstdout: %s\nstderr: %s\ncalled: %s\n' "$what" "$*" "$out" "$err" "$log"; }
said() { case $err in *"$1"*) ;; *) bad "wanted on stderr: $1" ;; esac; }
called() { case $log in *"$1"*) ;; *) bad "wanted a call: $1" ;; esac; }
quiet() { [ -z "$log$err" ] || bad "wanted no call and no word"; }
passed_on() { [ "$out" = "program $1" ] || bad "wanted on stdout: program $1"; }
later() { sleep 0.02 && touch "$@"; }

echo 0 >"$place/uid"
: >"$root/src/a.c" && : >"$root/CMakeLists.txt"

what='nothing there, as root'
printf 'libyaml-dev\ncmake\nlibcriterion-dev\n' >"$place/lack"
launch 7 run 'a b.yaml' --json
passed_on 'run a b.yaml --json'
called 'apt-get -q update' && called '-y install cmake libyaml-dev' && called 'cmake --preset release -DVESICA_TESTS=OFF'
called 'cmake --build' && said 'installing cmake libyaml-dev, 1 with what they need (2.0 MB to fetch, 7.0 MB on disk)' && said 'first time'

what='nothing changed'
launch 7 eval x && passed_on 'eval x' && quiet
what='through a symbolic link'
ln -s "$root/vesica" "$place/link" && ln -s link "$place/second"
out=$("$place/second" version) && bad 'the exit code was lost'
passed_on version

what='a source changed'
later "$root/src/a.c"
launch 7 help && passed_on help && called 'cmake --build' && said 'building what has changed'
launch 7 help && quiet
what='a source was deleted'
later "$root/src/b.c" && launch 7 help && sleep 0.02 && rm "$root/src/b.c"
launch 7 help && called 'cmake --build'

what='the build fails'
echo broken >"$root/src/a.c"
launch 4 help && said 'a.c:1: error' && [ -z "$out" ] || bad 'wanted nothing on stdout'
launch 4 help && said 'a.c:1: error'
echo >"$root/src/a.c" && launch 7 help

what='another processor'
later "$root/build/release/built" && echo other >"$root/build/release/built"
launch 7 help && called '--clean-first'
launch 7 help && quiet

what='a copied checkout'
cp -rp "$root" "$place/copy" && home=$root && root=$place/copy
later "$root/src/a.c" && launch 7 help && called 'cmake --preset release'
root=$home

what='a package was removed, not root, no sudo'
echo 1000 >"$place/uid" && echo libnlopt-dev >"$place/lack" && later "$root/src/a.c"
launch 3 run x
said 'missing packages: libnlopt-dev' && said 'apt-get update && apt-get install --no-install-recommends -y libnlopt-dev'
what='installed in another way'
VESICA_SETUP=skip && export VESICA_SETUP && launch 7 run x && unset VESICA_SETUP
what='sudo without a password'
: >"$place/sudo" && later "$root/src/a.c"
launch 7 run x && called 'sudo' && called '-y install libnlopt-dev'
what='no network'
echo libnlopt-dev >"$place/lack" && : >"$place/offline" && later "$root/src/a.c"
launch 3 run x && said 'no network' && said 'cannot be installed: libnlopt-dev'
rm "$place/offline" && : >"$place/lack"

what='two launches at once'
rm -rf "$root/build" && : >"$place/log"
"$root/vesica" one >"$place/one" 2>&1 &
"$root/vesica" two >"$place/two" 2>&1
wait $!
log=$(cat "$place/log")
[ "$(grep -c 'cmake --build' "$place/log")" = 1 ] || ! command -v flock >/dev/null || bad 'wanted one build'
grep -q 'program one' "$place/one" && grep -q 'program two' "$place/two" || bad 'wanted two runs'

what='the tests'
echo libcriterion-dev >"$place/lack" && launch 0 test
called '-y install libcriterion-dev' && called 'cmake --preset release -DVESICA_TESTS=ON' && called 'cmake --preset sanitize'
called 'ctest --preset release' && called 'ctest --preset sanitize' && said 'all tests passed'
what='the slow tests'
echo python3-vtk9 >"$place/lack" && launch 0 test --slow && called '-y install python3-vtk9' && called 'ctest --preset slow'
what='a failing test'
: >"$place/failing" && launch 1 test && said 'tests failed: release sanitize'
what='an unknown option of test'
launch 2 test --fast && said 'usage'

[ "$failures" = 0 ] && echo "the launcher does what it should"
