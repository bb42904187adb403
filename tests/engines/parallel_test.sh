#!/usr/bin/env bash
# GNU parallel runs the line of docs/farm.md: all pictures, each once, one solve, the bits of one process.
# usage: parallel_test.sh MENINAS SOURCE_FOLDER WORK_FOLDER; ends with 77 where there is no GNU parallel.
set -euo pipefail

program=$1 source=$2 work=$3
# shellcheck source=tests/engines/farm.sh
source "$source/tests/engines/farm.sh"
parallel --version 2> /dev/null | grep -q '^GNU parallel' || skip 'GNU parallel is not installed: ./check --all installs it'

prepare
line=$(documented parallel)
mkdir home && HOME=$work/home bash -c "$line" > log 2>&1 || fail "$line: $(tail -n 3 log)"
check_folder pictures log
printf '%s: %s pictures, once each, one solve, the same bits\n' "$line" "$pictures"
