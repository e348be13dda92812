#!/bin/bash
# Every source file is as clang-format 14 would write it. `./dev format` calls this with -i, which rewrites them instead.
# glint.inc is POV-Ray's language.
set -euo pipefail
[ $# -gt 0 ] || set -- --dry-run -Werror
find src exporters examples tests -regex '.*\.\(c\|h\|cpp\|hpp\|inc\)' -not -name glint.inc -print0 | xargs -0 clang-format-14 "$@"
