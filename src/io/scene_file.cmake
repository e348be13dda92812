# gltf readers, presets, describe
