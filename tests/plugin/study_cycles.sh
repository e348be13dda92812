#!/bin/bash
# At length: libglint against Cycles, flake by flake and by statistics. study_cycles.sh GLINT FOLDER
set -uo pipefail
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
export PATH=/usr/bin:$PATH # Blender takes the first python3 that it finds for its own
glint=$1
mkdir -p "$2/cycles"
folder=$(realpath "$2/cycles")
status=0
for light in sun rect; do
    # A sphere has far more flakes in a pixel than the plane, and takes samples for them.
    for shape in "plane 2048" "sphere 16384"; do
        for distribution in ggx beckmann; do
            echo "$shape samples, $distribution, $light:"
            # shellcheck disable=SC2086
            python3 "$here/test_cycles_flakes.py" "$glint" "$folder" ${shape% *} $distribution $light "${shape#* }" || status=1
        done
    done
done
blender -b --factory-startup --python-exit-code 3 -P "$here/cycles_statistics.py" -- "$glint" "$folder" | grep -E "^ *(mean|variance|ggx|beckmann)" |
    tee "$folder/statistics.txt"
[ "${PIPESTATUS[0]}" = 0 ] || status=1
exit $status
