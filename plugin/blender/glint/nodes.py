# SPDX-License-Identifier: GPL-3.0-or-later
"""The flakes as a node group of the material, so that Cycles and EEVEE show them."""

import bpy

from . import compat, flakes, principled

PREFIX = "Glint flakes"


def group_of(material, smooth=False):
    """The material's node group, made anew from its properties."""
    name = f"{PREFIX}: {material.name}"
    tree = bpy.data.node_groups.get(name)
    if tree is None:
        tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
        compat.add_output(tree, "NodeSocketShader", "Shader")
    tree.nodes.clear()
    shader = flakes.build(tree, principled.flakes_of(material), smooth)
    output = tree.nodes.new("NodeGroupOutput")
    output.location = (max(n.location.x for n in tree.nodes) + 200.0, 0.0)
    tree.links.new(shader, output.inputs[0])
    return tree


def _output_of(tree):
    outputs = [n for n in tree.nodes if n.type == "OUTPUT_MATERIAL"]
    return next((n for n in outputs if n.is_active_output), outputs[0] if outputs else None)


def build(material, smooth=False):
    """Shows the flakes in place of the Principled BSDF, which stays in the tree: it says what they are made of."""
    material.use_nodes = True
    tree = material.node_tree
    output = _output_of(tree) or tree.nodes.new("ShaderNodeOutputMaterial")
    node = next((n for n in tree.nodes if n.type == "GROUP" and n.name.startswith(PREFIX)), None)
    if node is None:
        node = tree.nodes.new("ShaderNodeGroup")
        node.name = node.label = PREFIX
        node.location = (output.location.x - 220.0, output.location.y - 260.0)
    node.node_tree = group_of(material, smooth)
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return node


def remove(material):
    """Shows the Principled BSDF again."""
    tree = material.node_tree
    for node in [n for n in tree.nodes if n.type == "GROUP" and n.name.startswith(PREFIX)]:
        group = node.node_tree
        tree.nodes.remove(node)
        if group is not None and group.users == 0:
            bpy.data.node_groups.remove(group)
    base, output = principled.find(material), _output_of(tree)
    if base is not None and output is not None:
        tree.links.new(base.outputs[0], output.inputs["Surface"])
