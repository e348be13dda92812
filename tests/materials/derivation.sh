#!/bin/bash
# The note of every preset in $1 derives its density, "EXPRESSION = NUMBER things per m^2", and names its roughness; of a preset
# with glints in two layers, both in the order in which the file has them. Here the expression is worked out again: the density in
# the file and the number in the note agree with it to 5 %, which is what rounding to one or two digits may take.
set -euo pipefail
count=0
for file in "$1"/*.gltf-material.json; do
    note=$(sed -n 's/^ *"note": "\(.*\)"$/\1/p' "$file")
    mapfile -t densities < <(sed -n 's/^ *"glintDensity": \([0-9.e]*\),$/\1/p' "$file")
    mapfile -t derivations < <(grep -oE '[0-9(][0-9.e*/()^ -]* = [0-9.e]+ [a-z]+ per m\^2' <<<"$note")
    [ "${#densities[@]}" -ge 1 ] && [ "${#densities[@]}" -eq "${#derivations[@]}" ] ||
        { echo "$file: ${#densities[@]} densities and ${#derivations[@]} derivations"; exit 1; }
    for i in "${!densities[@]}"; do
        expression=${derivations[i]%% = *}
        stated=${derivations[i]##* = }
        awk "BEGIN { derived = $expression; density = ${densities[i]}; stated = ${stated%% *}
            print \"$expression = \" derived \", stated \" stated \", density \" density
            exit !(density / derived > 0.95 && density / derived < 1.05 && stated == density) }" ||
            { echo "$file: the derivation and the density differ"; exit 1; }
    done
    roughness=$(sed -n 's/^ *"roughnessFactor": \([0-9.]*\)$/\1/p' "$file")
    grep -qE "roughness $roughness\b" <<<"$note" || { echo "$file: the note does not name roughness $roughness"; exit 1; }
    [ "\"$(basename "$file" .gltf-material.json)\"," = "$(sed -n 's/^  "name": //p' "$file")" ] ||
        { echo "$file: the name inside is another"; exit 1; }
    count=$((count + 1))
done
[ "$count" -ge 8 ]
