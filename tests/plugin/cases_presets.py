# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: everything that a file says is in Blender and goes out again, by a saved preset and by glTF."""

import base64
import json
import os
import unittest

import bpy

from blender_case import export, fresh, new_material, operate


def filled(content):
    """An extension with its defaults in: leaving one out says the same."""
    from glint import extension

    return {**{row[0]: row[2] for row in extension.TABLE}, **content}


def facets_of(material):
    """Both extensions of a glTF material, textures without their place in the file."""
    extensions = material.get("extensions", {})
    coat = extensions.get("KHR_materials_clearcoat", {}).get("extensions", {})
    found = [filled(e["GLINT_materials_glint"]) if "GLINT_materials_glint" in e else None for e in (extensions, coat)]
    for content in found:
        for name in [n for n in content or () if n.endswith("Texture")]:
            content[name] = {**content[name], "index": "image"}
    return found


def surface_of(material):
    """What flakes are made of: constants, and those of the extensions that libglint honours; 3.4 keeps seven digits."""
    base, extensions = material["pbrMetallicRoughness"], material.get("extensions", {})
    coat = extensions.get("KHR_materials_clearcoat", {})
    numbers = [
        *base.get("baseColorFactor", [1.0] * 4), base.get("metallicFactor", 1.0), base.get("roughnessFactor", 1.0),
        *extensions.get("KHR_materials_specular", {}).get("specularColorFactor", [1.0] * 3),
        *(extensions.get("KHR_materials_anisotropy", {}).get(n, 0.0) for n in ("anisotropyStrength", "anisotropyRotation")),
        coat.get("clearcoatFactor", 0.0), coat.get("clearcoatRoughnessFactor", 0.0),
        extensions.get("KHR_materials_ior", {}).get("ior", 1.5),
    ]
    return [float(f"{x:.5g}") for x in numbers]


class Presets(unittest.TestCase):
    def setUp(self):
        fresh()

    def read(self, path):
        with open(path, encoding="utf-8") as file:
            return json.load(file)

    def hold(self, found, wanted):
        self.assertEqual(facets_of(found), facets_of(wanted))
        self.assertEqual(surface_of(found), surface_of(wanted))

    def test_every_preset_goes_in_and_comes_out_again(self):
        from glint import presets

        self.assertGreaterEqual(len(presets.available()), 15)
        for name, path in presets.available().items():
            with self.subTest(preset=name):
                wanted, material = self.read(path), new_material(name)
                self.assertEqual(operate(bpy.ops.glint.apply_preset, material, name=name), {"FINISHED"})
                saved = presets.of_material(material)
                self.hold(saved, wanted)
                self.assertEqual(saved["extras"].get("images"), wanted["extras"].get("images"))

    def test_every_preset_goes_through_a_gltf_file_and_another(self):
        from glint import compat, presets

        names = presets.available()
        for name in names:
            operate(bpy.ops.glint.apply_preset, new_material(name), name=name)
        path, first = export("presets.glb")
        fresh()
        compat.import_gltf(path)
        _, second = export("again.glb")
        for document in (first, second):
            materials = {m["name"]: m for m in document["materials"]}
            self.assertEqual(sorted(materials), sorted(names))
            for name, preset in names.items():
                with self.subTest(preset=name):
                    self.hold(materials[name], self.read(preset))
            self.assertEqual(len(document["images"]), 3)

    def test_images_of_examples_go_through_a_gltf_file_byte_for_byte(self):
        from glint import compat, presets, textures

        path = presets.available()["leather"]
        operate(bpy.ops.glint.apply_preset, new_material(), name="leather")
        out, _ = export("leather.glb")
        fresh()
        compat.import_gltf(out)
        image = bpy.data.materials["flakes"].glint.example_texture.image
        uri = self.read(path)["extras"]["images"][0]["uri"]
        self.assertEqual(textures.bytes_of(image), base64.b64decode(uri.partition(",")[2]))

    def test_saved_preset_is_there_and_brings_everything_back(self):
        from glint import presets

        material = new_material("My own")
        operate(bpy.ops.glint.apply_preset, material, name="two-layer-car-paint")
        material.glint.seed, material.glint.coat.factor = 12, 0.75
        material.glint.density_texture.image = bpy.data.images.new("density", 8, 8)
        material.glint.density_texture.scale = (2.0, 3.0)
        own = presets.folders()[0]
        path = os.path.join(own, "my-own.gltf-material.json")
        try:
            self.assertEqual(operate(bpy.ops.glint.save_preset, material, name="My own"), {"FINISHED"})
            self.assertIn("my-own", presets.available())
            again = new_material()
            self.assertEqual(operate(bpy.ops.glint.apply_preset, again, name="my-own"), {"FINISHED"})
            self.hold(presets.of_material(again), presets.of_material(material))
            self.assertEqual(tuple(again.glint.density_texture.scale), (2.0, 3.0))
            self.assertEqual(tuple(again.glint.density_texture.image.size), (8, 8))
        finally:
            os.remove(path)

    def test_preset_replaces_all_of_the_one_before(self):
        from glint import presets

        material = new_material()
        for name in ("two-layer-car-paint", "sparkling-stone", "leather", "craft-glitter"):
            operate(bpy.ops.glint.apply_preset, material, name=name)
        self.hold(presets.of_material(material), self.read(presets.available()["craft-glitter"]))

    def test_unknown_preset_is_an_error_that_names_the_others(self):
        with self.assertRaisesRegex(RuntimeError, "'gold-laef'.*gold-leaf"):
            operate(bpy.ops.glint.apply_preset, new_material(), name="gold-laef")
