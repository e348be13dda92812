#!/bin/bash
# The command of the build tree $1 renders every preset of the folder $2 on the shader ball, small and into the folder $3, with the
# plan that a picture of any size gets.
set -euo pipefail
rm -rf "$3"
mkdir -p "$3"
count=0
for preset in "$2"/*.gltf-material.json; do
    name=$(basename "$preset" .gltf-material.json)
    message=$("$1/bin/glint" render "$1/examples/shader_ball.glb" --material "ball=$preset" --size 80x60 --spp 1 -o "$3/$name.png" 2>&1) ||
        { echo "$name: $message"; exit 1; }
    count=$((count + 1))
done
[ "$count" -ge 15 ] || { echo "only $count presets in $2"; exit 1; }
