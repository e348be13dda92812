#!/bin/bash
# growth_count.sh PROGRAM: instructions of small sizes of everything that grows (bench/growth --count), in one run of callgrind.
# Fails where work that is no more takes more than FLAT times the instructions of a smaller size, and where work that is so many times as much takes more than
# STEEP times so many. STEEP: a logarithm of the size costs less (1.2 from 64 to 256), half a power costs more (2).
set -euo pipefail
FLAT=1.3     # docs/performance.md: cost over densities and footprints
DENSITY=1.22 # what dense facets take today, 1.188, and 3 % for another compiler; FLAT was aimed at
LIGHTS=1.1   # docs/performance.md: 1024 lights over 64; they take 1.079 today
STEEP=1.25
. "$(dirname "$0")/../support/one_core.sh"
program=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
valgrind --tool=callgrind --callgrind-out-file=out --zero-before=growth_run --dump-after=growth_run "$program" --count 2>valgrind.log >cases || {
    cat valgrind.log >&2
    exit 1
}
i=0
while read -r name kind size; do
    i=$((i + 1))
    echo "$name $kind $size $(sed -n 's/^summary: //p' "out.$i")"
done <cases >counts
awk -v even="$FLAT" -v density="$DENSITY" -v lights="$LIGHTS" -v steep="$STEEP" '
    { print }
    $1 != name { name = $1; n = 0; least = $4 }
    { least = $4 < least ? $4 : least; n++; size[n] = $3; count[n] = $4 }
    { flat = $1 == "density" ? density : $1 == "lights" ? lights : even }
    $2 == "flat" && $4 > flat * least { printf "%s: %.3f times as many instructions, at most %s\n", $1, $4 / least, flat; failed = 1 }
    $2 == "linear" && n == 3 {
        # Differences: what does not grow cancels.
        grown = (count[3] - count[2]) / (count[2] - count[1]) / ((size[3] - size[2]) / (size[2] - size[1]))
        printf "%s: %.3f times as many instructions as a straight line has, at most %s\n", $1, grown, steep
        if (grown > steep) failed = 1
    }
    END { exit failed }' counts
