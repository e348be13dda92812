#!/bin/bash
# ways_cost.sh PROGRAM ["WAY < [TIMES] OTHER"]...: instructions of ways that do the same work. Fails where one is not below the other, or
# below that many times the other.
set -euo pipefail
program=$1
shift
declare -A counted

# Set-up cancels: one turn more over the same cases costs the difference.
instructions() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" count "$1" "$2" 2>&1 | sed -n 's/.*Collected : //p'
}
count() {
    [ -n "${counted[$1]:-}" ] && return
    counted[$1]=$(($(instructions "$1" 2) - $(instructions "$1" 1)))
    echo "$1: ${counted[$1]} instructions"
}

failed=0
for asked in "$@"; do
    way=${asked%% < *}
    other=${asked#* < }
    times=1
    [[ $other =~ ^([0-9.]+)\ (.*)$ ]] && times=${BASH_REMATCH[1]} && other=${BASH_REMATCH[2]}
    count "$way"
    count "$other"
    awk -v way="$way" -v a="${counted[$way]}" -v other="$other" -v b="${counted[$other]}" -v times="$times" 'BEGIN {
        printf "  %s takes %.3f of %s, at most %s\n", way, a / b, other, times
        exit a > 0 && a < times * b ? 0 : 1
    }' || failed=1
done
exit $failed
