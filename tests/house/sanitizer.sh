#!/bin/bash
# Builds the tree of the preset $1 and runs its tests. The thread sanitizer looks at the tests that start threads.
set -euo pipefail
cmake --preset "$1" --log-level=WARNING
cmake --build --preset "$1" -j "$(nproc)"
only=()
[ "$1" != tsan ] || only=(-L threads)
ctest --preset "$1" -j "$(nproc)" --no-tests=error "${only[@]}"
