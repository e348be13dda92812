#!/bin/bash
# What ./dev build builds of the build tree $1 is all that `cmake --install` then asks for.
set -euo pipefail
read -ra targets < <(sed -n '/^dev_build()/,/^}/s/^ *cmake --build .* --target //p' dev)
[ ${#targets[@]} -gt 0 ] || { echo "dev_build names no target"; exit 1; }
built=$(printf '%s\n' "${targets[@]}"; ninja -C "$1" -t query "${targets[@]}" | tr -d ' ')
installed=$(sed -nE "s;.*FILES \"$1/(lib/lib[^/\"]*\.so|bin/[^/\"]*)\".*;\1;p" "$1/cmake_install.cmake")
[ "$(wc -w <<<"$installed")" -ge 5 ] || { echo "cmake --install installs no more than: $installed"; exit 1; }
for file in $installed; do
    grep -qx "$file" <<<"$built" || { echo "./dev build does not build $file, which cmake --install needs"; exit 1; }
done
