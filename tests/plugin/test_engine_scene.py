# SPDX-License-Identifier: GPL-3.0-or-later
"""What the engine takes from a scene, held against Cycles and against geometry that is known: cameras, lights, worlds, textures,
instances, units, and what a million triangles take.

    blender -b --factory-startup --python-exit-code 3 -P test_engine_scene.py -- FOLDER
"""

import json
import math
import os
import sys
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import bpy
import numpy
from bpy_extras.object_utils import world_to_camera_view

import blender_case
from engine_case import (add_camera, add_light, add_plane, black_world, connect_image, flakes, link, matte, new_image,
                         new_material, new_scene, render, render_with_cycles)


def described():
    from glint import scene_data

    bpy.context.view_layer.update()
    return scene_data.describe(bpy.context.evaluated_depsgraph_get())


class Cameras(unittest.TestCase):
    def test_points_are_where_blender_projects_them(self):
        """A small glowing ball: its middle in the picture is that of its centre, to a tenth of a pixel."""
        settings = [
            {"sensor_fit": "AUTO", "lens": 35.0},
            {"sensor_fit": "VERTICAL", "lens": 28.0, "sensor_height": 18.0},
            {"sensor_fit": "HORIZONTAL", "lens": 40.0, "shift_x": 0.15, "shift_y": -0.1},
            {"type": "ORTHO", "ortho_scale": 5.0, "shift_x": -0.1},
        ]
        for size in ((64, 48), (40, 64)):
            for camera_settings in settings:
                with self.subTest(size=size, **camera_settings):
                    scene = new_scene(*size, 16)
                    black_world()
                    glow = new_material("glow", Emission=(1.0, 1.0, 1.0, 1.0), Base_Color=(0.0, 0.0, 0.0, 1.0), Specular=0.0)
                    at = (0.3, 0.2, 0.35)
                    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.15, location=at)
                    bpy.context.object.data.materials.append(glow)
                    camera = add_camera((1.0, -6.0, 2.0), (1.3, 0.05, 0.15), **camera_settings)
                    bpy.context.view_layer.update()
                    light = render()[..., 0].astype(float)
                    self.assertGreater(light.sum(), 1.0)
                    ys, xs = numpy.mgrid[0 : size[1], 0 : size[0]] + 0.5
                    found = (light * xs).sum() / light.sum(), (light * ys).sum() / light.sum()
                    wanted = world_to_camera_view(scene, camera, bpy.context.object.location.__class__(at))
                    self.assertAlmostEqual(found[0], wanted.x * size[0], delta=0.1)
                    self.assertAlmostEqual(found[1], wanted.y * size[1], delta=0.1)


