#!/bin/bash
# Renders the pictures of README.md beside it, after ./dev build: the shader ball, cut to the ball.
set -euo pipefail
folder=$(cd "$(dirname "$0")" && pwd)
cd "$folder/../../../.."
glint=build/release/bin/glint ball=build/release/examples/shader_ball.glb
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# picture NAME MODEL PRESET [POINTER=VALUE...]
picture() {
    local name=$1 model=$2 preset=$3 set=()
    shift 3
    for value in "$@"; do set+=(--set "$value"); done
    "$glint" export gltf "$ball" -o "$scratch/ball.glb" --material "ball=$preset" "${set[@]}"
    "$glint" render "$scratch/ball.glb" -o "$folder/$name.png" --model "$model" --size 480x360 --tile 132,40,216,216 --spp 64
}

picture smooth smooth metallic-car-paint
for density in 7e8 7e6 7e4; do
    picture "density-$density" auto metallic-car-paint "/glintDensity=$density"
done
picture elongation-1 auto brushed-steel /glintElongation=1 /glintDensity=2e6
picture elongation-50 auto brushed-steel /glintElongation=50 /glintDensity=2e6
picture facet-0.02 auto craft-glitter /glintFacetRoughness=0.02
picture facet-0.4 auto craft-glitter /glintFacetRoughness=0.4
