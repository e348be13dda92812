#!/bin/bash
# Builds and runs a C and a C++ program that find libglint by CMake's find_package in the moved tree.
set -euo pipefail
cmake -S "$(dirname "$0")/project" -B "$1/project" -G Ninja -DCMAKE_PREFIX_PATH="$1/moved" --log-level=WARNING
cmake --build "$1/project"
"$1/project/consumer_c"
"$1/project/consumer_cpp"
