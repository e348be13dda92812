#!/bin/bash
# Builds the tree of the preset $1 and runs its tests, but not those that repeat one call a hundred million times for their
# statistics. The thread sanitizer looks at the tests that start threads.
set -euo pipefail
cmake --preset "$1" --log-level=WARNING
cmake --build --preset "$1" -j "$(nproc)"
run=(ctest --preset "$1" -j "$(nproc)" --no-tests=error -LE statistics)
if [ "$1" = tsan ]; then
    run+=(-L threads)
    # That of gcc 12 does not start on kernels that spread addresses over more than 28 bits.
    ! setarch -R true 2>/dev/null || run=(setarch -R "${run[@]}")
fi
"${run[@]}"
