#!/bin/bash
# Exports with the command $1 into the folder $2, carries the files through Blender's importer and exporter, and gives what
# comes out to the Khronos validator and to the command itself.
set -euo pipefail
glint=$1 scratch=$2
here=$(cd "$(dirname "$0")" && pwd)
models=/usr/share/assimp/models/glTF2
rm -rf "$scratch"
mkdir -p "$scratch"
"$glint" export gltf "$models/BoxTextured-glTF-Binary/BoxTextured.glb" -o "$scratch/box.glb" --material '*=metallic-car-paint' --bake-fallback
"$glint" export gltf "$models/ClearCoat-glTF/ClearCoatTest.gltf" -o "$scratch/coats.gltf" --material "*=gold-leaf"
for file in box.glb box.fallback.glb coats.gltf; do
    name=${file%.*}
    blender -b --factory-startup --python-exit-code 3 -P "$here/round_trip.py" -- "$scratch/$file" "$scratch/$name.blender.glb"\
        > "$scratch/$name.log" 2>&1 || { tail -30 "$scratch/$name.log"; exit 1; }
    node "$here/khronos.cjs" "$scratch/$name.blender.glb"
    "$glint" validate "$scratch/$name.blender.glb"
done
# What Blender wrote takes a preset as well, and gives it back.
"$glint" export gltf "$scratch/box.blender.glb" -o "$scratch/again.glb" --material '*=brushed-steel'
node "$here/khronos.cjs" "$scratch/again.glb"
"$glint" export gltf "$scratch/again.glb" -o "$scratch/again.glb" --strip
cmp "$scratch/again.glb" "$scratch/box.blender.glb"
