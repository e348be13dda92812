#!/bin/bash
# Exports every good model with the presets below, in the scratch folder $2 with the command $1, and asks the Khronos validator:
# no file has an error or a warning that its input has not.
set -euo pipefail
glint=$1 scratch=$2
here=$(cd "$(dirname "$0")" && pwd)
models=/usr/share/assimp/models/glTF2
rm -rf "$scratch"
mkdir -p "$scratch"
good=(2CylinderEngine-glTF-Binary/2CylinderEngine.glb BoxTexcoords-glTF/boxTexcoords.gltf BoxTextured-glTF-Binary/BoxTextured.glb
    BoxTextured-glTF-Embedded/BoxTextured.gltf BoxTextured-glTF/BoxTextured.gltf ClearCoat-glTF/ClearCoatTest.gltf
    TestNoRootNode/SceneWithoutNodes.gltf cameras/Cameras.gltf draco/2CylinderEngine.gltf
    glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf issue_3269/texcoord_crash.gltf simple_skin/simple_skin.gltf
    textureTransform/TextureTransformTest.gltf)
cp "$models/BoxTextured-glTF/CesiumLogoFlat.png" "$scratch/logo.png"
cat > "$scratch/textured.json" <<'END'
{ "normalTexture": { "index": 0 }, "extensions": { "GLINT_materials_glint": { "glintFactor": 1, "glintTexture": { "index": 0 } } },
  "extras": { "textures": [{ "source": 0 }], "images": [{ "uri": "logo.png" }] } }
END
arguments=()
for model in "${good[@]}"; do
    number=$((${number:-0} + 1))
    for preset in brushed-steel metallic-car-paint "$scratch/textured.json"; do
        out="$scratch/$number-$(basename "$preset" .json)/$(basename "$model")"
        mkdir -p "$(dirname "$out")"
        "$glint" export gltf "$models/$model" -o "$out" --material "*=$preset" --bake-fallback 2>/dev/null
        fallback="${out%.*}.fallback.${out##*.}"
        arguments+=(--before "$models/$model" "$out" --before "$models/$model" "$fallback")
    done
done
new=()
for model in "${good[@]}"; do
    [ "$model" != TestNoRootNode/SceneWithoutNodes.gltf ] || continue
    out="$scratch/new-$(echo "${model%.*}" | tr / -).glb"
    "$glint" export gltf "$models/$model" -o "$out" --new --material "*=metallic-car-paint" 2>/dev/null
    new+=("$out")
done
[ ${#arguments[@]} = $((${#good[@]} * 18)) ]
node "$here/khronos.cjs" "${arguments[@]}"
# New files have no excuse: nothing of their input's faults.
node "$here/khronos.cjs" "${new[@]}"
# The validator does see what is wrong: a name that extensionsUsed has not.
sed 's/"GLINT_materials_glint",*//' "$scratch/4-brushed-steel/BoxTextured.gltf" > "$scratch/undeclared.gltf"
! node "$here/khronos.cjs" "$scratch/undeclared.gltf" >/dev/null
