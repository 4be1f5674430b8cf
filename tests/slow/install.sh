#!/bin/sh
# The installed package, used from outside the tree: examples/search and examples/embed by find_package and by
# pkg-config, examples/plugin by find_package and through --plugin, examples/objective as the problem of a suite.
set -eu
place=$(mktemp -d) && trap 'rm -rf "$place"' EXIT
cmake --install "$2" --prefix "$place/usr" >"$place/log" || { cat "$place/log" && exit 1; }
for example in search embed plugin objective; do
  cp -r "$1/examples/$example" "$place/$example"
  cmake -G Ninja -S "$place/$example" -B "$place/$example/build" -DCMAKE_PREFIX_PATH="$place/usr"
  cmake --build "$place/$example/build"
done
program=$(find "$place/search/build" -maxdepth 1 -type f -perm -u+x)
timeout 60 "$program"

PKG_CONFIG_PATH=$(dirname "$(find "$place/usr" -name vesica.pc)") && export PKG_CONFIG_PATH
cc -std=c17 "$1"/examples/search/*.c $(pkg-config --cflags --libs vesica) -o "$place/by_pkg_config"
timeout 60 "$place/by_pkg_config" >"$place/second"
timeout 60 "$program" | diff - "$place/second"
grep -q 'stop .* pushes with 50.455 N' "$place/second" || { echo "examples/search is not right" && cat "$place/second" && exit 1; }

problem=$(find "$place/usr" -name bottle.yaml)
timeout 60 "$place/embed/build/embed" "$problem" >"$place/first"
cc -std=c17 "$1"/examples/embed/*.c $(pkg-config --cflags --libs vesica) -o "$place/embed_by_pkg_config"
timeout 60 "$place/embed_by_pkg_config" "$problem" | diff "$place/first" -
for line in 'area == 3\*pi: .* holds' 'found .* times' 'ended: of itself' 'cobyla from there' '[0-9]* triangles'; do
  grep -q "$line" "$place/first" || { echo "examples/embed does not say \"$line\"" && cat "$place/first" && exit 1; }
done

(cd "$place/objective" && cp build/tower.so . && "$place/usr/bin/vesica" bench tower.yaml --no-files --set seeds=1)

plugin=$(find "$place/plugin/build" -maxdepth 1 -name '*.so')
for problem in "$place"/plugin/*.yaml; do
  (cd "$place" && "$place/usr/bin/vesica" run "$problem" --plugin "$plugin" --no-files)
done
