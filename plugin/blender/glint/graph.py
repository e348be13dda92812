# SPDX-License-Identifier: GPL-3.0-or-later
"""Arithmetic as shader nodes: `graph.add(a, b)` makes a node and returns its output. Arguments are sockets or constants."""

import bpy


class Graph:
    """Makes nodes in a tree, from left to right as they are made."""

    COLUMN, ROW, ROWS = 180, 160, 12

    def __init__(self, tree):
        self.tree = tree
        self._count = 0

    def node(self, kind, **settings):
        made = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(made, name, value)
        made.location = (self._count // self.ROWS * self.COLUMN, -(self._count % self.ROWS) * self.ROW)
        made.hide = kind in {"ShaderNodeMath", "ShaderNodeVectorMath"}
        self._count += 1
        return made

    def connect(self, value, socket):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation, *values):
        made = self.node("ShaderNodeMath", operation=operation)
        for value, socket in zip(values, made.inputs):
            self.connect(value, socket)
        return made.outputs["Value"]

    def vector(self, operation, *values, scale=None):
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
            a = self.math("MULTIPLY", a, b)
        return a

    def divide(self, a, b):
        return self.math("DIVIDE", a, b)

    def square_root(self, a):
        return self.math("SQRT", a)

    def at_least(self, a, least):
        return self.math("MAXIMUM", a, least)

    def is_above(self, a, b):
        return self.math("GREATER_THAN", a, b)

    # Vectors.
    def plus(self, a, b):
        return self.vector("ADD", a, b)

    def scaled(self, a, factor):
        return self.vector("SCALE", a, scale=factor)

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
        made = self.node("ShaderNodeSeparateXYZ")
        self.connect(a, made.inputs[0])
        return made.outputs["X"], made.outputs["Y"], made.outputs["Z"]
