#!/bin/bash
# Every relative link and picture in a Markdown file leads to a file.
set -euo pipefail
broken=0
while IFS=: read -r file target; do
    [ -e "$(dirname "$file")/$target" ] || { echo "$file: no such file: $target"; broken=1; }
done < <(find . -path ./build -prune -o -path ./node_modules -prune -o -name '*.md' -print0 |
    xargs -0 grep -oHE '\]\([^)#]+' | sed 's/\](//' | grep -vE ':(https?|mailto):')
exit $broken
