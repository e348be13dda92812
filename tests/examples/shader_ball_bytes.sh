#!/bin/bash
# make_shader_ball ($1) gives the same bytes twice from the scene $2; a bad scene or folder is an error and leaves no file in $3.
set -euo pipefail
cd "$3"
rm -f a.glb b.glb c.glb*
"$1" "$2" a.glb
"$1" "$2" b.glb
cmp a.glb b.glb
refuses() {
    local message status=0
    message=$("$@" 2>&1) || status=$?
    [ "$status" != 0 ] && [ -n "$message" ] || { echo "accepted: $*"; exit 1; }
}
echo "no object here" >empty.json
refuses "$1" empty.json c.glb
refuses "$1" missing.json c.glb
refuses "$1" "$2" no/such/folder/c.glb
refuses "$1" "$2"
! ls c.glb* 2>/dev/null
