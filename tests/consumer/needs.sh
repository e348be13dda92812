#!/bin/bash
# The library asks the dynamic linker for nothing but libc and libm.
set -euo pipefail
needed=$(readelf --dynamic --wide "$1/moved/lib/libglint.so" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
echo "$needed" | grep -q '^libc\.so' || { echo "readelf shows no need for libc: $needed"; exit 1; }
if echo "$needed" | grep -v -E '^lib[cm]\.so\.[0-9]+$'; then
    echo "libglint.so needs more than libc and libm"
    exit 1
fi
