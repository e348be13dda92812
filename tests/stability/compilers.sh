#!/bin/bash
# What stability_digest prints is the same from every build of it (NAME=COMMAND each), and each vector width prints what one lane
# does. Under traps for floating-point exceptions, but for clang's optimiser, which raises them where the program does not, and for
# an imitated machine, which has none. Builds of a compiler that is missing are not among the arguments, which is said.
set -euo pipefail
first=
for build in "$@"; do
    name=${build%%=*}
    traps=traps
    case $name in clang_O3 | aarch64) traps= ;; esac
    if ! printed=$(${build#*=} $traps); then
        echo "$name: stability_digest failed (a trap for a floating-point exception?)"
        exit 1
    fi
    # An imitated machine has no previewer, and another libm.
    [ "$name" != aarch64 ] || first=$(grep -v ^preview <<<"$first")
    # One line for all widths that give the same; machines have different ones.
    printed=$(sed -E 's/^lanes +[0-9]+ +/lanes /' <<<"$printed" | uniq)
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
[ "$(grep -c ^lanes <<<"$first")" = 1 ] || {
    echo "vector widths differ"
    exit 1
}
case "$*" in *clang_*) ;; *) echo "clang: skipped, there is none" ;; esac
case "$*" in *aarch64=*) ;; *) echo "aarch64: skipped, there is no compiler for it or no qemu" ;; esac
