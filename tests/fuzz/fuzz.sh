#!/usr/bin/env bash
# Fuzzes the reader of PNGs, then the glTF loader: builds the targets with clang, makes the seeds, and runs them.
#   tests/fuzz/fuzz.sh FOLDER [--runs N | --seconds S] [FUZZER_OPTIONS]
#   tests/fuzz/fuzz.sh FOLDER --geometry [OPTIONS]   hostile geometry instead, through everything behind the loader, by hand:
#                                                    the options are those of tests/hostile/geometry_fuzz.cpp
# FOLDER keeps the build, the corpus that grew and the findings (crash-*, timeout-*, oom-*). With --runs the same files are tried each
# time, from the seeds alone; with --seconds it goes on from the corpus of earlier runs. Exit code 1: there is a finding; 77: there is no
# clang++-16 (before clang 15 there is no std::source_location).
set -euo pipefail

here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$(mkdir -p "$1" && cd "$1" && pwd)
shift

command -v clang++-16 >/dev/null || { echo "fuzz: clang++-16 is not installed" && exit 77; }

# Under clang's sanitizers, which compile in half the time of GCC's. What points where it should not the address sanitizer finds as
# well as -fsanitize=null, alignment and vptr do; casts of floats that do not fit are no part of `undefined`, and are what an index out
# of a table begins with.
if [[ ${1:-} == --geometry ]]; then
  shift
  sanitizers=address,bounds,signed-integer-overflow,shift,integer-divide-by-zero,float-cast-overflow,unreachable,return,bool,enum
  cmake -S "$here/../.." -B "$folder/sanitized" -G Ninja -DCMAKE_CXX_COMPILER=clang++-16 -DMENINAS_BUILD_TESTS=ON \
    -DCMAKE_BUILD_TYPE=Fuzz -DCMAKE_CXX_FLAGS_FUZZ="-O1 -g1 -D_GLIBCXX_ASSERTIONS" -DMENINAS_SANITIZE=$sanitizers >/dev/null
  ninja -C "$folder/sanitized" -j2 geometry_fuzz >"$folder/sanitized.log" || { cat "$folder/sanitized.log" && exit 1; }
  exec "$folder/sanitized/tests/hostile/geometry_fuzz" --write "$folder/geometry" "$@"
fi

limit=(-runs=20000 -seed=1)
keep=false
while (($#)); do
  case $1 in
    --runs) limit=(-runs="$2" -seed=1) && shift 2 ;;
    --seconds) limit=(-max_total_time="$2") && keep=true && shift 2 ;;
    *) break ;;
  esac
done

launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake -S "$here" -B "$folder/build" -G Ninja -DCMAKE_CXX_COMPILER=clang++-16 "${launcher[@]}" >/dev/null
ninja -C "$folder/build" -j2 >"$folder/build.log" || { cat "$folder/build.log" && exit 1; }

"$folder/build/make_seeds" "$folder"
$keep || rm -rf "$folder/corpus"
mkdir -p "$folder/corpus"
cd "$folder"
# Left to itself libFuzzer ends with 77 where it finds something, and with 70 and 71 for what takes too long or too much.
finding=(-error_exitcode=1 -timeout_exitcode=1)
# libpng's reader is small: a fixed number of files, from the smallest pictures of the documents.
mkdir -p png_corpus png_seeds
$keep || rm -f png_corpus/*
find "$here/../../docs" -name '*.png' -size -10k -exec cp -t png_seeds {} +
build/png_fuzz "${finding[@]}" -max_len=8192 -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=128 "${limit[@]}" png_corpus png_seeds
exec build/loader_fuzz "${finding[@]}" -dict=words.dict -max_len=8192 -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=512 \
  -print_final_stats=1 "${limit[@]}" "$@" corpus seeds
