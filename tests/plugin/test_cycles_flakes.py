# SPDX-License-Identifier: GPL-3.0-or-later
"""libglint's explicit model and Cycles show the same flakes: correlation above .995, means within half a percent.

    python3 test_cycles_flakes.py GLINT FOLDER SHAPE DISTRIBUTION LIGHT [SAMPLES]

Sampling noise costs correlation, nearly all of it that of Cycles: with these numbers of samples .0008 to .003 of the .005 allowed.
Where the mean is not known to half a percent, at the rim of the sphere, `glint compare` lets two standard errors pass;
`./dev study cycles` has samples enough.
"""

import json
import os
import subprocess
import sys

import flake_scene

HERE = os.path.dirname(os.path.realpath(__file__))
REFERENCE = os.path.join(HERE, "..", "..", "plugin", "blender", "reference.py")
SIZE, SAMPLES = "96x96", "768"
# The explicit model needs few: of a plane its samples share a pixel's flakes out exactly; a sphere bends within a pixel.
OUR_SAMPLES = {"plane": "16", "sphere": "256"}


def run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}:\n{done.stdout}\nexit code {done.returncode}")
    return done.stdout


def main():
    glint, folder, shape, distribution, light = sys.argv[1:6]
    samples = sys.argv[6] if len(sys.argv) > 6 else SAMPLES
    os.makedirs(folder, exist_ok=True)
    name = os.path.join(folder, f"{shape}_{distribution}_{light}")
    scene, ours, cycles = (name + end for end in (".glb", ".exr", "_cycles.exr"))
    flake_scene.write_glb(scene, *flake_scene.scene(shape, distribution, light))
    run(glint, "render", scene, "-o", ours, "--model", "explicit", "--facets", "cycles", "--size", SIZE, "--spp",
        OUR_SAMPLES[shape], "--bounces", "0")
    run("blender", "-b", "--factory-startup", "--python-exit-code", "3", "-P", REFERENCE, "--", scene, "-o", cycles,
        "--size", SIZE, "--spp", samples)
    with open(name + "_cycles.json", encoding="utf-8") as file:
        record = json.load(file)
    assert record["materials"]["flakes"]["seed"] == 5, record
    found = json.loads(run(glint, "compare", cycles, ours, "--same-facets", "--json", "-o", name + ".html"))
    print(f"correlation {found['correlation']:.5f}, mean ratio {found['mean']['luminance']['ratio']:.4f} "
          f"+- {found['mean']['luminance']['standard_error']:.4f}")


if __name__ == "__main__":
    main()
