#!/bin/bash
# starts_light.sh GLINT SHADER_BALL FOLDER: a render whose scene has no images loads a handful of libraries, not the 260 behind OpenImageIO. The
# dynamic linker says which. Reading pictures loads them all, which shows that this would see them.
set -euo pipefail
glint=$1
scene=$2
rm -rf "$3"
mkdir -p "$3"
cd "$3"

# loaded COMMAND...: the libraries that its process initialises.
loaded() {
    LD_DEBUG=libs "$@" 2>&1 >/dev/null | sed -n 's/.*calling init: //p'
}
render=("$glint" render "$scene" --size 16x12 --spp 1)
# 20 on Debian 12: ours, Embree with TBB, OpenEXR, libpng, tinygltf, Draco, Jansson, KissFFT, zlib, and those of C and C++.
most=24
for picture in picture.png picture.exr; do
    count=$(loaded "${render[@]}" -o $picture | wc -l)
    echo "render into $picture: $count libraries, at most $most"
    [ "$count" -ge 5 ] && [ "$count" -le $most ]
done
count=$(loaded "$glint" compare picture.exr picture.exr | tee libraries | wc -l)
echo "compare: $count libraries"
[ "$count" -gt $most ] && grep -q 'libOpenImageIO\.so' libraries
