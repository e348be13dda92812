# SPDX-License-Identifier: GPL-3.0-or-later
"""The Cycles reference of a scene: every flake of its glint materials, with the settings that make it a truth.

    blender -b --python-exit-code 3 -P plugin/blender/reference.py -- SCENE.glb|SCENE.blend -o REF.exr [options]

Writes scene-linear float32 and, beside it, REF.json with what it depends on. `glint render SCENE.glb --model explicit --facets
cycles` shows the same flakes, so that `glint compare` can hold the two against each other pixel by pixel.
"""

import os
import runpy

runpy.run_path(os.path.join(os.path.dirname(os.path.realpath(__file__)), "glint", "reference_command.py"),
               run_name="__main__")
