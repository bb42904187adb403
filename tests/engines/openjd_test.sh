#!/usr/bin/env bash
# Open Job Description's own program checks the template and runs its tasks by the line of docs/farm.md: all pictures,
# each once, one solve, the bits of one process.
# usage: openjd_test.sh MENINAS SOURCE_FOLDER WORK_FOLDER; ends with 77 where there is no `openjd` (pip install openjd-cli).
set -euo pipefail

program=$1 source=$2 work=$3
# shellcheck source=tests/engines/farm.sh
source "$source/tests/engines/farm.sh"
command -v openjd > /dev/null || skip 'openjd is not installed: pip install openjd-cli'

prepare
cp -r "$source/integrations/openjd/meninas-batch" .
openjd check meninas-batch/template.yaml > log 2>&1 || fail "openjd check: $(< log)"
line=$(documented 'openjd run')
bash -c "$line" > log 2>&1 || fail "$line: $(tail -n 20 log)"
check_folder pictures log
printf '%s: %s pictures, once each, one solve, the same bits\n' "$line" "$pictures"
