# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests inside Blender share: the add-on from this checkout, and a runner whose exit code is the truth.

    blender -b --factory-startup --python-exit-code 3 -P test_x.py -- FOLDER
"""

import json
import os
import struct
import sys
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "plugin", "blender"))
sys.path.insert(0, HERE)

import bpy  # noqa: E402


def fresh():
    """An empty file with the add-on on."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    import addon_utils

    if addon_utils.enable("glint", default_set=True) is None:
        raise RuntimeError("the add-on does not register")


def folder():
    """A folder for files, from the command line."""
    path = sys.argv[sys.argv.index("--") + 1]
    os.makedirs(path, exist_ok=True)
    return path


def new_material(name="flakes"):
    """Worn by a new mesh, which is the active object."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    mesh_object().data.materials.append(material)
    return material


def mesh_object():
    """A square metre with a UV map, active."""
    bpy.ops.mesh.primitive_plane_add(size=1.0)
    return bpy.context.object


def operate(operator, material, **settings):
    """Runs an operator as the panel does: with the material in its context."""
    with bpy.context.temp_override(material=material):
        return operator(**settings)


def read_json(path):
    """The JSON chunk of a .glb file."""
    with open(path, "rb") as file:
        header = file.read(20)
        length = struct.unpack("<I", header[12:16])[0]
        return json.loads(file.read(length))


def export(name):
    """Writes the scene; returns the file's path and its JSON."""
    from glint import compat

    path = os.path.join(folder(), name)
    compat.export_gltf(path, export_lights=True, export_cameras=True)
    return path, read_json(path)


def run(*cases):
    """Runs test cases; Blender's exit code is 3 when one fails."""
    suite = unittest.TestSuite(unittest.defaultTestLoader.loadTestsFromTestCase(case) for case in cases)
    result = unittest.TextTestRunner(verbosity=2, stream=sys.stdout).run(suite)
    if not result.wasSuccessful() or result.testsRun == 0:
        sys.stdout.flush()
        raise RuntimeError("tests failed")
