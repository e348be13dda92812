#!/bin/bash
# Plots the tables that the program $1 left in the folder $2: every figure as SVG and as PNG, beside the tables. Its scripts are
# here, or in the folder $3 beside this one.
set -euo pipefail
folder=$(realpath "$2")
cd "$(dirname "${BASH_SOURCE[0]}")/${3:-.}"
for script in "$1".gnuplot "$1"_*.gnuplot; do
    [ -f "$script" ] || continue
    figure=$folder/${script%.gnuplot}
    # Written beside and renamed: an interrupted run leaves no half a picture.
    gnuplot -e "folder='$folder'; set terminal pngcairo size 900,560 font 'DejaVu Sans,11'; set output '$figure.part'" \
        ../../src/study/style.gnuplot "$script"
    mv "$figure.part" "$figure.png"
    gnuplot -e "folder='$folder'; set terminal svg size 900,560 font 'DejaVu Sans, Arial, sans-serif,11' background 'white'; set output '$figure.part'" \
        ../../src/study/style.gnuplot "$script"
    mv "$figure.part" "$figure.svg"
done
