#!/bin/bash
# area_cost.sh PROGRAM [KIND[=MOST]...]: instructions of one evaluation of each kind, and how many times those of a point.
# Fails where it takes MOST instructions more than a point, which says nothing of what a point takes.
set -euo pipefail
program=$1
shift
[ $# -gt 0 ] || set -- sun sphere rectangle disk polygon mixed

# Set-up cancels: N more evaluations cost the difference.
instructions() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" count "$1" "$2" 2>&1 | sed -n 's/.*Collected : //p'
}
each() {
    echo $((($(instructions "$1" 768) - $(instructions "$1" 256)) / 512))
}

point=$(each point)
mixed_point=
failed=0
echo "point        $point instructions"
for asked in "$@"; do
    kind=${asked%%=*}
    most=${asked#"$kind"}
    one=$(each "$kind")
    base=$point
    if [ "$kind" = mixed ]; then
        [ -n "$mixed_point" ] || mixed_point=$(each mixed-point)
        base=$mixed_point
    fi
    awk -v kind="$kind" -v one="$one" -v base="$base" -v most="${most#=}" 'BEGIN {
        printf "%-12s %d instructions, %.2f times a point, %d more", kind, one, one / base, one - base
        if (most != "") printf ", at most %s", most
        print ""
        exit most != "" && one - base > most + 0
    }' || failed=1
done
exit $failed
