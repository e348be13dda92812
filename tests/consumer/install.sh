#!/bin/bash
# Installs the build tree $1 into $2/first and moves it to $2/moved, so that no path of the first place can help.
set -euo pipefail
rm -rf "$2"
cmake --install "$1" --prefix "$2/first" >/dev/null
mv "$2/first" "$2/moved"
cd "$2/moved"
for file in include/glint.h lib/libglint.so lib/pkgconfig/libglint.pc lib/cmake/libglint/libglintConfig.cmake; do
    [ -e "$file" ] || { echo "not installed: $file"; exit 1; }
done
if grep -rIl "$2/first" .; then
    echo "these files hold the place of the installation"
    exit 1
fi
