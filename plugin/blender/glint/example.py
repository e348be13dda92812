# SPDX-License-Identifier: GPL-3.0-or-later
"""Copies of a small normal map as nodes, side by side: every texel is a mirror of its own roughness."""

import math
from dataclasses import dataclass
from typing import Any


def _hash(x):
    """hash_full of src/math/hash.h: C. Wellons's lowbias32."""
    x ^= x >> 16
    x = x * 0x7FEB352D & 0xFFFFFFFF
    x ^= x >> 15
    x = x * 0x846CA68B & 0xFFFFFFFF
    return x ^ x >> 16


def start_of(seed):
    """Where the first copy begins, in copies: as src/model/example_place.c has it for other renderers' facets."""
    start = _hash(seed * 0x9E3779B1 & 0xFFFFFFFF)
    return (start & 0xFFFF) / 65536.0, (start >> 16) / 65536.0


@dataclass
class Example:
    image: Any
    size_m: float
    elongation: float
    seed: int
    closest: bool

    def normal(self, g, frame, place):
        """Red leans along u, green up the picture, blue is what is left."""
        texel = g.node("ShaderNodeTexImage", image=self.image, extension="REPEAT",
                       interpolation="Closest" if self.closest else "Linear")
        stretch, (start_u, start_v) = math.sqrt(self.elongation), start_of(self.seed)
        columns = g.add(g.multiply(place.u, 1.0 / (self.size_m * stretch)), start_u)
        rows = g.subtract(1.0 - start_v, g.multiply(place.v, stretch / self.size_m))
        g.connect(g.combine(columns, rows, 0.0), texel.inputs["Vector"])
        x, y, z = g.separate(g.minus(g.scaled(texel.outputs["Color"], 2.0), (1.0, 1.0, 1.0)))
        along, up = (self._flat(g, frame, axis) for axis in (place.along_u(), place.against_v()))
        m = g.plus(g.scaled(frame.n, g.at_least(z, 1e-3)), g.plus(g.scaled(along, x), g.scaled(up, y)))
        return g.normalized(m)

    @staticmethod
    def _flat(g, frame, axis):
        return g.normalized(g.minus(axis, g.scaled(frame.n, g.dot(axis, frame.n))))
