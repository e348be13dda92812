# SPDX-License-Identifier: GPL-3.0-or-later
"""glTF files: the extension, the sizes of lights and area lights go out and come back."""

import math
import unittest

import bpy

from blender_case import export, fresh, new_material


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
        self.assertIn("'flakes'", gltf.problems[0])
        self.assertIn("glintSpace: found 12", gltf.problems[0])

    def test_image_that_is_not_there_is_said_and_the_rest_goes_out(self):
        from glint import gltf

        material = new_material()
        material.glint.enabled = True
        image = bpy.data.images.new("lost", 8, 8)
        image.source, image.filepath = "FILE", "//lost.png"
        material.glint.density_texture.image = image
        _, document = export("lost.glb")
        self.assertEqual(document["materials"][0]["extensions"]["GLINT_materials_glint"], {"glintFactor": 1.0})
        self.assertEqual(len(gltf.problems), 1)
        self.assertIn("image 'lost': there is no file", gltf.problems[0])

    def test_textures_and_a_coat_go_out_and_come_back(self):
        from glint import compat

        group = new_material().glint
        group.coat.enabled, group.coat.seed = True, 9
        texture = group.coat.density_texture
        texture.image, texture.texcoord, texture.closest = bpy.data.images.new("spots", 16, 16), 1, True
        texture.offset, texture.rotation, texture.scale = (0.25, 0.5), 0.75, (2.0, 4.0)
        path, document = export("textures.glb")
        coat = document["materials"][0]["extensions"]["KHR_materials_clearcoat"]
        content = coat["extensions"]["GLINT_materials_glint"]
        self.assertEqual(content["glintDensityTexture"], {
            "index": 0, "texCoord": 1,
            "extensions": {"KHR_texture_transform": {"offset": [0.25, 0.5], "rotation": 0.75, "scale": [2.0, 4.0]}},
        })
        self.assertEqual(document["samplers"][0]["magFilter"], 9728)
        self.assertEqual(document["images"][0]["mimeType"], "image/png")
        fresh()
        compat.import_gltf(path)
        came = bpy.data.materials["flakes"].glint.coat
        self.assertTrue(came.enabled and came.density_texture.closest)
        self.assertEqual((came.seed, came.density_texture.texcoord), (9, 1))
        self.assertEqual(tuple(came.density_texture.image.size), (16, 16))
        self.assertEqual(tuple(came.density_texture.scale), (2.0, 4.0))
