# SPDX-License-Identifier: GPL-3.0-or-later
"""The Cycles reference of a scene from the command line: every flake, with the settings that make it a truth.

    blender -b --python-exit-code 3 -P reference_command.py -- SCENE.glb|SCENE.blend -o REF.exr [options]
"""

import argparse
import json
import os
import sys


def _tile(parser, values):
    try:
        left, top, width, height = (int(number) for number in values.tile.split(","))
    except ValueError:
        parser.error(f"--tile '{values.tile}': expected X,Y,WIDTH,HEIGHT")
    if min(left, top) < 0 or min(width, height) < 1 or left + width > values.width or top + height > values.height:
        parser.error(f"--tile '{values.tile}': expected a part of the {values.width}x{values.height} pixels")
    return left, top, width, height


def parse(arguments):
    parser = argparse.ArgumentParser(prog="reference.py", description="Renders the Cycles reference of a scene.")
    parser.add_argument("scene", help="glTF 2.0 file (.gltf, .glb) or .blend")
    parser.add_argument("-o", "--output", required=True, help="picture to write, .exr")
    parser.add_argument("--size", default="1280x720", help="pixels, WxH")
    parser.add_argument("--tile", default="", help="part to render, X,Y,WIDTH,HEIGHT from the upper left; without it all")
    parser.add_argument("--spp", type=int, default=0, help="samples per pixel; 0: from the flakes in a pixel")
    parser.add_argument("--camera", default="", help="name of a camera of the file; without it the active or the first")
    parser.add_argument("--smooth", action="store_true", help="without single flakes")
    parser.add_argument("--world", action="store_true", help="keep the world's light of a .blend file")
    parser.add_argument("--bounces", type=int, default=0, help="of indirect light")
    parser.add_argument("--seed", type=int, default=0, help="of the sampling")
    parser.add_argument("--threads", type=int, default=0, help="0: one a core")
    values = parser.parse_args(arguments)
    try:
        values.width, values.height = (int(side) for side in values.size.lower().split("x"))
    except ValueError:
        parser.error(f"--size '{values.size}': expected WxH")
    values.tile = _tile(parser, values) if values.tile else None
    if not values.output.lower().endswith(".exr"):
        parser.error(f"--output '{values.output}': expected a name that ends in .exr")
    if not os.path.isfile(values.scene):
        parser.error(f"{values.scene}: no such file")
    return values


def main():
    from glint import reference

    values = parse(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    scene = reference.open_scene(values.scene, values.camera)
    record = reference.render(scene, values)
    sidecar = os.path.splitext(values.output)[0] + ".json"
    with open(sidecar + ".part", "w", encoding="utf-8") as file:
        json.dump(record, file, indent=2)
    os.replace(sidecar + ".part", sidecar)
    print(f"{values.output}: {values.width}x{values.height}, {record['spp']} spp, {record['seconds']:.1f} s")


if __name__ == "__main__":
    # The folder that holds the add-on's: this file is run by its path, wherever the add-on is installed.
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
    import addon_utils

    addon_utils.enable("glint", default_set=True)
    main()
