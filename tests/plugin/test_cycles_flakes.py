# SPDX-License-Identifier: GPL-3.0-or-later
"""libglint's explicit model and Cycles show the same flakes: correlation above .995, means within half a percent.

    python3 test_cycles_flakes.py GLINT FOLDER SHAPE DISTRIBUTION

Both pictures have sampling noise, which costs correlation; with these numbers of samples .0008 to .0015 of the .005 allowed is
lost, noise included.
"""

import json
import os
import subprocess
import sys

import flake_scene

HERE = os.path.dirname(os.path.realpath(__file__))
REFERENCE = os.path.join(HERE, "..", "..", "plugin", "blender", "reference.py")
SIZE, SAMPLES = "96x96", "768"


def run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}:\n{done.stdout}\nexit code {done.returncode}")
    return done.stdout


def main():
    glint, folder, shape, distribution = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    scene, ours, cycles = (os.path.join(folder, f"{shape}_{distribution}{end}") for end in (".glb", ".exr", "_cycles.exr"))
    flake_scene.write_glb(scene, *flake_scene.scene(shape, distribution))
    run(glint, "render", scene, "-o", ours, "--model", "explicit", "--facets", "cycles", "--size", SIZE, "--spp", SAMPLES,
        "--bounces", "0")
    run("blender", "-b", "--factory-startup", "--python-exit-code", "3", "-P", REFERENCE, "--", scene, "-o", cycles,
        "--size", SIZE, "--spp", SAMPLES)
    with open(os.path.splitext(cycles)[0] + ".json", encoding="utf-8") as file:
        record = json.load(file)
    assert record["materials"]["flakes"]["seed"] == 5, record
    found = json.loads(run(glint, "compare", cycles, ours, "--same-facets", "--json",
                           "-o", os.path.join(folder, f"{shape}_{distribution}.html")))
    print(f"correlation {found['correlation']:.5f}, mean ratio {found['mean']['luminance']['ratio']:.4f} "
          f"+- {found['mean']['luminance']['standard_error']:.4f}")


if __name__ == "__main__":
    main()
