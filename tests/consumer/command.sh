#!/bin/bash
# bin/glint of the moved tree starts without help and lists the presets of that tree.
set -euo pipefail
glint="$1/moved/bin/glint"
readelf --dynamic --wide "$glint" | grep -q 'RUNPATH.*\[\$ORIGIN/\.\./lib\]' || { echo "the RUNPATH is not \$ORIGIN/../lib"; exit 1; }
[ "$(ldd "$glint" | awk '$1 ~ /^libglint/ { print $3 }' | xargs readlink -f)" = "$(readlink -f "$1/moved/lib/libglint.so")" ]

# A preset that only this tree has proves that the command looks here and not where it was built.
presets="$1/moved/share/libglint/materials"
sed 's/"name": "snow"/"name": "moved-snow"/' "$presets/snow.gltf-material.json" > "$presets/moved-snow.gltf-material.json"
(cd / && "$glint" materials) | grep -q 'moved-snow' || { echo "glint materials does not list $presets"; exit 1; }
