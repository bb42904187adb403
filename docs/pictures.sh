#!/usr/bin/env bash
# Makes the pictures of README.md and of the pages of docs anew: docs/pictures.sh [--compare] [--only REGEX] [PROGRAM]
#   --compare      into a folder that goes again; says which of those in docs differ visibly (mean FLIP above 0.01), exit code 1
#   --only REGEX   those alone whose name, without docs/ and .png, it fits
# From a checkout; PROGRAM is ./meninas unless another one is named. The living room takes fifteen processor minutes, the rest some more.
# oiiotool (openimageio-tools, which a build needs as well) cuts layers out of EXRs and puts pictures side by side.
set -euo pipefail

root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
compare='' only=''
while (($#)); do
  case $1 in
    --compare) compare=1 ;;
    --only) only=$2 && shift ;;
    -*) printf 'docs/pictures.sh: unknown option %s\n' "$1" >&2 && exit 2 ;;
    *) break ;;
  esac
  shift
done
program=${1:-$root/meninas}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
docs=$root/docs
if [[ -n $compare ]]; then docs=$scratch/docs && mkdir "$docs"; fi

# wanted NAME
wanted() { [[ -z $only || $1 =~ $only ]]; }

# scene NAME: its file; that of the living room is written by the generator, which a build has.
scene() {
  if [[ $1 == living-room ]]; then
    cmake --build "$root/build/release" -t meninas_living_room >&2
    printf '%s' "$root/build/release/scenes/gallery/$1.glb"
  else
    printf '%s' "$root/scenes/gallery/$1.gltf"
  fi
}

# render FILE SCENE OPTIONS...: that scene of the gallery.
render() {
  local file=$1 from
  from=$(scene "$2")
  shift 2
  printf '%s\n' "${file##*/}" >&2
  "$program" render "$from" -o "$file" --quiet "$@"
}

# picture NAME SCENE OPTIONS...: docs/NAME.png.
picture() {
  local name=$1
  shift
  wanted "$name" || return 0
  render "$docs/$name.png" "$@"
}

# layer NAME SCENE LAYER BRIGHTER OPTIONS...: docs/NAME.png of one layer of light, so many times as bright.
layer() {
  local name=$1 scene=$2 layer=$3 brighter=$4
  shift 4
  wanted "$name" || return 0
  render "$scratch/$name.exr" "$scene" --layers "$@"
  oiiotool "$scratch/$name.exr" --ch "$layer.R,$layer.G,$layer.B" --chnames R,G,B --mulc "$brighter" \
    --colorconvert linear sRGB --clamp:min=0:max=1 -d uint8 -o "$docs/$name.png"
}

# row NAME SCENE OPTIONS -- OPTIONS ...: docs/NAME.png, one picture beside the other, each with its options.
row() {
  local name=$1 scene=$2 pictures=() options=() word
  shift 2
  wanted "$name" || return 0
  for word in "$@" --; do
    if [[ $word != -- ]]; then options+=("$word") && continue; fi
    pictures+=("$scratch/$name-${#pictures[@]}.png")
    render "${pictures[-1]}" "$scene" --size 240x180 "${options[@]}"
    options=()
  done
  oiiotool "${pictures[@]}" --mosaic:pad=4 "${#pictures[@]}x1" -o "$docs/$name.png"
}

# README.md
day=(--background '2,2.4,2.9' --exposure 0.8)
picture living-room living-room --size 1920x1080 "${day[@]}"
if wanted living-room-paths; then
  render "$scratch/by-radiosity.png" living-room --size 480x270 "${day[@]}"
  render "$scratch/by-paths.png" living-room --size 480x270 "${day[@]}" --mode reference --samples 64 # as long
  oiiotool "$scratch/by-radiosity.png" "$scratch/by-paths.png" --mosaic:pad=4 2x1 -o "$docs/living-room-paths.png"
fi
picture meninas-radiosity meninas --size 720x800 --mode radiosity --quality fine
picture meninas-hybrid meninas --size 720x800
picture glass-screen glass-screen --size 480x360
picture glass-solids glass-solids --size 480x360
picture lattice lattice --size 480x360 --background 0.8,0.9,1
picture sunbeam sunbeam --size 480x360 --background 0.4,0.6,1
picture roughness-sweep roughness-sweep --size 512x256
picture globillum globillum-2 --size 480x300
picture solar-row solar-row --size 480x300 --background 30
picture illuminance cornell-mirror --size 512x512 --view illuminance

