#!/usr/bin/env bash
# The Debian packages of the build $1, unpacked into an empty root and used there: the program from a folder of its own, with
# nothing of the sources $2 in sight, and the library by find_package(Meninas). Exit code 77: Debian's tools are missing.
set -euo pipefail

build=$1 source=$2 compiler=$3
for tool in dpkg-deb dpkg-shlibdeps file; do
  command -v "$tool" >/dev/null || { echo "package: $tool is not installed" && exit 77; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { printf '%s\n' "$*" >&2 && exit 1; }

# Whatever the prefix of the build; the packages' own compression takes ten times as long.
cpack --config "$build/CPackConfig.cmake" -B "$scratch/packages" -D CPACK_PACKAGING_INSTALL_PREFIX=/usr \
  -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip >"$scratch/log" 2>&1 || fail "$(<"$scratch/log")"
program=$(find "$scratch/packages" -maxdepth 1 -name 'meninas_*.deb')
library=$(find "$scratch/packages" -maxdepth 1 -name 'libmeninas-dev_*.deb')
runtime=$(find "$scratch/packages" -maxdepth 1 -name 'libmeninas[0-9]*.deb')

# One version everywhere.
version=$(dpkg-deb -f "$program" Version)
[[ $(sed -n 's/^## \[\([0-9.]*\)\].*/\1/p' "$source/CHANGELOG.md" | head -n 1) == "${version%-*}" ]] || fail "CHANGELOG.md is of another version"
[[ $(sed -n '1s/.*(\(.*\)).*/\1/p' "$source/cmake/debian/changelog") == "$version" ]] || fail "cmake/debian/changelog is of another version"

# Every library that the files of the package ask for belongs to one of its dependencies, or to none but libc's package.
dpkg-deb -x "$program" "$scratch/root"
depends=$(dpkg-deb -f "$program" Depends)
for file in usr/bin/meninas $(cd "$scratch/root" && find usr/lib -name '*.so'); do
  while read -r needed; do
    path=$(/sbin/ldconfig -p | sed -n "s|^\s*$needed (.*) => ||p" | head -n 1)
    # By its last parts: what is in /lib is in /usr/lib as well.
    path=$(readlink -f "$path")
    package=$(dpkg-query -S "*/$(basename "$(dirname "$path")")/$(basename "$path")" | head -n 1 | cut -d: -f1)
    [[ ", $depends," == *", $package"[\ ,]* ]] || fail "$file needs $needed of $package, which is no dependency"
  done < <(objdump -p "$scratch/root/$file" | sed -n 's/^ *NEEDED *//p')
done

for page in usr/share/man/man1/meninas.1 usr/share/man/man1/meninas-render.1 usr/share/doc/meninas/docs/options.md \
  usr/share/bash-completion/completions/meninas usr/share/fish/vendor_completions.d/meninas.fish usr/share/meninas/batch.schema.json \
  usr/share/meninas/openjd/meninas-batch/template.yaml usr/share/meninas/kubernetes/meninas-batch.yaml; do
  [[ -s $scratch/root/$page || -s $scratch/root/$page.gz ]] || fail "$page is missing"
done

# From a folder of its own, without this environment.
mkdir "$scratch/away"
cp "$source/scenes/gallery/furnace.gltf" "$scratch/away/room.gltf"
meninas() { (cd "$scratch/away" && env -i PATH=/usr/bin:/bin "$scratch/root/usr/bin/meninas" "$@"); }
[[ $(meninas --version) == "meninas ${version%-*}" ]] || fail "--version is another version"
meninas render room.gltf --quality draft --size 16x16 -o room.png -o room.exr --quiet
meninas diff room.png room.exr --max-flip 1 >/dev/null 2>&1 || fail "a picture cannot be read"
meninas walk room.gltf --quality draft -o room.html --quiet
grep -q '<canvas' "$scratch/away/room.html" || fail "the page to walk through is empty"
meninas batch --schema | grep "\"samples\"" >/dev/null || fail "the schema is empty"
strings -a "$scratch/root/usr/bin/meninas" | grep -F "$source/" && fail "the program remembers its sources"

dpkg-deb -x "$library" "$scratch/root"
dpkg-deb -x "$runtime" "$scratch/root"
cp -r "$source/tests/house/consumer" "$scratch/consumer"
cmake -S "$scratch/consumer" -B "$scratch/consumer/build" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/root/usr" \
  -DCMAKE_CXX_COMPILER="$compiler" >/dev/null
ninja -C "$scratch/consumer/build" --quiet
"$scratch/consumer/build/consumer" "$source/scenes/gallery/furnace.gltf" "$scratch/room.png"

# The Python module, on the same library, where it was built.
packages=("$program" "$runtime" "$library")
module=$(find "$scratch/packages" -maxdepth 1 -name 'python3-meninas_*.deb')
if [[ -n $module ]] && /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
  packages+=("$module")
  dpkg-deb -x "$module" "$scratch/root"
  (cd "$scratch/away" && env -i PATH=/usr/bin:/bin PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$scratch/root/usr/lib/python3/dist-packages" \
    LD_LIBRARY_PATH="$(dirname "$(find "$scratch/root" -name 'libmeninas.so.*' | head -n 1)")" /usr/bin/python3 -c '
import meninas
assert meninas.load("room.gltf", quality="draft").render(size=(5, 4)).shape == (4, 5, 3)')
fi

# lintian judges what the package preset makes: a build that is laid down elsewhere has other names for some files.
if grep -q 'MENINAS_DEBIAN_PACKAGES:BOOL=ON' "$build/CMakeCache.txt" && command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error "${packages[@]}"
fi
