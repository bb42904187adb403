#!/usr/bin/env bash
# The launcher of the checkout $1, tried on a small project in its place, with made-up package tools.
set -euo pipefail

source=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# The folder, like any user's, has a space in its name.
project=$scratch/a\ checkout
tools=$scratch/tools
mkdir -p "$project/cmake" "$project/cli" "$tools"

cp "$source/meninas" "$project/"
cp "$source"/cmake/{setup.sh,packages.txt} "$project/cmake/"
cat >"$project/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES CXX)
add_subdirectory(cli)
END
cat >"$project/CMakePresets.json" <<'END'
{ "version": 6, "configurePresets": [ { "name": "release", "generator": "Ninja", "binaryDir": "${sourceDir}/build/release" } ] }
END
cat >"$project/cli/CMakeLists.txt" <<'END'
add_executable(meninas_cli main.cpp)
set_target_properties(meninas_cli PROPERTIES OUTPUT_NAME meninas)
END
# Prints its arguments one a line and ends with their number.
cat >"$project/cli/main.cpp" <<'END'
#include <cstdio>
int main(int count, char** arguments) {
  for (int i = 1; i < count; ++i) std::puts(arguments[i]);
  return count - 1;
}
END

# Package tools that know every package but those in $scratch/missing, and write down what they are asked.
touch "$scratch/missing"
cat >"$tools/dpkg-query" <<'END'
#!/usr/bin/env bash
for name in "${@:3}"; do
  if ! grep -qx "$name" "$MISSING"; then echo "installed $name"; fi
done
END
cat >"$tools/apt-get" <<'END'
#!/usr/bin/env bash
echo "$SUDO apt-get $*" >>"$MISSING.log"
echo "apt-get talks"
if [[ " $* " == *" Debug::NoLocking=true --assume-no "* ]]; then
  printf 'Need to get 12.3 MB/45.6 MB of archives.\nAfter this operation, 78.9 MB of additional disk space will be used.\n'
  exit 1
