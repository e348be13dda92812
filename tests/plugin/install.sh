#!/bin/bash
# ./dev addon makes a zip that a clean Blender installs, and registers without a complaint. The folder $1 is for its files.
set -euo pipefail
mkdir -p "$1/scripts/addons"
./dev addon
said=$(BLENDER_USER_SCRIPTS=$1/scripts BLENDER_USER_CONFIG=$1/config blender -b --factory-startup --python-exit-code 3 \
    -P tests/plugin/test_install.py -- "$PWD/build/addon/glint-blender.zip" "$1" 2>&1) || { echo "$said"; exit 1; }
if grep -iE "warning|traceback|error" <<<"$said"; then
    exit 1
fi
