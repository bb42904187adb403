# Shared by ./meninas and ./check, which set `root` to the project's folder before they source it.
# Nothing here writes to standard output or reads standard input: both belong to the program.
# shellcheck shell=bash disable=SC2154

# Exit code 4, "exhausted resource": 1 to 3 are the program's answers about its inputs.
fail() {
  printf 'meninas: %s\n' "$*" >&2
  exit 4
}

note() { printf 'meninas: %s\n' "$*" >&2; }

# package_names build test: the packages of these groups.
package_names() {
  local group name
  while read -r group name; do
    if [[ " $* " == *" $group "* ]]; then printf '%s\n' "$name"; fi
  done <"$root/cmake/packages.txt"
}

# missing_packages build test: those of these groups that are not installed.
missing_packages() {
  local names known name
  mapfile -t names < <(package_names "$@")
  known=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${names[@]}" 2>/dev/null || true)
  for name in "${names[@]}"; do
    if [[ $'\n'"$known"$'\n' != *$'\n'"installed $name"$'\n'* ]]; then printf '%s\n' "$name"; fi
  done
}

# Whether keys that are typed come here: who reads the terminal in the background is stopped.
in_foreground() {
  local line fields
  { read -r line </proc/$$/stat; } 2>/dev/null || return 1
  # Behind the name, which may have blanks: state, parent, group, session, terminal, its group in the foreground.
  read -r -a fields <<<"${line##*) }"
  [[ ${fields[2]} == "${fields[5]}" ]] && { : </dev/tty; } 2>/dev/null
}

# Asks before packages are installed where somebody can answer, and says what it costs. No answer is a no.
may_install() {
  local answer costs download='' disk=''
  if [[ -n ${CI:-} || ! -t 2 ]] || ! in_foreground; then return 0; fi
  # Who is not root may not take the lock, and does not need it to ask.
  costs=$(LC_ALL=C apt-get -o Debug::NoLocking=true --assume-no install --no-install-recommends "$@" </dev/null 2>/dev/null || true)
  download=$(sed -n 's/^Need to get \([^/]*\).* of archives.*/\1/p' <<<"$costs")
  disk=$(sed -n 's/^After this operation, \(.*\) of additional disk space.*/\1/p' <<<"$costs")
  note "$# packages are missing: $*"
  note "they and what they need are ${download:-some 270 MB} to download and ${disk:-about 1.1 GB} of disk, a few minutes" \
    "to install; building takes some four minutes more"
  printf 'meninas: install them? [Y/n, no after a minute] ' >&2
  if ! read -r -t 60 answer </dev/tty; then
    printf '\n' >&2
    answer=n
  fi
  [[ ${answer:-y} == [Yy]* ]]
}

# install_packages build test: installs what is missing of these groups, and is quiet unless that fails.
# MENINAS_SKIP_PACKAGES=1 is for systems that have the same libraries under other names.
install_packages() {
  local names missing as_root=() log
  [[ -z ${MENINAS_SKIP_PACKAGES:-} ]] || return 0
  mapfile -t names < <(package_names "$@")
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    fail "packages: not a Debian or Ubuntu system: install the equivalents of ${names[*]}," \
      "then set MENINAS_SKIP_PACKAGES=1"
  fi
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  if [[ $(id -u) != 0 ]]; then
    command -v sudo >/dev/null ||
      fail "packages: no sudo: run this as root first: apt-get install ${missing[*]}"
    as_root=(sudo)
  fi
  may_install "${missing[@]}" || fail "packages: not installed: ${missing[*]}"
  note "installing ${missing[*]}"
  # A broken source of other software need not matter, so only the installation decides.
  log=$("${as_root[@]}" apt-get -qq update </dev/null 2>&1) || note "apt-get update failed, trying on: ${log##*$'\n'}"
  if ! log=$("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=600 \
    install --no-install-recommends "${missing[@]}" -y </dev/null 2>&1); then
    printf '%s\n' "$log" >&2
    fail "packages: apt-get could not install ${missing[*]}"
  fi
}

# configure PRESET [-DNAME=VALUE ...]: prints CMake's output only when it fails.
# A checkout that was moved or copied together with its build starts afresh: CMake remembers full paths.
configure() {
  local preset=$1 directory=$root/build/$1 fresh=() log
  shift
  if [[ -f $directory/configured && $(<"$directory/configured") != "$root" ]]; then fresh=(--fresh); fi
  [[ -f $directory/build.ninja ]] || note "configuring build/$preset"
  mkdir -p "$directory"
  if ! log=$(cd "$root" && cmake --preset "$preset" "${fresh[@]}" "$@" </dev/null 2>&1); then
    printf '%s\n' "$log" >&2
    rm -f "$directory/configured"
    fail "build: configuring build/$preset failed"
  fi
  # Warnings are worth reading even when all went well.
  if [[ $log == *"CMake Warning"* ]]; then printf '%s\n' "$log" >&2; fi
  printf '%s' "$root" >"$directory/configured"
}

needs_configuring() {
  local directory=$root/build/$1
  [[ ! -f $directory/build.ninja || ! -f $directory/configured ||
    $(<"$directory/configured") != "$root" ||
    $root/CMakePresets.json -nt $directory/configured ]]
}

# build PRESET TARGET...: says so only when there is something to build.
build() {
  local preset=$1 directory=$root/build/$1 plan
  shift
  plan=$(ninja -C "$directory" -n "$@" </dev/null 2>&1 || true)
  [[ $plan != *"no work to do"* ]] || return 0
  note "building build/$preset"
  ninja -C "$directory" "$@" </dev/null >&2 || fail "build: building build/$preset failed"
}

# Only one build at a time in one checkout; the lock is let go by `unlock_build` or with the process.
lock_build() {
  mkdir -p "$root/build"
  exec {build_lock}>"$root/build/lock"
  flock "$build_lock"
}

unlock_build() { exec {build_lock}>&-; }
