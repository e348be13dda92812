# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on inside Blender: properties, presets, nodes, UV maps, glTF files, one Blender for all cases."""

import os
import sys
import unittest

import bpy

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import blender_case
import cases_gltf
import cases_nodes
import cases_presets
import cases_properties
import cases_stretch
from blender_case import fresh


class Registration(unittest.TestCase):
    def test_add_on_comes_and_goes_without_a_trace(self):
        import addon_utils

        fresh()
        for _ in range(3):
            addon_utils.disable("glint", default_set=True)
            self.assertFalse(hasattr(bpy.types.Material, "glint"))
            self.assertIsNotNone(addon_utils.enable("glint", default_set=True))
            self.assertTrue(hasattr(bpy.types.Material, "glint"))


blender_case.run(
    cases_properties.Properties, cases_presets.Presets, cases_nodes.Nodes, cases_stretch.Stretch, cases_gltf.GltfFiles,
    Registration,
)