# docs/light-paths.md
small=(--size 240x180)
layer path-emission cornell-mirror emission 3 "${small[@]}"
picture path-direct cornell-mirror "${small[@]}" --exposure 1.25 --solver progressive --steps 1 --interpolation average
layer path-diffuse cornell-mirror diffuse.direct 3 "${small[@]}"
layer path-mirrored cornell-mirror diffuse.mirrored 6 "${small[@]}"
layer path-seen-in-mirror cornell-mirror diffuse.direct.mirror 3 "${small[@]}"
layer path-mirrored-seen-in-mirror cornell-mirror diffuse.mirrored.mirror 12 "${small[@]}"
layer path-seen-in-mirrors facing-mirrors diffuse.direct.mirrors 2 "${small[@]}"
layer path-mirror-spot mirror-spot diffuse.mirrored 1 "${small[@]}"
layer path-periscope periscope diffuse.mirrored 16 "${small[@]}"
picture path-sun sunbeam "${small[@]}"
picture path-sky sunbeam "${small[@]}" --sky overcast --light-scale 0.000001 --exposure 3
picture path-gloss roughness-sweep "${small[@]}"
picture path-pane glass-screen "${small[@]}"
picture path-solid glass-solids "${small[@]}"

# docs/which-option.md
row option-diffuse sunbeam --quality draft --diffuse interpolated -- --quality draft --diffuse direct -- --quality draft --diffuse gather
row option-samples facing-mirrors --samples 1 -- --samples 4 -- --samples 16
row option-mirror-depth facing-mirrors --mirror-depth 1 -- --mirror-depth 3 --
row option-gloss roughness-sweep --glossy-samples 2 -- --glossy-samples 16 -- --glossy-samples 64
row option-transform sunbeam --view-transform neutral -- --view-transform agx -- --view-transform srgb
row option-mode cornell-mirror --mode radiosity -- --mode hybrid -- --mode reference --samples 64

# docs/error.md
row error-steps sunbeam --mesh uniform --elements 1000 --diffuse interpolated -- --elements 16000 --diffuse interpolated -- --diffuse direct
if wanted error-map; then
  render "$scratch/error-map.exr" sunbeam --size 240x180 --error-map --diffuse interpolated
  oiiotool "$scratch/error-map.exr" --ch error.R --chnames Y --mulc 4 --colormap inferno --clamp:min=0:max=1 -d uint8 -o "$docs/error-map.png"
fi

# The page of `view`, where there is a Chromium to draw it.
if command -v chromium >/dev/null; then
  if wanted view-film; then "$root/bench/view_film.py" "$program" "$root/scenes/gallery/meninas.gltf" "$docs/view-film.png"; fi
  if wanted view-factors; then "$root/bench/view_film.py" "$program" "$root/scenes/gallery/cornell-mirror.gltf" "$docs/view-factors.png" --factors 690,250; fi
fi

# The variant of a baked scene: all that is seen of its light is its textures.
if wanted bake; then
  printf '%s\n' bake >&2
  "$program" bake "$root/scenes/gallery/meninas.gltf" -o "$scratch/baked.glb" --quiet
  "$program" render "$scratch/baked.glb" --variant baked --size 360x400 --exposure 0 --view-transform srgb -o "$docs/bake.png" --quiet
fi

# What differs is named, and nothing is not enough.
if [[ -n $compare ]]; then
  made=("$docs"/*.png)
  [[ -e ${made[0]} ]] || { printf 'docs/pictures.sh: no picture is named like %s\n' "$only" >&2 && exit 2; }
  differ=0
  for new in "${made[@]}"; do
    name=${new##*/}
    "$program" diff "$new" "$root/docs/$name" --max-flip 0.01 >"$scratch/diff.txt" || { printf 'docs/%s is not what this program makes:\n' "$name" && cat "$scratch/diff.txt" && differ=1; }
  done
  exit "$differ"
fi
