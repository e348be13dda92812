#!/bin/bash
# example_cost.sh PROGRAM: how many times the instructions of the example model's own evaluation the sum of its seeds takes, and how they
# grow with the footprint. Fails where that is fewer times than the paper says (5 to 12), or where a footprint of a million examples takes
# more than three times one of a hundred: a loop over them would take a thousand times as many.
set -euo pipefail
program=$1
failed=0
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

# Of a function and what it calls.
inclusive() {
    callgrind_annotate --auto=no --inclusive=yes --threshold=100 "$folder/out" | awk -v name=":$1 " 'index($0 " ", name) && !found++ { gsub(",", "", $1); print $1 }'
}
wide() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" wide "$1" "$2" "$3" 2>&1 | sed -n 's/.*Collected : //p'
}

for asked in tiled=12 scattered=5; do
    placement=${asked%=*}
    valgrind --tool=callgrind --callgrind-out-file="$folder/out" --toggle-collect=example_density --toggle-collect=seed_surface_density \
        "$program" seeds "$placement" >"$folder/said" 2>&1 || { cat "$folder/said"; exit 1; }
    own=$(inclusive example_density)
    sum=$(inclusive seed_surface_density)
    awk -v own="$own" -v sum="$sum" -v least="${asked#*=}" -v what="$placement" 'BEGIN {
        printf "%s: %d instructions, the sum of seeds %d: %.1f times, at least %s\n", what, own, sum, sum / own, least
        exit own > 0 && sum >= least * own ? 0 : 1
    }' || failed=1
    # Set-up cancels.
    base=$(wide "$placement" 10 0)
    few=$(($(wide "$placement" 10 40) - base))
    many=$(($(wide "$placement" 1000 40) - base))
    echo "$placement: $((few / 40)) instructions over 10^2 examples, $((many / 40)) over 10^6"
    [ "$many" -gt 0 ] && [ "$many" -lt $((3 * few)) ] || failed=1
done
exit $failed
