#!/bin/bash
# Builds and runs a C program with the flags that pkg-config gives for the moved tree.
set -euo pipefail
export PKG_CONFIG_PATH="$1/moved/lib/pkgconfig"
read -ra flags < <(pkg-config --cflags --libs libglint)
cc -std=c11 "$(dirname "$0")/project/consumer.c" -o "$1/consumer" "${flags[@]}" -lm
LD_LIBRARY_PATH="$1/moved/lib" "$1/consumer"
