# SPDX-License-Identifier: GPL-3.0-or-later
"""The packed add-on installs into a clean Blender by Blender's own operator and works from there.

    blender -b --factory-startup --python-exit-code 3 -P test_install.py -- ZIP FOLDER

BLENDER_USER_SCRIPTS must point into FOLDER, which is where Blender then puts it.
"""

import os
import subprocess
import sys

import bpy

archive, folder = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
bpy.ops.preferences.addon_enable(module="glint")
import glint  # noqa: E402
from glint import presets  # noqa: E402

assert os.path.realpath(glint.__file__).startswith(os.path.realpath(folder)), glint.__file__
assert "glint" in bpy.context.preferences.addons
names = presets.available()
assert len(names) >= 8 and all(path.startswith(os.path.dirname(glint.__file__)) for path in names.values()), names

assert os.path.isfile(os.path.join(os.path.dirname(glint.__file__), "blender_manifest.toml"))
from glint import preferences  # noqa: E402

command = preferences.find_command(bpy.context)
own = os.path.join(os.path.dirname(os.path.realpath(glint.__file__)), "bin", "glint")
# ./dev addon packs the command where it has been built; it must run after Blender has unpacked it.
if os.path.isfile(own):
    assert command == own and "glint" in subprocess.run([command, "--version"], capture_output=True, text=True).stdout

material = bpy.data.materials.new("snow")
material.use_nodes = True
with bpy.context.temp_override(material=material):
    assert bpy.ops.glint.apply_preset(name="snow") == {"FINISHED"}
    assert bpy.ops.glint.build_nodes() == {"FINISHED"}
assert material.glint.enabled
bpy.ops.preferences.addon_disable(module="glint")
assert not hasattr(bpy.types.Material, "glint")
