#!/bin/bash
# Every test that a page of docs/ names is one of the tree $1: in words ("the test `x`", `test_x`), in `ctest -R`, and in the last
# column of the tables of docs/stability.md, where no row is without one.
set -euo pipefail
tests=$(ctest --test-dir "$1" -N | sed -n 's/^ *Test *#[0-9]*: //p')
missing=0
named=0
must_exist() { # PAGE NAME
    named=$((named + 1))
    grep -qx "$2" <<<"$tests" || { echo "$1 names the test $2: there is none"; missing=1; }
}
while IFS=: read -r page name; do
    must_exist "$page" "$name"
done < <(grep -oHE 'tests? `[a-z_0-9]+`|`test_[a-z_0-9]+`' docs/*.md | sed -E 's/:tests? `/:/; s/:`test_/:/; s/`$//')
# A regular expression must find something.
while IFS=: read -r page pattern; do
    named=$((named + 1))
    grep -qE -- "$pattern" <<<"$tests" || { echo "$page: ctest -R '$pattern' finds nothing"; missing=1; }
done < <(grep -oHE "ctest [^\`]*-R '?[^ '\`]+" docs/*.md | sed -E "s/^([^:]*):.*-R '?/\1:/")
while IFS= read -r row; do
    cell=$(sed -E 's/\|[[:space:]]*$//; s/.*\|//' <<<"$row")
    names=$(grep -oE '`[a-z_0-9]+`' <<<"$cell" | tr -d '`' || true)
    # "all of these" closes the list of hard cases.
    [ -n "$names" ] || grep -q 'all of these' <<<"$cell" || { echo "docs/stability.md: no test in: $row"; missing=1; }
    for name in $names; do
        must_exist docs/stability.md "$name"
    done
done < <(sed -n '/^## The table$/,/^## The same bits/p' docs/stability.md | grep '^|' | grep -vE '^\|( Case |-)')
[ "$named" -gt 60 ] || { echo "only $named tests are named: is this script blind?"; missing=1; }
exit $missing
