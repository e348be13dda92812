# SPDX-License-Identifier: GPL-3.0-or-later
"""Arithmetic as shader nodes: `graph.add(a, b)` makes a node and returns its output. Arguments are sockets or constants; of
constants alone no node is made but the result is a constant, so that what does not vary costs nothing."""

import math
import operator

import bpy

from . import compat

_FOLDED = {
    "ADD": operator.add,
    "SUBTRACT": operator.sub,
    "MULTIPLY": operator.mul,
    "DIVIDE": lambda a, b: a / b if b != 0.0 else 0.0,  # as the node has it
    "POWER": operator.pow,
    "MAXIMUM": max,
    "MINIMUM": min,
    "SQRT": lambda a: math.sqrt(max(a, 0.0)),
    "COSINE": math.cos,
    "SINE": math.sin,
    "ABSOLUTE": abs,
}
_FOLDED_VECTORS = {name: _FOLDED[name] for name in ("ADD", "SUBTRACT", "MULTIPLY")}


def is_socket(value):
    return isinstance(value, bpy.types.NodeSocket)


class Graph:
    """Makes nodes in a tree, from left to right as they are made."""

    COLUMN, ROW, ROWS = 180, 160, 12

    def __init__(self, tree):
        self.tree = tree
        self._count = 0

    def place(self, node):
        node.location = (self._count // self.ROWS * self.COLUMN, -(self._count % self.ROWS) * self.ROW)
        self._count += 1
        return node

    def node(self, kind, **settings):
        made = self.place(self.tree.nodes.new(kind))
        for name, value in settings.items():
            setattr(made, name, value)
        made.hide = kind in {"ShaderNodeMath", "ShaderNodeVectorMath"}
        return made

    def connect(self, value, socket):
        if is_socket(value):
            self.tree.links.new(value, socket)
        elif socket.type == "RGBA":
            socket.default_value = (*value[:3], 1.0)
        else:
            socket.default_value = value

    def math(self, operation, *values):
        if operation in _FOLDED and not any(is_socket(v) for v in values):
            return float(_FOLDED[operation](*values))
        made = self.node("ShaderNodeMath", operation=operation)
        for value, socket in zip(values, made.inputs):
            self.connect(value, socket)
        return made.outputs["Value"]

    def vector(self, operation, *values, scale=None):
        if operation in _FOLDED_VECTORS and not any(is_socket(v) for v in values):
            return tuple(_FOLDED_VECTORS[operation](a, b) for a, b in zip(*values))
        made = self.node("ShaderNodeVectorMath", operation=operation)
        for value, socket in zip(values, made.inputs):
            self.connect(value, socket)
        if scale is not None:
            self.connect(scale, made.inputs["Scale"])
        return made.outputs["Value" if operation in {"DOT_PRODUCT", "LENGTH"} else "Vector"]

    # Numbers.
    def add(self, a, b):
        return self.math("ADD", a, b)

    def subtract(self, a, b):
        return self.math("SUBTRACT", a, b)

    def multiply(self, a, *others):
        for b in others:
            # Without a node where one of two is 1.
            if not is_socket(b) and b == 1.0:
                continue
            a = b if not is_socket(a) and a == 1.0 else self.math("MULTIPLY", a, b)
        return a

    def divide(self, a, b):
        return self.math("DIVIDE", a, b)

    def square_root(self, a):
        return self.math("SQRT", a)

    def at_least(self, a, least):
        return self.math("MAXIMUM", a, least)

    def at_most(self, a, most):
        return self.math("MINIMUM", a, most)

    def is_above(self, a, b):
        return self.math("GREATER_THAN", a, b)

    def mixed(self, a, b, share):
        """a + (b - a) share."""
        if not is_socket(share) and share in (0.0, 1.0):
            return b if share else a
        return self.add(a, self.multiply(self.subtract(b, a), share))

    # Vectors, and colours, which are vectors to a node.
    def plus(self, a, b):
        return self.vector("ADD", a, b)

    def minus(self, a, b):
        return self.vector("SUBTRACT", a, b)

    def times(self, a, b):
        return self.vector("MULTIPLY", a, b)

    def scaled(self, a, factor):
        if not is_socket(factor):
            if factor == 1.0:
                return a
            if not is_socket(a):
                return tuple(x * factor for x in a)
        return self.vector("SCALE", a, scale=factor)

    def blended(self, a, b, share):
        """a + (b - a) share, component by component."""
        if not is_socket(share) and share in (0.0, 1.0):
            return b if share else a
        return self.plus(a, self.scaled(self.minus(b, a), share))

    def dot(self, a, b):
        return self.vector("DOT_PRODUCT", a, b)

    def cross(self, a, b):
        return self.vector("CROSS_PRODUCT", a, b)

    def normalized(self, a):
        return self.vector("NORMALIZE", a)

    def combine(self, x, y, z):
        made = self.node("ShaderNodeCombineXYZ")
        for value, socket in zip((x, y, z), made.inputs):
            self.connect(value, socket)
        return made.outputs["Vector"]

    def separate(self, a):
        if not is_socket(a):
            return tuple(a)
        made = self.node("ShaderNodeSeparateXYZ")
        self.connect(a, made.inputs[0])
        return made.outputs["X"], made.outputs["Y"], made.outputs["Z"]

    # Shaders.
    def glossy(self, distribution, roughness, color, normal=None):
        """Cycles' roughness is the root of alpha, as glTF's is."""
        lobe = self.place(compat.new_glossy(self.tree.nodes))
        lobe.distribution = distribution
        self.connect(roughness, lobe.inputs["Roughness"])
        self.connect(color, lobe.inputs["Color"])
        if normal is not None:
            self.connect(normal, lobe.inputs["Normal"])
        return lobe.outputs[0]

    def diffuse(self, color, normal=None):
        lobe = self.node("ShaderNodeBsdfDiffuse")
        self.connect(color, lobe.inputs["Color"])
        if normal is not None:
            self.connect(normal, lobe.inputs["Normal"])
        return lobe.outputs[0]

    def sum(self, shaders):
        total = shaders[0]
        for shader in shaders[1:]:
            made = self.node("ShaderNodeAddShader")
            self.tree.links.new(total, made.inputs[0])
            self.tree.links.new(shader, made.inputs[1])
            total = made.outputs[0]
        return total

    def mix(self, share, a, b):
        made = self.node("ShaderNodeMixShader")
        self.connect(share, made.inputs[0])
        self.tree.links.new(a, made.inputs[1])
        self.tree.links.new(b, made.inputs[2])
        return made.outputs[0]
