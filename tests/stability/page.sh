#!/bin/bash
# Holds the table of docs/stability.md, between its two marks, to what the program $1 prints. With --update as $2 it is written anew.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
page=docs/stability.md
with_table() {
    sed '/^<!-- table -->$/q' "$page"
    "$1"
    echo
    sed -n '/^<!-- end of the table -->$/,$p' "$page"
}
written=$(with_table "$1")
if [ "${2:-}" = --update ]; then
    echo "$written" >"$page"
else
    diff <(echo "$written") "$page" || {
        echo "$page is not what the program prints: bash tests/stability/page.sh $1 --update"
        exit 1
    }
fi
