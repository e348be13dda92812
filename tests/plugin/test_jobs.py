# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference and the comparison from within Blender: pictures, records, a report, and messages for what is missing.

    blender -b --factory-startup --python-exit-code 3 -P test_jobs.py -- FOLDER GLINT
"""

import contextlib
import io
import json
import math
import os
import random
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import bpy

import blender_case
from blender_case import folder, fresh, new_material


def stage():
    """A square metre of glitter under a sun, 64 x 64 pixels of it."""
    material = new_material()
    group = material.glint
    group.enabled, group.density_per_cm2, group.facet_roughness = True, 2.0, 0.2
    material.node_tree.nodes["Principled BSDF"].inputs["Metallic"].default_value = 1.0
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Eye", bpy.data.cameras.new("Eye"))
    camera.data.type, camera.data.ortho_scale, camera.location = "ORTHO", 0.5, (0.0, 0.0, 2.0)
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.angle, sun.rotation_euler = 0.1, (math.radians(20.0), 0.0, 0.0)
    for object_ in (camera, sun):
        scene.collection.objects.link(object_)
    scene.camera = camera
    scene.render.resolution_x = scene.render.resolution_y = 64
    scene.glint_reference.samples = 256
    return scene


class Jobs(unittest.TestCase):
    def setUp(self):
        fresh()

    def test_reference_and_report_from_the_scene_at_hand(self):
        scene = stage()
        bpy.context.preferences.addons["glint"].preferences.command = sys.argv[-1]
        start = os.path.join(folder(), "scene")
        scene.glint_reference.path = start + ".exr"
        engine, samples = scene.render.engine, scene.cycles.samples
        self.assertEqual(bpy.ops.glint.render_reference(), {"FINISHED"})
        self.assertEqual((scene.render.engine, scene.cycles.samples), (engine, samples))
        with open(start + ".json", encoding="utf-8") as file:
            record = json.load(file)
        self.assertEqual((record["size"], record["spp"], record["camera"]), ([64, 64], 256, "Eye"))
        self.assertEqual(record["materials"]["flakes"]["density_per_m2"], 2e4)
        self.assertAlmostEqual(record["materials"]["flakes"]["alpha"][1], 0.25, places=6)
        self.assertEqual(bpy.ops.glint.compare(), {"FINISHED"})
        with open(start + ".html", encoding="utf-8") as file:
            page = file.read()
        found = json.loads(page[page.index("{", page.index("application/json")) : page.index("</script>", page.index(
            "application/json"))])
        self.assertTrue(found["same_facets"], found["checks"])
        self.assertGreater(found["correlation"], 0.99)

    def test_what_is_missing_is_said(self):
        scene = stage()
        with self.assertRaisesRegex(RuntimeError, "Save the file first"):
            bpy.ops.glint.render_reference()
        scene.glint_reference.path = "/tmp/picture.png"
        with self.assertRaisesRegex(RuntimeError, "ends in .exr"):
            bpy.ops.glint.render_reference()
        scene.glint_reference.path = os.path.join(folder(), "nothing.exr")
        bpy.context.preferences.addons["glint"].preferences.command = sys.argv[-1]
        with self.assertRaisesRegex(RuntimeError, "render the reference first"):
            bpy.ops.glint.compare()
        bpy.context.preferences.addons["glint"].preferences.command = "/nowhere/glint"
        with self.assertRaisesRegex(RuntimeError, "glint command is neither"):
            bpy.ops.glint.compare()
        bpy.context.preferences.addons["glint"].preferences.command = sys.argv[-1]
        scene.camera = None
        for operator in (bpy.ops.glint.render_reference, bpy.ops.glint.compare):
            with self.assertRaisesRegex(RuntimeError, "no camera"):
                operator()


class Tiles(unittest.TestCase):
    def setUp(self):
        fresh()

    def test_any_tile_becomes_its_pixels(self):
        """Blender keeps borders as fractions in single precision."""
        from glint import reference, scene_camera

        numbers = random.Random(1)
        scene = bpy.context.scene
        render = scene.render
        for _ in range(2000):
            width, height = numbers.randint(4, 8192), numbers.randint(4, 8192)
            render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
            left, top = numbers.randrange(width), numbers.randrange(height)
            wide, high = numbers.randint(1, width - left), numbers.randint(1, height - top)
            reference.choose_tile(render, (left, top, wide, high))
            self.assertEqual(scene_camera.border(scene), (left, height - top - high, wide, high), (width, height, left, top))
        reference.choose_tile(render, None)
        self.assertFalse(render.use_border)

    def test_tiles_that_make_no_sense_are_refused(self):
        from glint import reference_command

        for tile in ("1,2,3", "a,b,c,d", "-1,0,4,4", "0,0,0,4", "60,0,5,4", "0,61,4,4"):
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()) as said:
                reference_command.parse([__file__, "-o", "out.exr", "--size", "64x64", f"--tile={tile}"])
            self.assertIn("--tile", said.getvalue())
        values = reference_command.parse([__file__, "-o", "out.exr", "--size", "64x64", "--tile", "60,0,4,64"])
        self.assertEqual(values.tile, (60, 0, 4, 64))


blender_case.run(Jobs, Tiles)