class AgainstCycles(unittest.TestCase):
    """Means of pictures of diffuse surfaces: both renderers have noise of a per cent at most with these samples."""

    def lit(self, kind, energy, **settings):
        new_scene(32, 24, 64)
        black_world()
        add_plane(matte(), 6.0)
        add_light(kind, energy, **settings)
        add_camera((0.0, -4.0, 4.0), (0.75, 0.0, 0.0))
        return render(), render_with_cycles()

    def compare(self, ours, theirs, bound=0.02):
        ratio = ours[..., :3].mean() / theirs[..., :3].mean()
        print(f"ratio to Cycles {ratio:.4f}")
        self.assertAlmostEqual(ratio, 1.0, delta=bound)

    def test_lights_are_as_bright(self):
        for kind, energy, settings in (
            ("SUN", 3.0, {"rotation": (0.4, 0.2, 0.0), "angle": 0.1, "color": (1.0, 0.5, 0.2)}),
            ("POINT", 200.0, {"location": (1.0, 0.5, 2.0), "shadow_soft_size": 0.2}),
            ("AREA", 100.0, {"location": (0.5, 0.0, 2.0), "rotation": (0.3, 0.2, 0.5), "shape": "RECTANGLE", "size": 1.5,
                             "size_y": 0.5}),
            ("AREA", 100.0, {"location": (0.5, 0.0, 2.0), "shape": "DISK", "size": 1.0}),
        ):
            with self.subTest(kind=kind):
                self.compare(*self.lit(kind, energy, **settings))

    def test_the_middle_of_a_spot_is_as_bright(self):
        # glTF's soft edge is another curve than Cycles', so only the part inside the inner cone is compared.
        ours, theirs = self.lit("SPOT", 300.0, location=(0.0, 0.0, 3.0), spot_size=1.6, spot_blend=0.1, shadow_soft_size=0.05)
        self.compare(ours[11:14, 14:18], theirs[11:14, 14:18])

    def world_with_map(self, strength=0.7):
        world = black_world()
        rows = numpy.zeros((16, 32, 4), numpy.float32)
        rows[..., 0] = numpy.linspace(0.1, 1.0, 32)[None, :]
        rows[..., 1] = numpy.linspace(1.0, 0.2, 16)[:, None]
        rows[..., 2] = (numpy.arange(32) % 8 < 4)[None, :]
        rows[..., 3] = 1.0
        tree = world.node_tree
        node = tree.nodes.new("ShaderNodeTexEnvironment")
        node.image = new_image("sky", rows, float_buffer=True)
        mapping, coordinates = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeTexCoord")
        mapping.inputs["Rotation"].default_value = (0.0, 0.0, 0.6)
        tree.links.new(coordinates.outputs["Generated"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs["Vector"], node.inputs["Vector"])
        tree.links.new(node.outputs["Color"], tree.nodes["Background"].inputs["Color"])
        tree.nodes["Background"].inputs["Strength"].default_value = strength

    def test_a_world_lies_around_the_scene_as_in_cycles(self):
        for rotation in ((1.3, 0.0, 0.4), (1.8, 0.0, 2.5)):
            new_scene(48, 36, 64)
            self.world_with_map()
            add_camera((0.0, 0.0, 0.0), rotation, lens=18.0)
            ours, theirs = render(), render_with_cycles()
            difference = numpy.abs(ours - theirs)[..., :3]
            # Both blend texels linearly; what differs is where a pixel's samples lie.
            print(f"mean difference {difference.mean():.4f} of {theirs[..., :3].mean():.3f}")
            self.assertLess(difference.mean(), 0.02 * theirs[..., :3].mean())

    def test_a_world_lights_a_surface(self):
        """Even light of radiance L from all around leaves a diffuse plane as albedo times L, from a colour and a map, less
        what Fresnel takes at grazing angles: the mean of (1 - cos)^5 over the hemisphere, 2 / 42."""
        for as_map in (False, True):
            new_scene(16, 12, 256)
            background = black_world().node_tree
            background.nodes["Background"].inputs["Color"].default_value = (0.4, 0.8, 1.2, 1.0)
            if as_map:
                node = background.nodes.new("ShaderNodeTexEnvironment")
                rows = numpy.empty((16, 32, 4), numpy.float32)
                rows[:] = (0.4, 0.8, 1.2, 1.0)
                node.image = new_image("even", rows, float_buffer=True)
                background.links.new(node.outputs["Color"], background.nodes["Background"].inputs["Color"])
            add_plane(matte(), 8.0)
            add_camera((0.0, 0.0, 3.0))
            mean = render()[..., :3].mean(axis=(0, 1))
            print(f"as_map {as_map}: {mean}")
            # 49152 samples of a cosine-weighted estimate: a per cent is far beyond their noise.
            left = 1.0 - 2.0 / 42.0
            numpy.testing.assert_allclose(mean, (0.2 * left, 0.4 * left, 0.6 * left), rtol=0.01)

    def test_a_map_of_the_world_lights_as_in_cycles(self):
        """A white metal ball of roughness .4 under a turned map with a bright window and a coloured ground. Each picture alone is
        known to .2 %: 2000 pixels of 1024 samples."""
        scene = new_scene(64, 64, 1024)
        scene.render.film_transparent = True
        rows = numpy.full((32, 64, 4), 0.3, numpy.float32)
        rows[16:, :, :3] = (0.5, 0.25, 0.1)
        rows[6:11, 10:18, :3] = (8.0, 9.0, 10.0)
        tree = black_world().node_tree
        node, mapping = tree.nodes.new("ShaderNodeTexEnvironment"), tree.nodes.new("ShaderNodeMapping")
        node.image = new_image("window", rows, float_buffer=True)
        mapping.inputs["Rotation"].default_value = (0.2, -0.4, 0.7)
        tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs["Vector"], node.inputs["Vector"])
        tree.links.new(node.outputs["Color"], tree.nodes["Background"].inputs["Color"])
        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)
        bpy.ops.object.shade_smooth()
        bpy.context.object.data.materials.append(
            new_material("metal", Base_Color=(1.0, 1.0, 1.0, 1.0), Metallic=1.0, Roughness=0.4)
        )
        add_camera((0.0, -5.0, 0.5), (1.47, 0.0, 0.0), type="ORTHO", ortho_scale=2.3)
        ours, theirs = render(), render_with_cycles(samples=1024, node="ShaderNodeBsdfGlossy")
        means = [picture[..., :3].mean(axis=(0, 1)) for picture in (ours, theirs)]
        print(f"a map of the world: {means[0]}, Cycles {means[1]}, ratio {means[0] / means[1]}")
        numpy.testing.assert_allclose(means[0], means[1], rtol=0.01)
        # Where the light comes from, too: halves of the picture.
        for half in (slice(0, 32), slice(32, 64)):
            numpy.testing.assert_allclose(ours[:, half, :3].mean(axis=(0, 1)), theirs[:, half, :3].mean(axis=(0, 1)), rtol=0.02)
            numpy.testing.assert_allclose(ours[half, :, :3].mean(axis=(0, 1)), theirs[half, :, :3].mean(axis=(0, 1)), rtol=0.02)

    def test_textures_lie_as_in_cycles(self):
        checks = numpy.random.default_rng(1).random((4, 8, 4)).astype(numpy.float32)
        checks[..., 3] = 1.0
        new_scene(48, 48, 16)
        black_world()
        material = matte()
        node = connect_image(material, new_image("checks", checks), "Base Color", interpolation="Closest")
        tree = material.node_tree
        mapping, uv = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeUVMap")
        mapping.inputs["Location"].default_value = (0.1, 0.25, 0.0)
        mapping.inputs["Rotation"].default_value = (0.0, 0.0, 0.3)
        mapping.inputs["Scale"].default_value = (1.5, 0.75, 1.0)
        tree.links.new(uv.outputs["UV"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs["Vector"], node.inputs["Vector"])
        plane = add_plane(material, 2.0)
        uv.uv_map = plane.data.uv_layers[0].name
        add_light("SUN", 3.0, angle=0.01)
        add_camera(type="ORTHO", ortho_scale=1.8)
        ours, theirs = render(), render_with_cycles(samples=64)
        difference = numpy.abs(ours - theirs)[..., :3].max(axis=-1)
        # Pixels that hold an edge between texels have a mean of both, by different samples.
        self.assertLess(numpy.median(difference), 0.01 * theirs[..., :3].mean())
        self.assertLess((difference > 0.25).mean(), 0.01)


class Contents(unittest.TestCase):
    def setUp(self):
        new_scene()

    def test_modifiers_instances_and_hidden_objects(self):
        plane = add_plane(flakes())
        modifier = plane.modifiers.new("row", "ARRAY")
        modifier.count = 3
        hidden = add_plane()
        hidden.hide_viewport = hidden.hide_render = True
        collection = bpy.data.collections.new("parts")
        collection.objects.link(bpy.data.objects.new("part", plane.data.copy()))
        for n in range(4):
            holder = link(f"holder{n}", None)
            holder.instance_type, holder.instance_collection = "COLLECTION", collection
            holder.location.x = n
        found = described()
        self.assertEqual(sorted(len(mesh.indices) // 3 for mesh in found.meshes), [2, 6])
        self.assertEqual(len(found.instance_mesh), 5)
        self.assertEqual(len(set(found.instance_object)), 5, "copies share flakes")
        places = found.instance_to_world.reshape(-1, 16)[:, 12]
        self.assertEqual(sorted(places), [0.0, 0.0, 1.0, 2.0, 3.0])

    def test_curves_text_and_metaballs_have_surfaces(self):
        bpy.ops.curve.primitive_bezier_circle_add()
        bpy.context.object.data.bevel_depth = 0.1
        bpy.ops.object.text_add()
        bpy.ops.object.metaball_add()
        self.assertEqual(len(described().meshes), 3)

    def test_axes_and_units(self):
        plane = add_plane(matte())
        plane.location = (1.0, 2.0, 3.0)
        bpy.context.scene.unit_settings.scale_length = 0.01
        matrix = described().instance_to_world
        numpy.testing.assert_allclose(matrix[12:15], (0.01, 0.03, -0.02), rtol=1e-6)
        numpy.testing.assert_allclose(matrix[[0, 5, 10]], 0.01, rtol=1e-6)

    def test_unit_scale_changes_flakes_and_not_brightness(self):
        scene = new_scene(32, 32, 4)
        black_world()
        add_plane(flakes(density_per_cm2=1.0, space="OBJECT"), 4.0)
        add_light("POINT", 50.0, (0.0, 0.0, 2.0), shadow_soft_size=0.3)
        add_camera(location=(0.0, 0.0, 3.0))
        scene.glint.model = "SMOOTH"
        one = render()
        scene.unit_settings.scale_length = 0.1
        numpy.testing.assert_allclose(render(), one, rtol=1e-3, atol=1e-6)

    def test_materials_become_gltf(self):
        shades = numpy.random.default_rng(2).random((2, 2, 4)).astype(numpy.float32)
        image = new_image("shades", shades)
        material = new_material("all", Metallic=0.25, Specular=0.3, Clearcoat=0.5, Emission=(2.0, 1.0, 0.0, 1.0), Alpha=0.5)
        connect_image(material, image, "Roughness")
        add_plane(material)
        found = described()
        document = json.loads(found.materials)
        out = document["materials"][0]
        base = out["pbrMetallicRoughness"]
        self.assertEqual((base["metallicFactor"], base["roughnessFactor"]), (0.25, 1.0))
        self.assertEqual(out["alphaMode"], "BLEND")
        self.assertEqual(base["baseColorFactor"][3], 0.5)
        self.assertAlmostEqual(out["extensions"]["KHR_materials_specular"]["specularColorFactor"][0], 0.6, places=6)
        self.assertAlmostEqual(out["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"], 0.5)
        self.assertEqual(out["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"], 2.0)
        packed = found.images[0].pixels
        luminance = image_rows(image)[..., :3] @ (0.2126, 0.7152, 0.0722)
        numpy.testing.assert_allclose(packed[..., 1], luminance, atol=1e-5)
        numpy.testing.assert_array_equal(packed[..., 2], 1.0)

    def test_what_is_not_rendered_is_named(self):
        material = new_material("glass", Transmission=1.0)
        material.node_tree.links.new(material.node_tree.nodes.new("ShaderNodeTexNoise").outputs["Color"],
                                     material.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
        add_plane(material)
        text = "\n".join(described().warnings)
        self.assertIn("glass: Transmission is not rendered", text)
        self.assertIn("Noise Texture", text)

    def test_a_million_triangles_take_no_more_lines_of_python_than_two_hundred(self):
        """Arrays are filled by Blender and by numpy: a loop over triangles would take minutes."""
        from glint import library, scene_data

        lines = []
        for side in (11, 708):
            new_scene(8, 8, 1)
            bpy.ops.mesh.primitive_grid_add(x_subdivisions=side, y_subdivisions=side, size=2)
            bpy.context.object.data.materials.append(matte())
            bpy.context.view_layer.update()
            depsgraph = bpy.context.evaluated_depsgraph_get()
            start = time.thread_time()
            found, count = lines_of_python(lambda: scene_data.describe(depsgraph))
            lines.append(count)
            print(f"{len(found.meshes[0].indices) // 3} triangles: {count} lines, {time.thread_time() - start:.3f} s to arrays")
        self.assertGreater(len(found.meshes[0].indices) // 3, 1e6 - 5000)
        self.assertGreater(lines[0], 50)
        self.assertEqual(lines[0], lines[1])
        library.Scene(found).close()


def lines_of_python(function):
    """What a function returns, and how many lines of Python it ran."""
    count = 0

    def trace(frame, event, argument):
        nonlocal count
        count += event == "line"
        return trace

    sys.settrace(trace)
    try:
        return function(), count
    finally:
        sys.settrace(None)


def image_rows(image):
    width, height = image.size
    values = numpy.empty(width * height * 4, numpy.float32)
    image.pixels.foreach_get(values)
    return values.reshape(height, width, 4)[::-1]


blender_case.run(Cameras, AgainstCycles, Contents)