fi
if [[ " $* " == *" install "* ]]; then : >"$MISSING"; fi
END
cat >"$tools/sudo" <<'END'
#!/usr/bin/env bash
SUDO=sudo exec "$@"
END
printf '#!/bin/sh\necho "$%s"\n' FAKE_ID >"$tools/id"
chmod +x "$tools"/*
export MISSING=$scratch/missing SUDO='' FAKE_ID=0 PATH=$tools:$PATH
unset MENINAS_SKIP_PACKAGES

failures=0
expect() { # expect WHAT CONDITION...
  if ! "${@:2}"; then
    printf 'failed: %s\n' "$1" >&2
    failures=$((failures + 1))
  fi
}
run() { # run COMMAND...: fills $out, $err, $code
  code=0
  "$@" >"$scratch/out" 2>"$scratch/err" </dev/null || code=$?
  out=$(<"$scratch/out") err=$(<"$scratch/err")
}
stale() { touch "$project/cli/main.cpp"; rm -f "$project/build/release/built"; }

# Two at once on a fresh checkout: one builds, both answer.
ln -s "$project/meninas" "$scratch/link"
(cd / || exit; "$scratch/link" from afar >"$scratch/other" 2>"$scratch/other.err" || true) &
cd "$scratch"
run ./link 'one argument' two
wait
expect 'the first run gives the exit code of the program' test "$code" = 2
expect 'the first run prints what the program prints' test "$out" = $'one argument\ntwo'
expect 'a second run at the same time does too' test "$(<"$scratch/other")" = $'from\nafar'
built=$(cat "$scratch/err" "$scratch/other.err" | grep -c 'building build/release')
expect 'only one of them builds' test "$built" = 1

run "$project/meninas"
expect 'an up-to-date program starts in silence' test "$code$out$err" = 0

sed -i 's/return count - 1/return 40 + count - 1/' "$project/cli/main.cpp"
run "$project/meninas" --edited
expect 'an edited source is built' test "$code" = 41
expect 'and what is said about it is not on standard output' test "$out" = --edited

touch "$project/cli/CMakeLists.txt"
run "$project/meninas"
run "$project/meninas"
expect 'silence returns after a file is touched' test "$code$out$err" = 40

sed -i 's/return 40/retrun 40/' "$project/cli/main.cpp"
run "$project/meninas" should not run
expect 'a failed build does not run the old program' test "$code:$out" = 4:
expect 'a failed build shows the error' grep -q "retrun" "$scratch/err"
run "$project/meninas"
expect 'and again until it is mended' test "$code" = 4
sed -i 's/retrun 40/return 40/' "$project/cli/main.cpp"
run "$project/meninas"
expect 'a mended source is built' test "$code" = 40

mv "$project" "$scratch/elsewhere"
project=$scratch/elsewhere
run "$project/meninas" moved
expect 'a checkout that was moved with its build works' test "$code:$out" = 41:moved

printf 'libglm-dev\nlibfmt-dev\n' >"$MISSING"
stale
run "$project/meninas" x
expect 'missing packages do not disturb the output' test "$out" = x
expect 'what apt-get says is kept to itself' test "$(grep -c 'apt-get talks' "$scratch/err")" = 0
expect 'root installs without sudo' grep -q '^ apt-get .*install.* libglm-dev libfmt-dev' "$MISSING.log"
expect 'only what is missing' test "$(grep -c libembree-dev "$MISSING.log")" = 0
expect 'after an update' grep -q 'update' "$MISSING.log"

: >"$MISSING.log"
printf 'libtbb-dev\n' >"$MISSING"
stale
FAKE_ID=1000 run "$project/meninas" x
expect 'others install with sudo' grep -q '^sudo apt-get .*install.* libtbb-dev' "$MISSING.log"

: >"$MISSING.log"
stale
run "$project/meninas" x
expect 'nothing is asked of apt-get when all is there' test ! -s "$MISSING.log"
printf 'libgtest-dev\n' >"$MISSING"
stale
run "$project/meninas" x
expect 'the program does not need what its tests need' test ! -s "$MISSING.log"

# On a terminal it asks. `script` gives the program one, and types the answer.
on_a_terminal() { # on_a_terminal ANSWER [COMMAND]: fills $out with all that is shown
  printf 'libtbb-dev\n' >"$MISSING"
  : >"$MISSING.log"
  stale
  code=0
  out=$(printf '%s\n' "$1" | script -qec "${2:-"'$project/meninas' x"}" /dev/null 2>&1) || code=$?
}
unset CI
on_a_terminal n
expect 'on a terminal it asks before it installs' grep -q 'install them?' <<<"$out"
expect 'it says how much and how long, as apt-get has it' grep -q ' 12.3 MB to download and 78.9 MB of disk.*minutes' <<<"$out"
expect 'who says no gets nothing installed' test "$code:$(grep -c ' -y' "$MISSING.log")" = 4:0
on_a_terminal y
expect 'who says yes does' grep -q 'install.* libtbb-dev -y' "$MISSING.log"
for ci in true 1; do
  CI=$ci on_a_terminal n
  expect "continuous integration is not asked, CI=$ci" grep -q 'install.* libtbb-dev -y' "$MISSING.log"
done
on_a_terminal n "bash -mc \"'$project/meninas' x & wait\""
expect 'who is in the background is not asked' grep -q 'install.* libtbb-dev -y' "$MISSING.log"
: >"$MISSING"

# A failure shows what apt-get said.
cp "$tools/apt-get" "$scratch/kept"
printf '#!/bin/sh\necho "no such package" >&2\nexit 100\n' >"$tools/apt-get"
printf 'libtbb-dev\n' >"$MISSING"
stale
run "$project/meninas" x
expect 'a failed installation shows what was said' grep -q 'no such package' "$scratch/err"
expect 'and ends' test "$code:$out" = 4:
mv "$scratch/kept" "$tools/apt-get"
: >"$MISSING"

# Elsewhere: a path with the usual tools but without Debian's.
mkdir "$scratch/foreign"
for tool in bash readlink dirname find mkdir flock cat rm mv sed ninja cmake; do
  ln -s "$(command -v "$tool")" "$scratch/foreign/$tool"
done
stale
PATH=$scratch/foreign run "$project/meninas" x
expect 'other systems are told the packages' grep -q 'not a Debian.*libembree-dev' "$scratch/err"
expect 'and stopped' test "$code:$out" = 4:
rm -rf "$scratch/foreign"

exit "$((failures > 0))"
