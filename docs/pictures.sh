#!/usr/bin/env bash
# Makes the pictures of README.md, docs/limits.md, docs/lux.md, docs/known_answers.md, docs/solar.md and docs/bake.md anew: docs/pictures.sh [PROGRAM]
# From a checkout; PROGRAM is ./meninas unless another one is named. It takes some minutes.
set -euo pipefail

root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
program=${1:-$root/meninas}

# picture NAME SCENE OPTIONS...: docs/NAME.png of that scene of the gallery.
picture() {
  local name=$1 scene=$2
  shift 2
  printf '%s\n' "$name" >&2
  "$program" render "$root/scenes/gallery/$scene.gltf" -o "$root/docs/$name.png" --quiet "$@"
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

# The variant of a baked scene: all that is seen of its light is its textures.
baked=$(mktemp -d)
trap 'rm -rf "$baked"' EXIT
printf '%s\n' bake >&2
"$program" bake "$root/scenes/gallery/meninas.gltf" -o "$baked/baked.glb" --quiet
"$program" render "$baked/baked.glb" --variant baked --size 360x400 --exposure 0 --view-transform srgb -o "$root/docs/bake.png" --quiet
