# SPDX-License-Identifier: GPL-3.0-or-later
"""The property group: what the sliders mean, keyframes, drivers, the readout."""

import math
import unittest

import bpy

from blender_case import fresh, new_material


class Properties(unittest.TestCase):
    def setUp(self):
        fresh()

    def test_density_exponent_is_the_source_of_density_and_size(self):
        group = new_material().glint
        group.density_exponent = 2.0
        self.assertAlmostEqual(group.density_per_cm2, 100.0, delta=0.01)
        self.assertAlmostEqual(group.facet_size_um, 1000.0, delta=0.1)
        group.facet_size_um = 100.0
        self.assertAlmostEqual(group.density_exponent, 4.0, places=5)
        group.density_per_cm2 = 7e4
        self.assertAlmostEqual(group.density_exponent, math.log10(7e4), places=5)

    def test_properties_can_be_keyframed_and_driven(self):
        material = new_material()
        material.glint.density_exponent = 1.0
        material.glint.keyframe_insert("density_exponent", frame=1)
        material.glint.density_exponent = 5.0
        material.glint.keyframe_insert("density_exponent", frame=11)
        bpy.context.scene.frame_set(6)
        self.assertAlmostEqual(material.glint.density_exponent, 3.0, places=4)
        curve = material.driver_add("glint.factor")
        curve.driver.expression = "0.25"
        bpy.context.view_layer.update()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        self.assertAlmostEqual(material.evaluated_get(depsgraph).glint.factor, 0.25, places=6)

    def test_readout_knows_the_flakes_in_a_pixel(self):
        from glint import readout

        material = new_material()
        material.glint.density_per_cm2 = 1e4  # 1e8 a square metre
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        bpy.context.collection.objects.link(camera)
        camera.location = (0.0, 0.0, 2.0)
        camera.data.type, camera.data.ortho_scale = "ORTHO", 1.0
        scene = bpy.context.scene
        scene.camera, scene.render.resolution_x, scene.render.resolution_y = camera, 1000, 1000
        bpy.context.view_layer.update()
        first, second = readout.lines(scene, bpy.context.object, material.glint, alpha=0.3)
        self.assertEqual(first, "100 flakes per pixel")
        # A hundredth of the sun's solid angle in a lobe of alpha .3: 100 * 6.8e-5 / (4 pi .09).
        self.assertEqual(second, "0.00601 glints per pixel under the sun")
        # 50 mm on a sensor of 36 mm, two metres away: a pixel is 1.44 mm wide.
        camera.data.type = "PERSP"
        camera.data.lens, camera.data.sensor_width = 50.0, 36.0
        side = readout.pixel_side_m(scene, bpy.context.object)
        self.assertAlmostEqual(side, 2.0 * 36.0 / 50.0 / 1000.0, places=9)

    def test_coat_has_flakes_of_its_own(self):
        group = new_material().glint
        group.density_exponent, group.coat.density_exponent = 5.0, 2.0
        group.coat.colors.add().color = (1.0, 0.0, 0.0)
        self.assertAlmostEqual(group.density_per_cm2, 1e5, delta=1.0)
        self.assertEqual((len(group.colors), len(group.coat.colors)), (0, 1))

    def test_copy_of_a_material_keeps_everything(self):
        from glint import extension

        material = new_material()
        group = material.glint
        group.enabled, group.seed, group.space, group.uv_scale = True, 7, "OBJECT", 0.3
        group.colors.add().color = (0.5, 0.25, 1.0)
        group.coat.enabled, group.coat.color_variation = True, 0.3
        copy = material.copy()
        self.assertEqual(extension.of_material(copy.glint), extension.of_material(group))
        self.assertIsNotNone(extension.of_material(copy.glint)[1])
