# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on inside Blender: properties, presets, nodes, and glTF files out and in again."""

import json
import math
import os
import struct
import sys
import unittest

import bpy

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import blender_case
from blender_case import folder, fresh


def new_material(name="flakes"):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    mesh_object().data.materials.append(material)
    return material


def mesh_object():
    bpy.ops.mesh.primitive_plane_add(size=1.0)
    return bpy.context.object


def operate(operator, material, **settings):
    """Runs an operator as the panel does: with the material in its context."""
    with bpy.context.temp_override(material=material):
        return operator(**settings)


def read_json(path):
    with open(path, "rb") as file:
        header = file.read(20)
        length = struct.unpack("<I", header[12:16])[0]
        return json.loads(file.read(length))


def export(name):
    path = os.path.join(folder(), name)
    bpy.ops.export_scene.gltf(filepath=path, export_lights=True, export_cameras=True)
    return path, read_json(path)


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
        with bpy.context.temp_override(material=material):
            self.assertIn("100 flakes per pixel", readout.lines(bpy.context)[0])
        # 50 mm on a sensor of 36 mm, two metres away: a pixel is 1.44 mm wide.
        camera.data.type = "PERSP"
        camera.data.lens, camera.data.sensor_width = 50.0, 36.0
        side = readout.pixel_side_m(scene, bpy.context.object)
        self.assertAlmostEqual(side, 2.0 * 36.0 / 50.0 / 1000.0, places=9)


class Presets(unittest.TestCase):
    def setUp(self):
        fresh()

    def test_every_preset_goes_in_and_comes_out_again(self):
        from glint import extension, presets

        self.assertGreaterEqual(len(presets.available()), 8)
        for name, path in presets.available().items():
            with self.subTest(preset=name), open(path, encoding="utf-8") as file:
                wanted = json.load(file)
                material = new_material(name)
                self.assertEqual(operate(bpy.ops.glint.apply_preset, material, name=name), {"FINISHED"})
                saved = presets.of_material(material)
                for key, value in wanted["pbrMetallicRoughness"].items():
                    if isinstance(value, (int, float)):
                        self.assertAlmostEqual(saved["pbrMetallicRoughness"][key], value, places=5)
                known = {row[0]: row[2] for row in extension.TABLE}
                for key, value in wanted["extensions"][extension.NAME].items():
                    if key not in known:
                        continue
                    found = saved["extensions"][extension.NAME].get(key, known[key])
                    if isinstance(value, (int, float)):
                        self.assertLessEqual(abs(found - value), 2e-6 * abs(value), key)
                    else:
                        self.assertEqual(found, value, key)

    def test_unknown_preset_is_an_error_that_names_the_others(self):
        with self.assertRaisesRegex(RuntimeError, "'gold-laef'.*gold-leaf"):
            operate(bpy.ops.glint.apply_preset, new_material(), name="gold-laef")


class Nodes(unittest.TestCase):
    def setUp(self):
        fresh()

    def test_nodes_are_built_rebuilt_and_removed(self):
        material = new_material()
        material.glint.enabled = True
        before = len(material.node_tree.nodes)
        for _ in range(3):
            self.assertEqual(operate(bpy.ops.glint.build_nodes, material), {"FINISHED"})
        self.assertEqual(len(material.node_tree.nodes), before + 1)
        self.assertEqual(len(bpy.data.node_groups), 1)
        output = next(n for n in material.node_tree.nodes if n.type == "OUTPUT_MATERIAL")
        self.assertEqual(output.inputs["Surface"].links[0].from_node.type, "GROUP")
        operate(bpy.ops.glint.remove_nodes, material)
        self.assertEqual(output.inputs["Surface"].links[0].from_node.type, "BSDF_PRINCIPLED")
        self.assertEqual(len(bpy.data.node_groups), 0)


