#!/usr/bin/env bash
# Installs the Python module of the sources $2 from the build $1 by pip, without a network, and tries it: its tests, and
# the lecture. Exit code 77: what it needs of Debian is missing.
set -euo pipefail

build=$1 source=$2 program=$3
python=/usr/bin/python3 # Debian's, which has its packages
"$python" -c 'import numpy, scipy, pip' 2>/dev/null || { echo "python: Debian's numpy, scipy or pip is not installed" && exit 77; }
dpkg-query -W -f='${db:Status-Status}' pybind11-dev 2>/dev/null | grep -qx installed ||
  { echo "python: pybind11-dev is not installed" && exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# pip leaves what it builds beside the sources.
cp -r "$source/integrations/python" "$scratch/python"
MENINAS_BUILD=$build MENINAS_VERSION=$(sed -n 's/^project(meninas VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt") \
  "$python" -m pip install --quiet --no-index --no-deps --no-cache-dir --disable-pip-version-check --root-user-action=ignore \
  --target "$scratch/site" "$scratch/python"
cd "$scratch" # nothing of the sources is in sight
export PYTHONPATH=$scratch/site PYTHONDONTWRITEBYTECODE=1 MENINAS_GALLERY=$source/scenes/gallery MENINAS_PROGRAM=$program
"$python" "$source/tests/python/test_meninas.py"
"$python" "$source/integrations/python/lecture.py"
if nm -DC --defined-only "$scratch"/site/meninas/libmeninas.so.* | grep -E ' [A-Z] .*(embree|tbb|Imf|OpenImageIO|fmt|tinygltf)'; then
  echo "the library shows names of others" >&2
  exit 1
fi
