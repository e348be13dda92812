#!/bin/bash
# Each installed header alone compiles without a warning as C11 and as C++.
set -euo pipefail
strict=(-Wall -Wextra -Wpedantic -Werror -fsyntax-only)
for header in "$1"/moved/include/*.h; do
    for compiler in gcc clang-14; do
        "$compiler" -x c -std=c11 "${strict[@]}" "$header"
        "$compiler" -x c++ -std=c++11 "${strict[@]}" "$header"
    done
done
