#!/bin/bash
# Runs, in the scratch folder $2, every `glint` command line of README.md with the command of the build tree $1. my.glb stands
# for the reader's own file; pictures are made small, for what is tested is that the line works.
set -euo pipefail
readme=$PWD/README.md
rm -rf "$2"
mkdir -p "$2"
cd "$2"
cp "$1/examples/shader_ball.glb" my.glb
PATH="$1/bin:$PATH"
count=0
while IFS= read -r line; do
    echo "+ $line"
    if [[ $line == "glint render"* ]]; then
        line+=" --size 64x48 --spp 1"
    fi
    status=0
    bash -c "$line" </dev/null || status=$?
    # Pictures as small as these need not agree; glint compare says so with 1, and has written its report.
    [ $status = 0 ] || { [ $status = 1 ] && [[ $line == "glint compare"* ]] && [ -s report.html ]; } || exit $status
    count=$((count + 1))
done < <(sed -n '/^```sh$/,/^```$/p' "$readme" | grep '^glint ')
[ "$count" -ge 4 ] || { echo "README.md has only $count lines that begin with glint"; exit 1; }

# The snippet in C is the example, word for word.
diff <(sed -n '/^```c$/,/^```$/p' "$readme" | sed '1d;$d') "$(dirname "$readme")/examples/hello_glint.c"
