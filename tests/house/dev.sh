#!/bin/bash
# ./dev answers a command that it does not know with exit code 2, its name, and the list of those that it knows.
set -euo pipefail
status=0
message=$(./dev polish 2>&1 >/dev/null) || status=$?
[ "$status" = 2 ]
grep -q "'polish'" <<<"$message"
for command in build preview addon test study fuzz format tidy clean; do
    grep -q "^  $command " <<<"$message"
    grep -q "^dev_$command()" dev
done
