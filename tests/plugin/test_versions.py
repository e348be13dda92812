# SPDX-License-Identifier: GPL-3.0-or-later
"""compat.py does the right thing where later versions of Blender differ: it is run with a bpy that has what they have.

    python3 test_versions.py

Only Debian's 3.4.1 is at hand. What the fakes have is what the release notes and shared facts say of 4.0 to 5.0; that the real ones
do so, no test here knows (docs/blender.md).
"""

import importlib.util
import os
import sys
import tomllib
import types
import unittest
from unittest import mock

HERE = os.path.dirname(os.path.realpath(__file__))
PLUGIN = os.path.join(HERE, "..", "..", "plugin", "blender")


def load(name, bpy):
    """A module of the add-on that sees this bpy."""
    path = os.path.join(PLUGIN, "glint", name + ".py")
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    with mock.patch.dict(sys.modules, {"bpy": bpy}):
        spec.loader.exec_module(module)
    return module


def inputs(**values):
    """Inputs of a node, by name with blanks for underscores."""
    return {name.replace("_", " "): types.SimpleNamespace(default_value=value) for name, value in values.items()}


class Nodes(unittest.TestCase):
    def setUp(self):
        self.compat = load("compat", mock.MagicMock())

    def test_sockets_of_groups(self):
        old = mock.MagicMock(spec=["inputs", "outputs"])
        self.compat.add_socket(old, "OUTPUT", "NodeSocketShader", "Shader")
        old.outputs.new.assert_called_once_with("NodeSocketShader", "Shader")
        new = mock.MagicMock(spec=["interface"])  # 4.0 took inputs and outputs away
        self.compat.add_socket(new, "INPUT", "NodeSocketFloat", "Roughness")
        new.interface.new_socket.assert_called_once_with(name="Roughness", in_out="INPUT", socket_type="NodeSocketFloat")

    def test_glossy_lobe_is_round_in_both(self):
        def since_4_0(kind):
            if kind == "ShaderNodeBsdfGlossy":
                raise RuntimeError("Error: Node type ShaderNodeBsdfGlossy undefined")
            return types.SimpleNamespace(kind=kind, inputs=inputs(Anisotropy=0.5))

        made = self.compat.new_glossy(types.SimpleNamespace(new=since_4_0))
        self.assertEqual(made.kind, "ShaderNodeBsdfAnisotropic")
        self.assertEqual(made.inputs["Anisotropy"].default_value, 0.0)
        made = self.compat.new_glossy(types.SimpleNamespace(new=lambda kind: types.SimpleNamespace(kind=kind)))
        self.assertEqual(made.kind, "ShaderNodeBsdfGlossy")

    def test_head_on_reflectance_of_both_principled_nodes(self):
        old = types.SimpleNamespace(inputs=inputs(Specular=0.5, IOR=1.45))
        self.assertAlmostEqual(self.compat.head_on_reflectance(old), 0.04)
        new = types.SimpleNamespace(inputs=inputs(Specular_IOR_Level=0.5, IOR=1.31))
        self.assertAlmostEqual(self.compat.head_on_reflectance(new), (0.31 / 2.31) ** 2)
        for node in (old, new):
            self.compat.set_head_on_reflectance(node, 1.5)
            self.assertAlmostEqual(self.compat.head_on_reflectance(node), 0.04)
            self.assertEqual(node.inputs["IOR"].default_value, 1.5)

    def test_inputs_are_found_by_either_name(self):
        names = ("Clearcoat", "Coat Weight")
        for have in names:
            node = types.SimpleNamespace(inputs={have: have})
            self.assertEqual(self.compat.input_of(node, *names), have)
        self.assertIsNone(self.compat.input_of(types.SimpleNamespace(inputs={}), *names))

    def test_flakes_keep_their_normals_where_cycles_would_bend_them(self):
        new = types.SimpleNamespace(cycles=types.SimpleNamespace(use_bump_map_correction=True))
        self.compat.keep_normals(new)
        self.assertFalse(new.cycles.use_bump_map_correction)
        old = types.SimpleNamespace(cycles=types.SimpleNamespace())
        self.compat.keep_normals(old)
        self.assertEqual(vars(old.cycles), {})


