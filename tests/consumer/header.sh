#!/bin/bash
# The installed header alone compiles without a warning as C11 and as C++.
set -euo pipefail
header="$1/moved/include/glint.h"
strict=(-Wall -Wextra -Wpedantic -Werror -fsyntax-only)
for compiler in gcc clang-14; do
    "$compiler" -x c -std=c11 "${strict[@]}" "$header"
    "$compiler" -x c++ -std=c++11 "${strict[@]}" "$header"
done
