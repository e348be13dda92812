#!/bin/bash
# The dynamic symbols of the library are the functions that glint.h declares: none more, none fewer.
set -euo pipefail
declared=$(grep '^GLINT_API' "$1/moved/include/glint.h" | grep -o 'glint_[a-z0-9_]*(' | tr -d '(' | sort)
exported=$(nm --dynamic --defined-only --format=posix "$1/moved/lib/libglint.so" | cut -d' ' -f1 | sort)
[ -n "$declared" ]
diff <(echo "$declared") <(echo "$exported") || { echo "declared in glint.h (<) and exported (>) differ"; exit 1; }
