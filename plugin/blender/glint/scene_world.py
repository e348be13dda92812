# SPDX-License-Identifier: GPL-3.0-or-later
"""What surrounds a scene: the Background of its world, a colour or an environment texture with its rotation."""

import dataclasses
from typing import Optional

import mathutils
import numpy

from .scene_images import radiance_of
from .scene_nodes import constant, origin


@dataclasses.dataclass
class World:
    color: tuple = (0.0, 0.0, 0.0)
    map: Optional[numpy.ndarray] = None
    rotation: tuple = (0.0, 0.0, 0.0, 1.0)  # x y z w, y up
    scale: float = 1.0


def background_of(world):
    """The Background node that the world's output shows; None for another one."""
    outputs = [node for node in world.node_tree.nodes if node.type == "OUTPUT_WORLD"]
    active = next((node for node in outputs if node.is_active_output), None)
    shown = origin(active.inputs["Surface"]) if active is not None else None
    return shown.node if shown is not None and shown.node.type == "BACKGROUND" else None


def rotation_of(node):
    """How a Mapping node turns what lies around: it turns the direction of the lookup, so the map turns back. Our y is
    Blender's z."""
    if node.vector_type not in {"POINT", "TEXTURE", "VECTOR"}:
        return (0.0, 0.0, 0.0, 1.0)
    turn = mathutils.Euler(node.inputs["Rotation"].default_value, "XYZ").to_quaternion()
    if node.vector_type != "TEXTURE":
        turn.invert()
    return turn.x, turn.z, -turn.y, turn.w


def world_of(world, image_cache, warn):
    """The world of a scene; None is black."""
    if world is None:
        return World()
    if not world.use_nodes or world.node_tree is None:
        return World(color=tuple(world.color))
    background = background_of(world)
    if background is None:
        warn(f"{world.name}: only a Background node is read; the world is black")
        return World()
    strength = background.inputs["Strength"].default_value
    output = origin(background.inputs["Color"])
    if output is None:
        return World(color=tuple(c * strength for c in constant(background.inputs["Color"])))
    if output.node.type != "TEX_ENVIRONMENT" or output.node.image is None:
        warn(f"{world.name}: \"{output.node.name}\" is not read; the Background's own colour counts")
        return World(color=tuple(c * strength for c in constant(background.inputs["Color"])))
    return _environment(world, output.node, strength, image_cache, warn)


def _environment(world, node, strength, image_cache, warn):
    if node.projection != "EQUIRECTANGULAR":
        warn(f"{world.name}: mirror balls are not read; the picture is taken for an equirectangular one")
    key = ("environment", node.image.name)
    if key not in image_cache:
        image_cache[key] = radiance_of(node.image)
    if image_cache[key] is None:
        warn(f"{world.name}: the image \"{node.image.name}\" has no pixels; the world is black")
        return World()
    mapping = origin(node.inputs["Vector"])
    rotation = (0.0, 0.0, 0.0, 1.0)
    if mapping is not None and mapping.node.type == "MAPPING":
        rotation = rotation_of(mapping.node)
    return World(map=image_cache[key], rotation=rotation, scale=strength)
