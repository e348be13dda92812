# SPDX-License-Identifier: GPL-3.0-or-later
"""The node group follows the properties and comes and goes."""

import unittest

import bpy

from blender_case import fresh, new_material, operate


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

    def test_nodes_follow_the_properties(self):
        from glint import nodes

        material = new_material()
        material.glint.enabled = True
        operate(bpy.ops.glint.build_nodes, material)

        def seeds():
            tree = nodes.find(material).node_tree
            return [n.inputs["Z"].default_value for n in tree.nodes if n.type == "COMBXYZ" and not n.inputs["Z"].is_linked]

        self.assertIn(0.0, seeds())
        material.glint.seed = 77
        self.assertIn(77.0, seeds())
        material.glint.enabled = False
        made = nodes.find(material).node_tree.nodes
        self.assertFalse([n for n in made if n.type == "TEX_WHITE_NOISE"])
        self.assertEqual(len(bpy.data.node_groups), 1)

    def test_nodes_follow_keyframes_and_drivers(self):
        from glint import nodes

        material = new_material()
        group = material.glint
        group.enabled = True
        operate(bpy.ops.glint.build_nodes, material)

        def roughness():
            tree = nodes.find(material).node_tree
            return [n.inputs["Roughness"].default_value for n in tree.nodes if n.type == "BSDF_GLOSSY"]

        for frame, value in ((1, 0.1), (11, 0.3)):
            group.facet_roughness = value
            group.keyframe_insert("facet_roughness", frame=frame)
        bpy.context.scene.frame_set(6)
        self.assertEqual(len(roughness()), 1)
        self.assertAlmostEqual(roughness()[0], 0.2, places=5)
        curve = material.driver_add("glint.facet_roughness")
        curve.driver.expression = "frame / 100"
        bpy.context.scene.frame_set(40)
        self.assertAlmostEqual(roughness()[0], 0.4, places=5)

    def test_what_is_linked_to_the_principled_bsdf_is_linked_to_the_flakes(self):
        from glint import nodes, principled

        material = new_material()
        material.glint.enabled = True
        tree = material.node_tree
        picture = tree.nodes.new("ShaderNodeTexImage")
        picture.image = bpy.data.images.new("base", 8, 8)
        for name in ("Base Color", "Roughness"):
            tree.links.new(picture.outputs["Color"], principled.find(material).inputs[name])
        operate(bpy.ops.glint.build_nodes, material)
        node = nodes.find(material)
        for name in ("Base Color", "Roughness"):
            self.assertEqual(node.inputs[name].links[0].from_node, picture)
        self.assertEqual(node.inputs["Surface"].links[0].from_node.type, "BSDF_PRINCIPLED")
        self.assertNotIn("Metallic", node.inputs)

    def test_what_nodes_cannot_show_is_said(self):
        from glint import nodes

        material = new_material()
        group = material.glint
        group.enabled, group.density_variation = True, 1.0
        group.coat.enabled, group.coat.structure = True, "EXAMPLE"
        said = " ".join(nodes.notes(material))
        for word in ("density variation", "coat, example without an image", "no clear coat"):
            self.assertIn(word, said)
        group.coat.enabled, group.density_variation = False, 0.0
        self.assertEqual(nodes.notes(material), [])

    def test_every_preset_has_nodes_that_say_what_they_lack(self):
        from glint import nodes, presets

        lacking = {}
        for name in presets.available():
            material = new_material(name)
            operate(bpy.ops.glint.apply_preset, material, name=name)
            operate(bpy.ops.glint.build_nodes, material)
            tree = nodes.find(material).node_tree
            self.assertTrue(tree.nodes["Group Output"].inputs[0].is_linked)
            if nodes.notes(material):
                lacking[name] = nodes.notes(material)
        self.assertEqual(list(lacking), ["scratched-steel"])

    def test_copy_of_a_material_gets_nodes_of_its_own(self):
        from glint import nodes

        material = new_material()
        material.glint.enabled = True
        operate(bpy.ops.glint.build_nodes, material)
        copy = material.copy()
        copy.glint.seed = 5
        self.assertNotEqual(nodes.find(copy).node_tree, nodes.find(material).node_tree)
