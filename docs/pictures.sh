#!/usr/bin/env bash
# Makes the pictures of README.md and of the pages of docs anew: docs/pictures.sh [PROGRAM]
# From a checkout; PROGRAM is ./meninas unless another one is named. It takes some minutes.
# oiiotool (openimageio-tools, which a build needs as well) cuts layers out of EXRs and puts pictures side by side.
set -euo pipefail

root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
program=${1:-$root/meninas}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# render NAME SCENE OPTIONS...: that scene of the gallery.
render() {
  local file=$1 scene=$2
  shift 2
  printf '%s\n' "${file##*/}" >&2
  "$program" render "$root/scenes/gallery/$scene.gltf" -o "$file" --quiet "$@"
}

# picture NAME SCENE OPTIONS...: docs/NAME.png.
picture() {
  local name=$1
  shift
  render "$root/docs/$name.png" "$@"
}

# layer NAME SCENE LAYER BRIGHTER OPTIONS...: docs/NAME.png of one layer of light, so many times as bright.
layer() {
  local name=$1 scene=$2 layer=$3 brighter=$4
  shift 4
  render "$scratch/$name.exr" "$scene" --layers "$@"
  oiiotool "$scratch/$name.exr" --ch "$layer.R,$layer.G,$layer.B" --chnames R,G,B --mulc "$brighter" \
    --colorconvert linear sRGB --clamp:min=0:max=1 -d uint8 -o "$root/docs/$name.png"
}

# row NAME SCENE OPTIONS -- OPTIONS ...: docs/NAME.png, one picture beside the other, each with its options.
row() {
  local name=$1 scene=$2 pictures=() options=() word
  shift 2
  for word in "$@" --; do
    if [[ $word != -- ]]; then options+=("$word") && continue; fi
    pictures+=("$scratch/$name-${#pictures[@]}.png")
    render "${pictures[-1]}" "$scene" --size 240x180 "${options[@]}"
    options=()
  done
  oiiotool "${pictures[@]}" --mosaic:pad=4 "${#pictures[@]}x1" -o "$root/docs/$name.png"
}

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
render "$scratch/error-map.exr" sunbeam --size 240x180 --error-map --diffuse interpolated
oiiotool "$scratch/error-map.exr" --ch error.R --chnames Y --mulc 4 --colormap inferno --clamp:min=0:max=1 -d uint8 -o "$root/docs/error-map.png"

# The page of `view`, where there is a Chromium to draw it.
if command -v chromium >/dev/null; then
  "$root/bench/view_film.py" "$program" "$root/scenes/gallery/meninas.gltf" "$root/docs/view-film.png"
  "$root/bench/view_film.py" "$program" "$root/scenes/gallery/cornell-mirror.gltf" "$root/docs/view-factors.png" --factors 690,250
fi

# The variant of a baked scene: all that is seen of its light is its textures.
baked=$scratch
printf '%s\n' bake >&2
"$program" bake "$root/scenes/gallery/meninas.gltf" -o "$baked/baked.glb" --quiet
"$program" render "$baked/baked.glb" --variant baked --size 360x400 --exposure 0 --view-transform srgb -o "$root/docs/bake.png" --quiet
