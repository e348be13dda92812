#!/bin/bash
# What stability_digest prints is the same from every build of it (NAME=PROGRAM each), and each vector width prints what one lane
# does. Under traps for floating-point exceptions, but for clang's optimiser, which raises them where the program does not. Builds of
# a compiler that is missing are not among the arguments, which is said.
set -euo pipefail
first=
for build in "$@"; do
    name=${build%%=*}
    traps=traps
    [ "$name" != clang_O3 ] || traps=
    if ! printed=$("${build#*=}" $traps); then
        echo "$name: stability_digest failed (a trap for a floating-point exception?)"
        exit 1
    fi
    if [ -z "$first" ]; then
        first=$printed
        echo "$printed"
    fi
    if [ "$printed" != "$first" ]; then
        echo "$name prints something else than ${1%%=*}:"
        diff <(echo "$first") <(echo "$printed") || true
        exit 1
    fi
    echo "$name: the same${traps:+, under traps}"
done
widths=$(echo "$first" | sed -n 's/^lanes [0-9]* *//p' | sort -u)
[ "$(echo "$widths" | wc -l)" = 1 ] || {
    echo "vector widths differ"
    exit 1
}
case "$*" in *clang_*) ;; *) echo "clang: skipped, there is none" ;; esac
