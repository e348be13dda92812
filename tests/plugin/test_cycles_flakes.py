# SPDX-License-Identifier: GPL-3.0-or-later
"""libglint's explicit model and Cycles show the same flakes: correlation above .995, means within half a percent.

    python3 test_cycles_flakes.py GLINT FOLDER SHAPE DISTRIBUTION LIGHT [SAMPLES]

Sampling noise costs correlation, nearly all of it that of Cycles: with these numbers of samples .0008 to .003 of the .005 allowed.
Where the mean is not known to half a percent, on the sphere, `glint compare` lets two standard errors pass. With SAMPLES the test
is the proof: two standard errors must be less than half a percent too (`./dev study cycles`).
"""

import json
import os
import subprocess
import sys

import flake_scene

HERE = os.path.dirname(os.path.realpath(__file__))
REFERENCE = os.path.join(HERE, "..", "..", "plugin", "blender", "reference.py")
SIZE = "96x96"
# Of the sphere the part that holds nine tenths of its light; the rim has far more flakes in a pixel, and takes samples for them.
TILE = {"plane": "0,0,96,96", "sphere": "21,21,54,54"}
SAMPLES = {"plane": "768", "sphere": "1536"}
MEAN = 0.005
# The explicit model needs few: of a plane its samples share a pixel's flakes out exactly; a sphere bends within a pixel.
OUR_SAMPLES = {"plane": 16, "sphere": 256}
OURS_IN_PROOF = 16  # times as many, lest they be the noise that is left


def run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}:\n{done.stdout}\nexit code {done.returncode}")
    return done.stdout


def main():
    glint, folder, shape, distribution, light = sys.argv[1:6]
    is_proof = len(sys.argv) > 6
    samples = sys.argv[6] if is_proof else SAMPLES[shape]
    part = ("--size", SIZE, "--tile", TILE[shape])
    os.makedirs(folder, exist_ok=True)
    name = os.path.join(folder, f"{shape}_{distribution}_{light}")
    scene, ours, cycles = (name + end for end in (".glb", ".exr", "_cycles.exr"))
    flake_scene.write_glb(scene, *flake_scene.scene(shape, distribution, light))
    run(glint, "render", scene, "-o", ours, "--model", "explicit", "--facets", "cycles", *part, "--spp",
        str(OUR_SAMPLES[shape] * (OURS_IN_PROOF if is_proof else 1)), "--bounces", "0")
    run("blender", "-b", "--factory-startup", "--python-exit-code", "3", "-P", REFERENCE, "--", scene, "-o", cycles,
        *part, "--spp", samples)
    with open(name + "_cycles.json", encoding="utf-8") as file:
        record = json.load(file)
    assert record["materials"]["flakes"]["seed"] == 5, record
    found = json.loads(run(glint, "compare", cycles, ours, "--same-facets", "--json", "-o", name + ".html"))
    mean = found["mean"]["luminance"]
    print(f"correlation {found['correlation']:.5f}, mean ratio {mean['ratio']:.4f} +- {mean['standard_error']:.4f}")
    if is_proof and not (abs(mean["ratio"] - 1.0) < MEAN and 2.0 * mean["standard_error"] < MEAN):
        sys.exit(f"expected a mean ratio of 1 +- {MEAN}, known to two standard errors of less")


if __name__ == "__main__":
    main()
