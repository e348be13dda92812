#!/bin/bash
# bin/glint of the moved tree starts without help, lists the presets of that tree, and reads pictures by its module; where that is missing,
# it says so.
set -euo pipefail
glint="$1/moved/bin/glint"
readelf --dynamic --wide "$glint" | grep -q 'RUNPATH.*\[\$ORIGIN/\.\./lib\]' || { echo "the RUNPATH is not \$ORIGIN/../lib"; exit 1; }
[ "$(ldd "$glint" | awk '$1 ~ /^libglint/ { print $3 }' | xargs readlink -f)" = "$(readlink -f "$1/moved/lib/libglint.so")" ]

# A preset that only this tree has proves that the command looks here and not where it was built.
presets="$1/moved/share/libglint/materials"
sed 's/"name": "snow"/"name": "moved-snow"/' "$presets/snow.gltf-material.json" > "$presets/moved-snow.gltf-material.json"
(cd / && "$glint" materials) | grep -q 'moved-snow' || { echo "glint materials does not list $presets"; exit 1; }

map="$1/moved/map.png"
module="$1/moved/lib/libglint_image.so"
"$glint" example leather -o "$map" --size 16 >/dev/null
(cd / && "$glint" compare "$map" "$map") >/dev/null
mv "$module" "$module.away"
trap 'mv "$module.away" "$module"' EXIT
status=0
message=$("$glint" compare "$map" "$map" 2>&1) || status=$?
[ $status = 1 ] && [[ $message == *"$map: cannot be read: "*libglint_image.so* ]] || { echo "without the module: $status, $message"; exit 1; }