class Gltf(unittest.TestCase):
    def operator(self, *properties):
        made = mock.MagicMock()
        made.get_rna_type.return_value.properties = dict.fromkeys(properties)
        return made

    def test_lights_are_not_turned_into_lumens_by_either_name(self):
        for name in ("convert_lighting_mode", "export_import_convert_lighting_mode"):
            bpy = mock.MagicMock()
            bpy.ops.import_scene.gltf = self.operator(name)
            bpy.ops.export_scene.gltf = self.operator(name, "export_lights")
            compat = load("compat", bpy)
            compat.mend_numpy = lambda: None
            compat.import_gltf("a.glb")
            bpy.ops.import_scene.gltf.assert_called_once_with(filepath="a.glb", **{name: "COMPAT"})
            compat.export_gltf("b.glb", export_lights=True, export_colors=True)
            bpy.ops.export_scene.gltf.assert_called_once_with(filepath="b.glb", export_lights=True, **{name: "COMPAT"})

    def test_modules_that_moved_are_found(self):
        compat = load("compat", mock.MagicMock())

        class Old:
            def __init__(self, data):
                self.data = data

        class New:
            def __init__(self, data, target):
                self.data, self.target = data, target

        for name, kind in (("gltf2_io_binary_data", Old), ("binary_data", New)):
            parents = ("io_scene_gltf2", "io_scene_gltf2.io", "io_scene_gltf2.io.exp")
            package = {n: types.ModuleType(n) for n in parents}
            for module in package.values():
                module.__path__ = []
            module = types.ModuleType(f"{parents[-1]}.{name}")
            module.BinaryData = kind
            with mock.patch.dict(sys.modules, {**package, module.__name__: module}):
                self.assertEqual(compat.binary_data(b"abc").data, b"abc")
        with self.assertRaisesRegex(ImportError, "none of a.b, c.d"):
            compat.gltf_module("a.b", "c.d")


class Meshes(unittest.TestCase):
    def test_uv_maps_of_both_kinds_are_read(self):
        compat = load("compat", mock.MagicMock())

        def fill(attribute, out):
            out[:] = range(len(out))
            self.asked = attribute

        with mock.patch.dict(sys.modules, {"numpy": FakeNumpy()}):
            new = types.SimpleNamespace(uv=types.SimpleNamespace(foreach_get=fill))
            self.assertEqual(compat.uv_arrays(new, 2), [[0, 1], [2, 3]])
            self.assertEqual(self.asked, "vector")
            old = types.SimpleNamespace(data=types.SimpleNamespace(foreach_get=fill))
            self.assertEqual(compat.uv_arrays(old, 2), [[0, 1], [2, 3]])
            self.assertEqual(self.asked, "uv")


class FakeNumpy:
    """As much of numpy as it takes: the test runs where numpy is not installed, too."""

    float32 = "float32"

    class Array(list):
        def reshape(self, rows, columns):
            return [self[columns * i : columns * (i + 1)] for i in range(rows)]

    def empty(self, count, kind):
        return self.Array([0] * count)


class Packaging(unittest.TestCase):
    def test_manifest_says_what_bl_info_says(self):
        with open(os.path.join(PLUGIN, "blender_manifest.toml"), "rb") as file:
            manifest = tomllib.load(file)
        with open(os.path.join(PLUGIN, "glint", "__init__.py"), encoding="utf-8") as file:
            source = file.read()
        found = {}
        exec(source[source.index("bl_info") : source.index("}\n") + 2], found)
        info = found["bl_info"]
        self.assertEqual(manifest["version"], ".".join(map(str, info["version"])))
        self.assertEqual(manifest["name"], info["name"])
        self.assertEqual(manifest["maintainer"], info["author"])
        # What 4.2 asks for: https://docs.blender.org/manual/en/4.2/advanced/extensions/getting_started.html
        for name in ("schema_version", "id", "version", "name", "tagline", "maintainer", "type", "blender_version_min", "license"):
            self.assertTrue(manifest[name], name)
        self.assertLessEqual(len(manifest["tagline"]), 64)
        self.assertFalse(manifest["tagline"].endswith("."))
        self.assertEqual(manifest["type"], "add-on")
        self.assertTrue(all(text.startswith("SPDX:") for text in manifest["license"]))
        for reason in manifest["permissions"].values():
            self.assertLessEqual(len(reason), 64)
            self.assertFalse(reason.endswith("."))
        known = {"windows-x64", "windows-arm64", "macos-x64", "macos-arm64", "linux-x64"}
        self.assertTrue(set(manifest["platforms"]) <= known)

    def test_only_compat_knows_versions(self):
        for name in os.listdir(os.path.join(PLUGIN, "glint")):
            if name.endswith(".py") and name != "compat.py":
                with open(os.path.join(PLUGIN, "glint", name), encoding="utf-8") as file:
                    self.assertNotRegex(file.read(), r"app\.version\b", name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
