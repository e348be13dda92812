# SPDX-License-Identifier: GPL-3.0-or-later
"""UV maps: metres per unit and stretching, on meshes whose maps are known."""

import unittest

import bpy

from blender_case import fresh, new_material, operate


class Stretch(unittest.TestCase):
    def setUp(self):
        fresh()

    def test_square_of_two_metres_has_two_metres_per_unit(self):
        from glint import stretch

        bpy.ops.mesh.primitive_plane_add(size=1.0)
        plane = bpy.context.object
        plane.scale = (2.0, 2.0, 2.0)
        bpy.context.view_layer.update()
        found = stretch.of_object(plane)
        for value in (found.least, found.middle, found.most):
            self.assertAlmostEqual(value, 2.0, places=5)
        self.assertAlmostEqual(found.anisotropy, 1.0, places=5)
        self.assertEqual(stretch.warnings(found, 2.0), [])
        self.assertEqual(len(stretch.warnings(found, 1.0)), 1)

    def test_uneven_scale_is_longer_one_way(self):
        from glint import stretch

        bpy.ops.mesh.primitive_plane_add(size=1.0)
        plane = bpy.context.object
        plane.scale = (4.0, 1.0, 1.0)
        bpy.context.view_layer.update()
        found = stretch.of_object(plane)
        self.assertAlmostEqual(found.middle, 2.0, places=5)  # the root of the area
        self.assertAlmostEqual(found.anisotropy, 4.0, places=4)
        self.assertIn("4 times longer one way", " ".join(stretch.warnings(found, 2.0)))

    def test_map_that_gives_half_the_surface_a_quarter_of_itself_stretches(self):
        from glint import stretch

        bpy.ops.mesh.primitive_grid_add(x_subdivisions=10, y_subdivisions=1, size=1.0)
        mesh = bpy.context.object.data
        for loop, uv in zip(mesh.loops, mesh.uv_layers[0].data):
            x = mesh.vertices[loop.vertex_index].co.x + 0.5
            # Half of the width has a quarter of the unit: two metres per unit along u; the rest 2 / 3.
            uv.uv = (0.5 * x if x <= 0.5 else 0.25 + 1.5 * (x - 0.5), uv.uv[1])
        found = stretch.of_object(bpy.context.object)
        self.assertAlmostEqual(found.most, 2.0**0.5, places=4)
        self.assertAlmostEqual(found.least, (2.0 / 3.0) ** 0.5, places=4)
        self.assertIn("UVs stretch", stretch.warnings(found, found.middle)[0])

    def test_sphere_stretches_by_the_sine_of_its_latitude(self):
        from glint import stretch

        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=1.0)
        found = stretch.of_object(bpy.context.object)
        # u spans 2 pi sin(theta), v pi: sqrt(2 sin(theta)) pi, and 2 % of the area lie where cos(theta) > .98.
        self.assertAlmostEqual(found.most, 2.0**0.5 * 3.14159, delta=0.03)
        self.assertAlmostEqual(found.least, (2.0 * (1.0 - 0.98**2) ** 0.5) ** 0.5 * 3.14159, delta=0.12)

    def test_measure_sets_the_scale(self):
        material = new_material()
        bpy.context.object.scale = (3.0, 3.0, 3.0)
        bpy.context.view_layer.update()
        operate(bpy.ops.glint.take_uv_scale, material, coat=False)
        self.assertAlmostEqual(material.glint.uv_scale, 3.0, places=5)

    def test_mesh_without_a_map_has_no_stretch(self):
        from glint import stretch

        bpy.ops.mesh.primitive_plane_add()
        mesh = bpy.context.object.data
        mesh.uv_layers.remove(mesh.uv_layers[0])
        self.assertIsNone(stretch.of_object(bpy.context.object))
