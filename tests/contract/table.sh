#!/bin/bash
# Holds docs/contract.md to what the contract tests have just shown (the rows in the folder $1). With --update as $2 the page is
# written anew.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
page() {
    cat <<'END'
# What every model promises, and where it is tested

Written by `bash tests/contract/table.sh build/release/tests/contract/table --update` after `ctest --preset release -R contract`
from what the tests have shown; a test holds this page to it. Every model is taken through eight configurations: GGX and
Beckmann, isotropic and 4:1, both weightings, rough and elongated facets, half coverage, dielectric over a diffuse base, conductor,
tinted ([configurations.h](../tests/contract/configurations.h)).

END
    cat "$1"/head "$1"/[0-9][0-9]
    cat <<'END'

Footnotes: (1) explicit, also as a layer, knows the true directions of a light of finite size; exchanging light and viewer exchanges only the middle
of the light with the viewer. (2) No footprint in sampling: density and weight are the smooth ones, bit for bit, whatever footprint is
given. (3) Up to 1500 facets under a pixel, for it visits them all. (4) With facets that are
mirrors. The lobes of rough ones widen D, which the other models leave as it is: 4 % less in the mean for a lobe of 0.02 on a
roughness of 0.25. (5) Where every layer that shows facets knows it; else (2). Bounds, and how they are derived, are in the tests; what was measured at
length is in [truth.md](truth.md).
END
}
if [ "${2:-}" = --update ]; then
    page "$1" >docs/contract.md
else
    diff <(page "$1") docs/contract.md || {
        echo "docs/contract.md is not what the tests have shown: bash tests/contract/table.sh $1 --update"
        exit 1
    }
fi
