#!/bin/bash
# Presets with a normal map say by which command ($1 is glint) it was made; here it is made again, and the picture in the file of
# folder $2 is that one, byte for byte. The roughness and the anisotropy are those that the command names for its slopes.
# --update writes the pictures into the files.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
field() { sed -n "s/^ *\"$2\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}\$/\1/p" "$1"; }
count=0
for file in "$2"/*.gltf-material.json; do
    grep -q '"glintStructure": "example"' "$file" || continue
    read -ra made_by <<<"$(field "$file" example)"
    said=$("$1" "${made_by[@]:1}" -o "$work/map.png" --facet-roughness "$(field "$file" glintFacetRoughness)")
    map=$(base64 -w0 "$work/map.png")
    [ "${3:-}" != --update ] || sed -i "s|^\( *\"uri\": \"data:image/png;base64,\)[^\"]*|\1$map|" "$file"
    grep -qF "\"uri\": \"data:image/png;base64,$map\"" "$file" || { echo "$file: its picture is not that of ${made_by[*]}"; exit 1; }
    wanted=$(sed 's/.*roughness \([0-9.]*\), anisotropy \([0-9.]*\) .*/\1 \2/' <<<"$said")
    strength=$(sed -n 's/.*"anisotropyStrength": \([0-9.]*\).*/\1/p' "$file")
    awk -v "has=$(field "$file" roughnessFactor) ${strength:-0}" -v "wants=$wanted" 'BEGIN {
        split(has, h, " "); split(wants, w, " ")
        print "roughness " h[1] ", wanted " w[1] "; anisotropy " h[2] ", wanted " w[2]
        exit !(h[1] - w[1] < 0.006 && w[1] - h[1] < 0.006 && (h[2] == 0 ? w[2] < 0.15 : h[2] - w[2] < 0.006 && w[2] - h[2] < 0.006)) }' ||
        { echo "$file: its roughness or anisotropy is not that of its map"; exit 1; }
    count=$((count + 1))
done
[ "$count" -ge 3 ]
