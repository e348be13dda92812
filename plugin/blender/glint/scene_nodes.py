# SPDX-License-Identifier: GPL-3.0-or-later
"""What is linked to a socket of a shader: a constant, or a factor times one channel or all colours of an image texture."""

import dataclasses
from typing import Optional

import bpy


@dataclasses.dataclass
class Source:
    """factor times the image. channel: None for colours, else "R", "G", "B", "A" or "grey", their luminance."""

    factor: object
    node: Optional[bpy.types.Node] = None  # an image texture
    channel: Optional[str] = None


CHANNELS = {"R": "R", "G": "G", "B": "B", "Red": "R", "Green": "G", "Blue": "B"}


def origin(socket):
    """The output that a socket gets its value from, behind reroutes; None for a constant."""
    while socket.is_linked:
        link = socket.links[0]
        if link.from_node.type != "REROUTE":
            return link.from_socket
        socket = link.from_node.inputs[0]
    return None


def constant(socket):
    value = socket.default_value
    return tuple(value)[:3] if hasattr(value, "__len__") else float(value)


def _factor_inputs(node):
    """The two inputs of a multiplication; None for another node."""
    if node.type == "MATH" and node.operation == "MULTIPLY":
        return node.inputs[0], node.inputs[1]
    if node.type == "MIX_RGB" and node.blend_type == "MULTIPLY" and node.inputs[0].default_value == 1.0:
        return node.inputs[1], node.inputs[2]
    if node.type == "MIX" and node.data_type == "RGBA" and node.blend_type == "MULTIPLY":
        return (node.inputs[6], node.inputs[7]) if node.inputs[0].default_value == 1.0 else None
    return None


def _product(a, b):
    if isinstance(a, tuple) or isinstance(b, tuple):
        wide = [x if isinstance(x, tuple) else (x,) * 3 for x in (a, b)]
        return tuple(x * y for x, y in zip(*wide))
    return a * b


def source_of(socket, warn):
    """What feeds a socket. A node that is not read counts as the socket's own constant, and is named."""
    output = origin(socket)
    if output is None:
        return Source(constant(socket))
    node, wide = output.node, socket.type in {"RGBA", "VECTOR"}
    one = (1.0,) * 3 if wide else 1.0
    if node.type == "TEX_IMAGE" and node.image is not None:
        channel = "A" if output.name == "Alpha" else None if wide else "grey"
        return Source(one, node, channel)
    if node.type == "VALUE":
        return Source(_product(one, output.default_value))
    if node.type == "RGB":
        color = tuple(output.default_value)[:3]
        return Source(color if wide else sum(color) / 3.0)
    if node.type in {"SEPRGB", "SEPARATE_COLOR"} and getattr(node, "mode", "RGB") == "RGB":
        inner = source_of(node.inputs[0], warn)
        if inner.node is not None and inner.channel is None:
            return Source(inner.factor["RGB".index(CHANNELS[output.name])], inner.node, CHANNELS[output.name])
    factors = _factor_inputs(node)
    if factors is not None:
        a, b = (source_of(factor, warn) for factor in factors)
        if a.node is None or b.node is None:
            image = a if a.node is not None else b
            return Source(_product(a.factor, b.factor), image.node, image.channel)
    warn(f"{socket.name}: the node \"{node.name}\" is not read; the socket's own value counts")
    return Source(constant(socket))
