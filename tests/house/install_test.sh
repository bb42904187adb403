#!/usr/bin/env bash
# Installs the build given as $1 (sanitizers: $2, C++ compiler: $3), moves the tree, and uses it as a stranger would:
# the program, and find_package(meninas) from a project of three lines; then the project and the programs of docs/library.md.
set -euo pipefail

build=$1 sanitize=$2 compiler=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --install "$build" --prefix "$scratch/first" >/dev/null
mv "$scratch/first" "$scratch/moved here"
prefix=$scratch/moved\ here

"$prefix/bin/meninas" --version
grep -q '"samples"' "$prefix/share/meninas/batch.schema.json"
if find "$prefix" -name '*.cmake' -exec grep -l "$scratch/first" {} + ; then
  echo "the installed package remembers where it was installed" >&2
  exit 1
fi

root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..
cp -r "$root/tests/house/consumer" "$scratch/consumer"
flags=
if [[ -n $sanitize ]]; then
  flags=-fsanitize=$sanitize
  # The sanitizer opens modules in the program's place, and so without the program's search path.
  LD_LIBRARY_PATH=$(dirname "$(find "$prefix" -name meninas_decoder.so)")
  export LD_LIBRARY_PATH
fi
# The server of `view` is a module, too.
"$prefix/bin/meninas" view "$root/scenes/gallery/furnace.gltf" --no-open --quiet >"$scratch/address" &
view=$!
for _ in $(seq 600); do
  [[ -s $scratch/address ]] && break
  sleep 0.1
done
kill -TERM $view
wait $view || true
grep -q '^http://127.0.0.1:' "$scratch/address"

cmake -S "$scratch/consumer" -B "$scratch/consumer/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" >/dev/null
ninja -C "$scratch/consumer/build" --quiet
"$scratch/consumer/build/consumer" "$root/scenes/gallery/furnace.gltf" "$scratch/room.png"
test -s "$scratch/room.png"

# The blocks of docs/library.md: its project, and its two programs.
page=$scratch/page
mkdir "$page"
awk -v folder="$page" '/^```cmake/ { file = folder "/CMakeLists.txt"; next }
  /^```cpp/ { file = folder (++programs == 1 ? "/rooms.cpp" : "/views.cpp"); next }
  /^```/ { file = ""; next }
  file { print > file }' "$root/docs/library.md"
cmake -S "$page" -B "$page/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" >/dev/null
ninja -C "$page/build" --quiet
cd "$page"
build/rooms "$root/scenes/gallery/furnace.gltf" room.png
test -s room.png
build/views "$root/scenes/gallery/furnace.gltf"
test -n "$(find . -maxdepth 1 -name '*.png' ! -name room.png)"
