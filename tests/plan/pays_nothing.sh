#!/bin/bash
# pays_nothing.sh FOLDER EFFECT...: what a scene pays for effects that it does not use, in instructions of its picture.
#
# FOLDER has the program that counts, and the previewer as modules: whole, without each effect, and without all of them; and for
# the effects of the library, LIBRARY_..., the previewer and the library together, whole and without each. A scene of plain surfaces under two round lights, once of smooth metal and once of flakes,
#   - costs at most EACH more than where an effect is compiled out, for each of them,
#   - calls no code of any effect,
#   - makes the pixels of a renderer that has no effect at all, and costs at most BARE more than that;
# a scene without glints costs at most EACH more than with --model smooth.
#
# EACH is the project's promise. BARE is what is left to notice growth by; docs/plan.md says what it consists of.
set -euo pipefail
. "$(dirname "$0")/../support/one_core.sh"
folder=$1
shift
effects=("$@")
each=0.01 bare=0.2
effect_code='shade_prepare_any|look_up|mapped_normal|add_coat|shade_below_coat|shade_opacity|layered_|coat_transmit|area_|shade_eval_area'
effect_code+='|environment_|emitters_|shade_eval_surroundings|shade_sample|draw_ray|counting_tinted|counting_drawn|eval_what_shows|tint_'
effect_code+='|dictionary_|example_|explicit_|facet_|ltc_|texture_'
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

# What is rendered, in this order: names of what is counted, and the arguments of the program.
names=() arguments=()
# The module that has everything, to compare with.
whole_of() {
    [[ $1 == LIBRARY_* ]] && echo library || echo whole
}
add() {
    names+=("$1 $2 $3")
    arguments+=("$folder/$1.so" "$2" "$3")
}
for kind in smooth flakes; do
    add whole $kind whole
    add library $kind whole
    add whole $kind bare
    for effect in "${effects[@]}" all_effects; do
        # Flakes are facets.
        [[ $kind == flakes && $effect =~ ^(EFFECT_FACETS|LIBRARY_COUNTING|all_effects)$ ]] || add "$effect" $kind whole
    done
done

failed=0
for kind in smooth flakes; do
    "$folder/pays_nothing" "$folder/whole.so" $kind both
done
# A switch that is off shows where the effect is used.
for effect in "${effects[@]}"; do
    with=$(whole_of "$effect")
    mapfile -t pictures < <("$folder/pays_nothing" "$folder/$with.so" "$effect" print "$folder/$effect.so" "$effect" print)
    if [[ -z ${pictures[1]-} || ${pictures[0]} == "${pictures[1]}" ]]; then
        echo "$effect: off or on, the picture is the same: ${pictures[*]}"
        failed=1
    fi
done
# profile NAME ARGUMENT...: of each picture, to $out/NAME.1 and so on.
profile() {
    valgrind --tool=callgrind --callgrind-out-file="$out/$1" --toggle-collect=counted --dump-after=counted \
        "$folder/pays_nothing" "${@:2}" 2>"$out/log" || { cat "$out/log" >&2; exit 1; }
}
total() {
    sed -n 's/^totals: *\([0-9]*\).*/\1/p' "$1"
}

profile counts "${arguments[@]}"
declare -A count
for i in "${!names[@]}"; do
    count[${names[i]}]=$(total "$out/counts.$((i + 1))")
done
# From set-up on, in a process each: in one, the second would find what the first has left.
profile auto "$folder/whole.so" smooth planned
profile smooth "$folder/whole.so" smooth smooth

# compare WHAT A B MARGIN: A at most B and the margin.
compare() {
    awk -v what="$1" -v a="$2" -v b="$3" -v margin="$4" 'BEGIN {
        printf "%-44s %10d with %10d without, %+.2f %%\n", what, a, b, 100 * (a / b - 1)
        exit !(b > 0 && a <= (1 + margin) * b)
    }' || failed=1
}

for kind in smooth flakes; do
    whole=${count[whole $kind whole]}
    for effect in "${effects[@]}"; do
        without=${count[$effect $kind whole]-}
        [[ -z $without ]] || compare "$kind: $effect" "${count[$(whole_of "$effect") $kind whole]}" "$without" $each
    done
    [[ $kind == flakes ]] || compare "$kind: all effects" "$whole" "${count[all_effects $kind whole]}" $bare
    compare "$kind: a bare renderer" "$whole" "${count[whole $kind bare]}" $bare
done
compare "no glints: --model auto over --model smooth" "$(total "$out/auto.1")" "$(total "$out/smooth.1")" $each

for i in "${!names[@]}"; do
    [[ ${names[i]} == "whole "*" whole" ]] || continue
    sed -n 's/^c\{0,1\}fn=([0-9]*) //p' "$out/counts.$((i + 1))" | sort -u >"$out/called"
    if grep -E "^($effect_code)" "$out/called"; then
        echo "${names[i]}: calls these, and uses none of their effects"
        failed=1
    fi
    grep -q '^shade_prepare_plain' "$out/called" || { echo "${names[i]}: no profile of the previewer"; failed=1; }
done
exit $failed
