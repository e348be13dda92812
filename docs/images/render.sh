#!/bin/bash
# Renders the pictures of README.md, materials/README.md and docs/lighting.md beside it, after ./dev build: the shader ball in car paint,
# in every preset, and under every light. render.sh [ball] [presets] [lights]: those alone.
set -euo pipefail
folder=$(cd "$(dirname "$0")" && pwd)
cd "$folder/../.."
glint=build/release/bin/glint ball=build/release/examples/shader_ball.glb
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# picture NAME PRESET OPTION...
picture() {
    local name=$1 preset=$2
    shift 2
    "$glint" render "$ball" -o "$folder/$name.png" --material "ball=$preset" "$@"
}

# As ./dev preview.
ball() {
    picture shader_ball metallic-car-paint --size 800x600 --spp 32
}

presets() {
    local preset
    for preset in materials/*.gltf-material.json; do
        preset=$(basename "$preset" .gltf-material.json)
        picture "$preset" "$preset" --size 320x240 --spp 16
    done
}

# The ball and its foot alone, without noise: the maps need most samples.
lights() {
    local name part=(--size 360x270 --tile 86,28,200,216)
    for name in three-point sun-and-sky ring point; do
        picture "light-set-$name" metallic-car-paint "${part[@]}" --spp 64 --light-set "$name"
    done
    for name in studio sunny; do
        build/release/examples/make_environment "$name" "$scratch/$name.hdr"
        picture "environment-$name" metallic-car-paint "${part[@]}" --spp 256 --light-set none --environment "$scratch/$name.hdr"
    done
}

[ $# -gt 0 ] || set -- ball presets lights
for part in "$@"; do "$part"; done
