#!/bin/bash
# hello_glint writes a whole PGM of 256 x 64 pixels, the same each time, in which neighbours differ as flakes do: some pixels
# have no lit flake and are black, some are white.
set -euo pipefail
picture=$("$1")
[ "$picture" = "$("$1")" ] || { echo "two runs differ"; exit 1; }
awk '
    NR == 1 { if ($0 != "P2 256 64 255") { print "header: " $0; exit bad = 1 } next }
    !/^[0-9]+$/ || $1 > 255 { print "line " NR ": " $0; exit bad = 1 }
    { count++; if ($1 == 0) black++; if ($1 == 255) white++ }
    END {
        if (bad) exit 1
        print count " pixels, " black + 0 " black, " white + 0 " white"
        exit !(count == 256 * 64 && black > 0 && white > 0)
    }' <<<"$picture"
