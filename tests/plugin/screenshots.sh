#!/bin/bash
# The pictures of docs/blender.md, by a Blender with a window that nobody sees: screenshots.sh FOLDER
set -euo pipefail
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
export PATH=/usr/bin:$PATH # Blender takes the first python3 that it finds for its own
mkdir -p "$1"
rm -f "$1/done"
xvfb-run -a -s "-screen 0 940x1100x24" blender --factory-startup --window-geometry 0 0 940 1100 -P "$here/screenshots.py" -- "$1"
[ -f "$1/done" ] || { echo "screenshots: Blender did not come to the end"; exit 1; }
rm "$1/done"
