# SPDX-License-Identifier: GPL-3.0-or-later
"""The Cycles reference of a glTF scene: every flake of its glint materials, with the settings that make it a truth.

    blender -b --python-exit-code 3 -P plugin/blender/reference.py -- SCENE.glb -o REF.exr [options]

Writes scene-linear float32 and, beside it, REF.json with what it depends on. `glint render SCENE.glb --model explicit --facets
cycles` shows the same flakes, so that `glint compare` can hold the two against each other pixel by pixel.
"""

import argparse
import json
import os
import sys

import bpy

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, HERE)

import addon_utils  # noqa: E402

addon_utils.enable("glint", default_set=True)

from glint import reference  # noqa: E402


def parse(arguments):
    parser = argparse.ArgumentParser(prog="reference.py", description="Renders the Cycles reference of a glTF scene.")
    parser.add_argument("scene", help="glTF 2.0 file (.gltf, .glb)")
    parser.add_argument("-o", "--output", required=True, help="picture to write, .exr")
    parser.add_argument("--size", default="1280x720", help="pixels, WxH")
    parser.add_argument("--spp", type=int, default=0, help="samples per pixel; 0: from the flakes in a pixel")
    parser.add_argument("--camera", default="", help="name of a camera of the file; the first without it")
    parser.add_argument("--smooth", action="store_true", help="without single flakes")
    parser.add_argument("--bounces", type=int, default=0, help="of indirect light")
    parser.add_argument("--seed", type=int, default=0, help="of the sampling")
    parser.add_argument("--threads", type=int, default=0, help="0: one a core")
    values = parser.parse_args(arguments)
    try:
        values.width, values.height = (int(side) for side in values.size.lower().split("x"))
    except ValueError:
        parser.error(f"--size '{values.size}': expected WxH")
    if not values.output.lower().endswith(".exr"):
        parser.error(f"--output '{values.output}': expected a name that ends in .exr")
    if not os.path.isfile(values.scene):
        parser.error(f"{values.scene}: no such file")
    return values


def main():
    values = parse(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    scene = reference.open_scene(values.scene, values.camera)
    record = reference.render(scene, values)
    with open(os.path.splitext(values.output)[0] + ".json", "w", encoding="utf-8") as file:
        json.dump(record, file, indent=2)
    print(f"{values.output}: {values.width}x{values.height}, {record['spp']} spp, {record['seconds']:.1f} s")


if __name__ == "__main__":
    main()
