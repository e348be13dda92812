# SPDX-License-Identifier: GPL-3.0-or-later
"""Where flakes lie, as nodes: metres along two directions, by the UV map or on one of three planes of the object.

As src/preview/place.c has it, in glTF's axes (y up; v runs down a picture), so that the flakes are the same there.
"""

from dataclasses import dataclass
from typing import Any


@dataclass
class Place:
    u: Any  # metres
    v: Any
    along_u: Any  # called for the world's direction of u, and for that against v
    against_v: Any
    density_scale: Any = 1.0


def by_uv(g, uv_map, uv_scale, frame):
    uv = g.node("ShaderNodeUVMap", uv_map=uv_map).outputs[0]
    u, v, _ = g.separate(uv)
    down = g.subtract(1.0, v)
    return Place(g.multiply(u, uv_scale), g.multiply(down, uv_scale), lambda: frame.t, lambda: frame.b)


def _axes(g):
    """The object's axes in the world, glTF's x, y and z in Blender's, as long as a unit of the object is."""
    made = []
    for axis in ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)):
        turn = g.node("ShaderNodeVectorTransform", vector_type="VECTOR", convert_from="OBJECT", convert_to="WORLD")
        g.connect(axis, turn.inputs[0])
        made.append(turn.outputs[0])
    return made


def _picked(g, weights, position):
    """A vector that is 1 for one of three planes, by a random number of the point: every sample has its own."""
    noise = g.node("ShaderNodeTexWhiteNoise", noise_dimensions="3D")
    g.connect(position, noise.inputs["Vector"])
    two = g.add(weights[0], weights[1])
    target = g.multiply(noise.outputs["Value"], g.add(two, weights[2]))
    first, first_two = g.math("LESS_THAN", target, weights[0]), g.math("LESS_THAN", target, two)
    return first, g.subtract(first_two, first), g.subtract(1.0, first_two)


def on_planes(g, frame):
    """Plane k has u along axis k + 1 and v along axis k + 2, weight n_k^4 and the density over |n_k|: flakes are counted on the
    surface."""
    axes = _axes(g)
    x, y, z = g.separate(g.node("ShaderNodeTexCoord").outputs["Object"])
    at = (x, z, g.multiply(y, -1.0))
    metres = [g.multiply(c, g.vector("LENGTH", axis)) for c, axis in zip(at, axes)]
    tilts = [g.math("ABSOLUTE", g.dot(frame.true_normal, g.normalized(axis))) for axis in axes]
    picks = _picked(g, [g.math("POWER", tilt, 4.0) for tilt in tilts], frame.position)
    pick = g.combine(*picks)

    def of_plane(values, turn):
        return g.dot(pick, g.combine(*(values[(k + turn) % 3] for k in range(3))))

    def axis_of_plane(turn, sign):
        parts = [g.scaled(axes[(k + turn) % 3], picks[k]) for k in range(3)]
        return g.scaled(g.plus(parts[0], g.plus(parts[1], parts[2])), sign)

    return Place(
        of_plane(metres, 1), of_plane(metres, 2), lambda: axis_of_plane(1, 1.0), lambda: axis_of_plane(2, -1.0),
        g.divide(1.0, g.at_least(of_plane(tilts, 0), 1e-6)),
    )