class GltfFiles(unittest.TestCase):
    def setUp(self):
        fresh()

    def add_light(self, kind, **settings):
        data = bpy.data.lights.new(kind.lower(), kind)
        for name, value in settings.items():
            setattr(data, name, value)
        bpy.context.collection.objects.link(bpy.data.objects.new(kind.lower(), data))
        return data

    def test_extension_goes_out(self):
        group = new_material().glint
        group.enabled, group.density_exponent, group.distribution, group.seed = True, 5.0, "BECKMANN", 7
        group.facet_roughness, group.color, group.space = 0.2, (1.0, 0.5, 0.25), "OBJECT"
        new_material("plain")
        _, document = export("out.glb")
        materials = {m["name"]: m for m in document["materials"]}
        self.assertEqual(
            materials["flakes"]["extensions"]["GLINT_materials_glint"],
            {
                "glintFactor": 1.0, "glintDistribution": "beckmann", "glintDensity": 1e9, "glintFacetRoughness": 0.2,
                "glintColorFactor": [1.0, 0.5, 0.25], "glintSpace": "object", "glintSeed": 7,
            },
        )
        self.assertNotIn("GLINT_materials_glint", materials["plain"].get("extensions", {}))
        self.assertIn("GLINT_materials_glint", document["extensionsUsed"])
        self.assertNotIn("GLINT_materials_glint", document.get("extensionsRequired", []))

    def test_sizes_of_lights_go_out_and_come_back(self):
        new_material()
        self.add_light("SUN", angle=0.05)
        self.add_light("POINT", shadow_soft_size=0.3)
        self.add_light("SPOT", shadow_soft_size=0.07)
        path, document = export("lights.glb")
        lights = {light["type"]: light for light in document["extensions"]["KHR_lights_punctual"]["lights"]}
        self.assertAlmostEqual(lights["directional"]["extras"]["angularDiameter"], 0.05, places=6)
        self.assertAlmostEqual(lights["point"]["extras"]["radius"], 0.3, places=6)
        self.assertAlmostEqual(lights["spot"]["extras"]["radius"], 0.07, places=6)
        fresh()
        from glint import compat

        compat.import_gltf(path)
        found = {light.type: light for light in bpy.data.lights}
        self.assertAlmostEqual(found["SUN"].angle, 0.05, places=6)
        self.assertAlmostEqual(found["POINT"].shadow_soft_size, 0.3, places=6)
        self.assertAlmostEqual(found["SPOT"].shadow_soft_size, 0.07, places=6)

    def test_area_lights_go_out_and_come_back(self):
        new_material()
        wanted = {}
        for shape, width, height in (("RECTANGLE", 0.4, 0.2), ("SQUARE", 0.3, 9.0), ("DISK", 0.5, 9.0)):
            light = self.add_light("AREA", shape=shape, size=width, size_y=height, energy=7.0, color=(1.0, 0.5, 0.25))
            holder = next(o for o in bpy.data.objects if o.data is light)
            light.name = holder.name = shape
            holder.location, holder.rotation_euler = (1.0, 2.0, 3.0), (0.5, 0.2, 0.1)
            bpy.context.view_layer.update()
            wanted[shape] = holder.matrix_world.copy()
        path, document = export("area.glb")
        lights = {light["name"]: light for light in document["extensions"]["EXT_lights_area"]["lights"]}
        self.assertAlmostEqual(lights["RECTANGLE"]["intensity"], 7.0 / (4.0 * 0.08), places=4)
        self.assertAlmostEqual(lights["DISK"]["intensity"], 7.0 / (4.0 * math.pi * 0.0625), places=4)
        self.assertEqual([lights[n]["type"] for n in ("RECTANGLE", "SQUARE", "DISK")], ["rect", "rect", "disk"])
        self.assertAlmostEqual(lights["RECTANGLE"]["rect"]["aspect"], 2.0, places=5)
        self.assertIn("EXT_lights_area", document["extensionsUsed"])
        fresh()
        from glint import compat

        compat.import_gltf(path)
        bpy.context.view_layer.update()
        for name, matrix in wanted.items():
            holder = next(o for o in bpy.data.objects if o.type == "LIGHT" and o.data.name == name)
            self.assertAlmostEqual(holder.data.energy, 7.0, places=4)
            for row in range(4):
                for column in range(4):
                    self.assertAlmostEqual(holder.matrix_world[row][column], matrix[row][column], places=5)

    def test_materials_come_back_as_they_went(self):
        from glint import compat, extension, presets

        for name in presets.available():
            operate(bpy.ops.glint.apply_preset, new_material(name), name=name)
        path, first = export("presets.glb")
        fresh()
        compat.import_gltf(path)
        self.assertTrue(all(bpy.data.materials[name].glint.enabled for name in presets.available()))
        _, second = export("again.glb")
        for a, b in zip(first["materials"], second["materials"]):
            self.assertEqual(a["name"], b["name"])
            self.assertEqual(a["extensions"][extension.NAME], b["extensions"][extension.NAME])

    def test_file_with_an_extension_that_is_wrong_still_opens(self):
        from glint import compat, gltf

        new_material().glint.enabled = True
        path, document = export("wrong.glb")
        with open(path, "rb") as file:
            whole = file.read()
        # A number where a word belongs, of the same length, so that the chunk stays as long as its header says.
        broken = whole.replace(b'"glintFactor":1', b'"glintSpace":12')
        self.assertNotEqual(whole, broken)
        with open(path, "wb") as file:
            file.write(broken)
        fresh()
        gltf.problems.clear()
        self.assertEqual(compat.import_gltf(path), {"FINISHED"})
        self.assertEqual(len(gltf.problems), 1)


class Registration(unittest.TestCase):
    def test_add_on_comes_and_goes_without_a_trace(self):
        import addon_utils

        fresh()
        for _ in range(3):
            addon_utils.disable("glint", default_set=True)
            self.assertFalse(hasattr(bpy.types.Material, "glint"))
            self.assertIsNotNone(addon_utils.enable("glint", default_set=True))
            self.assertTrue(hasattr(bpy.types.Material, "glint"))


blender_case.run(Properties, Presets, Nodes, GltfFiles, Registration)
