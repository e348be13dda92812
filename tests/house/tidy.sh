#!/bin/bash
# clang-tidy 14 has no complaint about any file of src/, exporters/ and examples/ that the build tree $1 compiles. (Tests are left out for
# their number: each file takes seconds.)
set -euo pipefail
# As the build compiles them, but for what clang does not know.
database=$(mktemp -d)
trap 'rm -r "$database"' EXIT
sed 's/ -fschedule-insns -fsched-pressure//' "$1/compile_commands.json" >"$database/compile_commands.json"
sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' "$1/compile_commands.json" | grep -E "^$PWD/(src|exporters|examples)/" | sort -u |
    xargs -P "$(nproc)" -n 1 clang-tidy-14 -p "$database" --quiet --warnings-as-errors='*'
