# Sourced by the tests of farms after `program`, `source` and `work` are set: the folder $work with jobs.json, `meninas`
# on the path, and what one process alone makes of it in $work/alone.
skip() { printf 'skipped: %s\n' "$1" && exit 77; }
fail() { printf 'FAILED: %s\n' "$1" && exit 1; }

# prepare [SETTINGS]
pictures=12
prepare() {
  local settings=${1:-'"size": "64x48"'}
  rm -rf "$work" && mkdir -p "$work/bin"
  ln -s "$program" "$work/bin/meninas"
  export PATH="$work/bin:$PATH"
  cd "$work"
  cp "$source/scenes/gallery/cornell-mirror.gltf" room.gltf
  cat > jobs.json << END
{"jobs": [{"scenes": "room.gltf", "cameras": {"name": "turn", "orbit": {"radius": 2.5}, "frames": $pictures},
  "settings": {"quality": "draft", $settings}, "outputs": ["{frame}.exr", "{frame}.png"]}]}
END
  meninas batch jobs.json -o alone --quiet
}

# check_folder DIR LOG: the bits of $work/alone and nothing else, all with one solve, every picture made once.
check_folder() {
  local file made
  for file in "$work"/alone/*.exr "$work"/alone/*.png; do
    cmp "$file" "$1/$(basename "$file")" || fail "$1: a picture differs or is missing"
  done
  [[ $(find "$1" -maxdepth 1 -name '*.exr' -o -maxdepth 1 -name '*.png' | wc -l) == $((2 * pictures)) ]] || fail "$1: files too many"
  [[ $(find "$1/.meninas/solutions" -name '*.glb' | wc -l) == 1 ]] || fail "$1: not one solution"
  [[ -s $1/index.html ]] || fail "$1: no page"
  made=$(grep -c ' s)$' "$2" || true)
  [[ $made == "$pictures" ]] || fail "$1: $made pictures were made, not $pictures"
}

# documented COMMAND: the line of docs/farm.md that begins with it.
documented() {
  local line
  line=$(grep "^$1 " "$source/docs/farm.md") || fail "docs/farm.md shows no '$1'"
  printf '%s\n' "$line"
}
