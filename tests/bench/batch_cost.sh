#!/bin/bash
# batch_cost.sh KERNEL EVAL [WHAT=MOST]...: instructions a point of the counting kernel ("kernel 8": at eight lanes, "kernel alone":
# one point at a time, "kernel lit": a light, of four at each point, at eight lanes) and of whole batches ("counting", or another case of bench/eval). Fails where there are more than MOST.
# valgrind runs no AVX-512: batches take eight lanes.
set -euo pipefail
kernel=$1
eval=$2
shift 2

# Set-up cancels: some thousand points more cost the difference. The kernel's workload repeats after 4096.
instructions() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$@" 2>&1 | sed -n 's/.*Collected : //p'
}
failed=0
for asked in "$@"; do
    what=${asked%%=*}
    case $what in
    kernel\ *) run=("$kernel" count "${what#kernel }") ; from=4 ; to=8 ;;
    *) run=("$eval" count "$what") ; from=1 ; to=3 ;;
    esac
    first=$(instructions "${run[@]}" $from)
    second=$(instructions "${run[@]}" $to)
    each=$(((second - first) / ((to - from) * 1024)))
    most=${asked#"$what"}
    most=${most#=}
    echo "$what: $each instructions a point${most:+, at most $most}"
    [ -z "$most" ] || [ "$each" -le "$most" ] || failed=1
done
exit $failed
