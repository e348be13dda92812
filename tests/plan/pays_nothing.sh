#!/bin/bash
# pays_nothing.sh PROGRAM: a scene that uses no effect makes the pixels of a renderer that has none, calls no code of any effect, and
# costs within MARGIN of that renderer; one without glints costs within 1 % of --model smooth.
#
# MARGIN: 24 to 27 % were measured, and the bound is there to notice more. It is not the 1 % that was wanted: what is left is the
# previewer's own (light in batches of any material, pictures without discreteness, whether a light shows its shape), see docs/plan.md.
set -euo pipefail
program=$1
margin=0.3
effects='shade_prepare_any|look_up|mapped_normal|add_coat|shade_below_coat|shade_opacity|layered_|coat_transmit|area_|shade_eval_area'
effects+='|environment_|emitters_|shade_eval_surroundings|shade_sample|leave|counting_tinted|counting_drawn|eval_what_shows|tint_'
effects+='|dictionary_|example_|explicit_|facet_|ltc_|texture_'
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

# instructions FUNCTION KIND RENDERER: leaves the profile in $out/counts
instructions() {
    valgrind --tool=callgrind --callgrind-out-file="$out/counts" --toggle-collect="$1" "$program" "$2" "$3" 2>"$out/log" ||
        { cat "$out/log" >&2; return 1; }
    sed -n 's/.*Collected *: *\([0-9]*\).*/\1/p' "$out/log"
}

# compare WHAT A B MARGIN: A at most B and the margin.
failed=0
compare() {
    awk -v what="$1" -v a="$2" -v b="$3" -v margin="$4" 'BEGIN {
        printf "%-46s %12d of %12d instructions, %+.2f %%\n", what, a, b, 100 * (a / b - 1)
        exit !(b > 0 && a <= (1 + margin) * b)
    }' || failed=1
}

for kind in smooth flakes; do
    "$program" "$kind" both
    whole=$(instructions tiles_render "$kind" whole)
    sed -n 's/^c\{0,1\}fn=([0-9]*) //p' "$out/counts" | sort -u >"$out/called"
    if grep -E "^($effects)" "$out/called"; then
        echo "$kind: calls these, and uses none of their effects"
        failed=1
    fi
    grep -q '^shade_prepare_plain' "$out/called" || { echo "$kind: no profile of the previewer"; failed=1; }
    compare "$kind, whole over bare renderer" "$whole" "$(instructions bare_render "$kind" bare)" $margin
done
compare "no glints, --model auto over --model smooth" "$(instructions preview_render smooth planned)" \
    "$(instructions preview_render smooth smooth)" 0.01
exit $failed
