#!/bin/bash
# The scenes of examples/povray render with glint.inc, without a warning, and are neither black nor grey.
# examples.sh EXAMPLES-FOLDER GLINT-INC-FOLDER SCRATCH-FOLDER
set -euo pipefail
examples=$1 library=$2
mkdir -p "$3"
cd "$3"
for scene in "$examples"/*.pov; do
    name=$(basename "$scene" .pov)
    cp "$scene" "$library/glint.inc" .
    rm -f "$name.png" "$name.warnings"
    timeout 100 povray "+I$name.pov" "+O$name.png" +FN +W64 +H36 -A -D -V "+GW$name.warnings" >"$name.said" 2>&1 || {
        tail -20 "$name.said" >&2
        exit 1
    }
    if [ -s "$name.warnings" ]; then
        cat "$name.warnings" >&2
        exit 1
    fi
    # A picture with sparkle does not pack well: a black or grey one of this size has some hundred bytes.
    [ "$(stat -c %s "$name.png")" -gt 1500 ] || {
        echo "$name.png shows next to nothing" >&2
        exit 1
    }
done
