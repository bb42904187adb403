#!/usr/bin/env bash
# The Blender add-on, installed from its zip and run by Blender without windows; pictures beside those of Cycles.
# usage: blender_test.sh ADDON.zip MENINAS WORK_FOLDER [TEST...]; ends with 77 where there is no Blender that can do it.
set -euo pipefail

zip=$(readlink -f "$1") program=$(readlink -f "$2") work=$3
shift 3
skip() { printf 'skipped: %s\n' "$1" && exit 77; }
command -v blender > /dev/null || skip 'Blender is not installed: apt-get install --no-install-recommends blender python3-numpy'
blender -b --factory-startup --python-exit-code 9 --python-expr 'import numpy, io_scene_gltf2, cycles' > /dev/null 2>&1 ||
  skip "this Blender lacks numpy (python3-numpy), Cycles or the glTF add-on: $(blender --version | head -1)"

# Every path has a space in it: scripts, temporary files, the program.
work=$(readlink -m "$work")/'a folder'
rm -rf "$work"
mkdir -p "$work/scripts/addons" "$work/temporary" "$work/program"
ln -s "$program" "$work/program/meninas"
status=0
env BLENDER_USER_SCRIPTS="$work/scripts" TMPDIR="$work/temporary" PYTHONDONTWRITEBYTECODE=1 \
  blender -b -noaudio --factory-startup --python-exit-code 9 \
  -P "$(dirname "$(readlink -f "$0")")/addon_test.py" -- "$zip" "$work/program/meninas" "$work" "$@" \
  > "$work/log.txt" 2>&1 || status=$?
# Blender's own chatter stays in the log.
sed -E 's/Fra:[0-9]+ Mem:.*//' "$work/log.txt" | grep -vE '^( Time: |Saved: |Info: |Blender |Modules Installed|$)' || true
exit "$status"
