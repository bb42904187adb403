#!/usr/bin/env bash
# Meninas as the documents call it, made quick: every option stays, but pictures are tiny, meshes coarse and times short.
# MENINAS_PROGRAM is the program; each command is added to MENINAS_LOG with its exit code.
set -uo pipefail

given=$*
case ${1-} in *.gltf | *.glb) set -- render "$@" ;; esac
command=$1 && shift
words=("$command") seen=' '
size=48x32
if [[ " $* " == *' --tile '* ]]; then size=128x64; fi # eight tiles

while (($#)); do
  words+=("$1") seen+="$1 "
  value=
  case $1 in
    --size) value=$size ;;
    --quality) value=draft ;;
    --elements) value=300 ;;
    --error) value=0.3 ;;
    --time) value=1 ;;
    --max-error) value=0.2 ;;
    --budget) value=4 ;;
  esac
  shift
  if [[ $value ]]; then words+=("$value") && shift; fi
done

has() { [[ $seen == *" $1 "* ]]; }
case $command in
  render | compare)
    has --size || words+=(--size "$size")
    has --quality || has --error || has --time || words+=(--quality draft) ;;
  solve | walk | view) has --quality || words+=(--quality draft) ;;
  trade)
    has --size || words+=(--size 32x32)
    has --budget || words+=(--budget 4) ;;
  batch) has --only || has --shard || has --schema || has --dry-run || words+=(--only 0) ;;
  regress) if has reference/images/cases.json; then words+=(--filter cornell.hybrid); fi ;;
esac

if [[ $command == view ]]; then # until it shows something
  "$MENINAS_PROGRAM" "${words[@]}" --no-open >view.out 2>&1 &
  server=$!
  for ((wait = 0; wait < 600; ++wait)); do
    grep -q 'http://' view.out && break
    kill -0 $server 2>/dev/null || break
    sleep 0.1
  done
  kill -INT $server 2>/dev/null
  wait $server
  code=$?
  grep -q 'http://' view.out || code=1
else
  "$MENINAS_PROGRAM" "${words[@]}"
  code=$?
fi
printf '%s\n' "$code $given" >>"$MENINAS_LOG"
exit $code
