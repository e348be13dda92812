# SPDX-License-Identifier: GPL-3.0-or-later
"""The flakes as a node group of the material, so that Cycles and EEVEE show them, and what nodes cannot show."""

import contextlib

import bpy

from . import compat, layers, principled
from .graph import Graph

PREFIX = "Glint flakes"
SURFACE = "Surface"
QUIET = "glint_quiet"


def uv_maps_of(material):
    """Names of the first two UV maps of a mesh that wears the material; "" is the one that renders."""
    for mesh in bpy.data.meshes:
        if material.name in mesh.materials and len(mesh.uv_layers) > 0:
            names = [layer.name for layer in mesh.uv_layers]
            return names[0], names[1] if len(names) > 1 else names[0]
    return "", ""


class _Inputs:
    """Inputs of the group for what is linked to the Principled BSDF, made when they are asked for."""

    KINDS = {"VALUE": "NodeSocketFloat", "RGBA": "NodeSocketColor", "VECTOR": "NodeSocketVector"}

    def __init__(self, tree):
        self.tree, self.node = tree, tree.nodes.new("NodeGroupInput")
        self.node.location = (-300.0, 0.0)
        self.made = {}

    def of(self, socket):
        if socket.name not in self.made:
            compat.add_socket(self.tree, "INPUT", self.KINDS[socket.type], socket.name)
            self.made[socket.name] = socket
        return self.node.outputs[socket.name]


def _fill(tree, material, values, smooth):
    """Makes the group's nodes; returns what its inputs want to be linked to."""
    compat.add_socket(tree, "OUTPUT", "NodeSocketShader", "Shader")
    compat.add_socket(tree, "INPUT", "NodeSocketShader", SURFACE)
    inputs, g = _Inputs(tree), Graph(tree)
    sources = layers.Sources(principled.find(material), inputs.of)
    shader = layers.build(g, sources, values, uv_maps_of(material), smooth)
    # The Principled BSDF stays a part of the material, with a share of nothing: exporters look for what is linked.
    shader = g.mix(1.0, inputs.node.outputs[SURFACE], shader)
    output = tree.nodes.new("NodeGroupOutput")
    output.location = (max(n.location.x for n in tree.nodes) + 200.0, 0.0)
    tree.links.new(shader, output.inputs[0])
    return inputs.made


def _output_of(tree):
    outputs = [n for n in tree.nodes if n.type == "OUTPUT_MATERIAL"]
    return next((n for n in outputs if n.is_active_output), outputs[0] if outputs else None)


def find(material):
    """The group's node in the material's tree, or None."""
    if not material.use_nodes or material.node_tree is None:
        return None
    return next((n for n in material.node_tree.nodes if n.type == "GROUP" and n.name.startswith(PREFIX)), None)


def _new_node(material, output):
    node = material.node_tree.nodes.new("ShaderNodeGroup")
    node.name = node.label = PREFIX
    node.width = 180.0
    # Between the Principled BSDF and the output, which gives way.
    node.location = output.location
    output.location.x += 220.0
    return node


def build(material, smooth=False, values=None):
    """Shows the flakes after the Principled BSDF, which says what they are made of.

    values  instead of the material's own properties: those that drivers have been applied to
    """
    material.use_nodes = True
    tree = material.node_tree
    output = _output_of(tree) or tree.nodes.new("ShaderNodeOutputMaterial")
    node = find(material) or _new_node(material, output)
    # Filled before it is used: Blender looks at all that uses a tree whenever a node comes into it.
    old, made = node.node_tree, bpy.data.node_groups.new("new", "ShaderNodeTree")
    linked = _fill(made, material, values or material.glint, smooth)
    node.node_tree = made
    if old is not None and old.users == 0:
        bpy.data.node_groups.remove(old)
    made.name = f"{PREFIX}: {material.name}"
    for name, socket in linked.items():
        tree.links.new(socket.links[0].from_socket, node.inputs[name])
    base = principled.find(material)
    if base is not None:
        tree.links.new(base.outputs[0], node.inputs[SURFACE])
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return node


def remove(material):
    """Shows the Principled BSDF again."""
    node = find(material)
    if node is None:
        return
    tree, group = material.node_tree, node.node_tree
    base, output = principled.find(material), _output_of(tree)
    if output is not None and base is not None:
        output.location = node.location
        tree.links.new(base.outputs[0], output.inputs["Surface"])
    tree.nodes.remove(node)
    if group is not None and group.users == 0:
        bpy.data.node_groups.remove(group)


# ---- keeping up ----


def refresh(material):
    """Nodes that are there follow the properties."""
    if isinstance(material, bpy.types.Material) and QUIET not in material and find(material) is not None:
        build(material)


@contextlib.contextmanager
def one_change(material):
    """Many properties change, the nodes once."""
    material[QUIET] = True
    try:
        yield
    finally:
        del material[QUIET]
    refresh(material)


def _is_animated(material):
    data = material.animation_data
    if data is None:
        return False
    curves = [*data.drivers, *(data.action.fcurves if data.action is not None else ())]
    return any(curve.data_path.startswith("glint.") for curve in curves)


@bpy.app.handlers.persistent
def follow_frame(scene, depsgraph=None):
    """Nodes of materials whose flakes are animated or driven follow the frame."""
    for material in bpy.data.materials:
        if _is_animated(material) and find(material) is not None:
            evaluated = material.evaluated_get(depsgraph) if depsgraph is not None else material
            build(material, values=evaluated.glint)


# ---- what nodes cannot show ----


def _notes_of(values, where):
    notes = []
    if values.density_variation > 0.0:
        notes.append(f"{where}density variation: flakes lie evenly")
    if values.structure == "EXAMPLE":
        texture = values.example_texture
        if texture.rotation != 0.0 or texture.scale[0] != texture.scale[1]:
            notes.append(f"{where}turned or stretched example: its mean size is kept")
        if values.example_texture.image is None:
            notes.append(f"{where}example without an image: flakes stand in")
        elif values.example_placement == "SCATTERED":
            notes.append(f"{where}scattered example: copies lie side by side")
    return notes


def notes(material):
    """What Cycles and EEVEE show otherwise than libglint, one sentence each."""
    group, node = material.glint, principled.find(material)
    said = _notes_of(group, "") if group.enabled else []
    if group.coat.enabled:
        said += _notes_of(group.coat, "coat, ")
        if principled.value_of(node, principled.COAT, 0.0) == 0.0:
            said.append("the Principled BSDF has no clear coat, so its flakes do not show")
    if node is not None:
        rotation = node.inputs.get("Anisotropic Rotation")
        if rotation is not None and rotation.is_linked:
            said.append("texture of the anisotropic rotation: its constant is taken")
        if principled.value_of(node, ("Transmission", "Transmission Weight"), 0.0) > 0.0:
            said.append("transmission: the surface is opaque")
    return said


def register():
    bpy.app.handlers.frame_change_post.append(follow_frame)


def unregister():
    bpy.app.handlers.frame_change_post.remove(follow_frame)
