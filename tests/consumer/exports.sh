#!/bin/bash
# The dynamic symbols of the library $3 are the functions that the header $2 declares: none more, none fewer.
set -euo pipefail
declared=$(grep -E '^GLINT_(EXPORT_|PREVIEW_)?API' "$1/moved/include/$2" | grep -o 'glint_[a-z0-9_]*(' | tr -d '(' | sort)
exported=$(nm --dynamic --defined-only --format=posix "$1/moved/lib/$3" | cut -d' ' -f1 | sort)
[ -n "$declared" ]
diff <(echo "$declared") <(echo "$exported") || { echo "declared in $2 (<) and exported (>) differ"; exit 1; }
