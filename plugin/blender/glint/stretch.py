# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a UV map stretches: metres of surface per unit of the map, triangle by triangle."""

from dataclasses import dataclass

import numpy

from . import compat

# Above this quotient of sizes flakes look larger in one place than in another: taste. Area goes with its square.
MOST_STRETCH = 1.25
# So many triangles, evenly taken, tell what all would, and a panel is drawn often: taste.
MOST_TRIANGLES = 20000
# An unused sliver shall not raise a warning: this share of the surface is left out at either end.
SHARE = 0.02


@dataclass
class Stretch:
    least: float  # metres per UV unit, below which SHARE of the surface is
    middle: float  # half of the surface
    most: float
    anisotropy: float  # the larger of a triangle's two scales over the smaller; half of the surface is below
    unmapped: float  # share of the surface whose triangles have no area in the map

    @property
    def quotient(self):
        return self.most / self.least


def _edges(corners):
    return corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]


def _triangles(mesh, matrix, layer):
    """World positions and UVs of the corners of all triangles."""
    mesh.calc_loop_triangles()
    step = -(-len(mesh.loop_triangles) // MOST_TRIANGLES)
    loops, vertices = (numpy.empty(3 * len(mesh.loop_triangles), numpy.uint32) for _ in range(2))
    mesh.loop_triangles.foreach_get("loops", loops)
    mesh.loop_triangles.foreach_get("vertices", vertices)
    loops, vertices = (corners.reshape(-1, 3)[::step] for corners in (loops, vertices))
    positions = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", positions)
    turn = numpy.array(matrix.to_3x3(), float)
    world = positions.reshape(-1, 3).astype(float) @ turn.T
    uv = compat.uv_arrays(layer, len(mesh.loops)).astype(float)
    return world[vertices], uv[loops]


def _quantile(values, weights, share):
    order = numpy.argsort(values)
    sums = numpy.cumsum(weights[order])
    return float(values[order][numpy.searchsorted(sums, share * sums[-1])])


def _scales(a, b, c, d):
    """The singular values of dP/d(u, v) = (a b) (c d)^-1: metres per unit, the larger one and the smaller."""
    flat = (c[:, 0] * d[:, 1] - c[:, 1] * d[:, 0])[:, None]
    along_u = (a * d[:, 1:] - b * c[:, 1:]) / flat
    along_v = (b * c[:, :1] - a * d[:, :1]) / flat
    uu, vv, uv = (along_u**2).sum(1), (along_v**2).sum(1), (along_u * along_v).sum(1)
    middle, spread = 0.5 * (uu + vv), numpy.hypot(0.5 * (uu - vv), uv)
    return numpy.sqrt(middle + spread), numpy.sqrt(numpy.maximum(middle - spread, 0.0))


def of_triangles(world, uv):
    """The Stretch of triangles given by their corners, or None without any area."""
    a, b = _edges(world)
    c, d = _edges(uv)
    area = numpy.linalg.norm(numpy.cross(a, b), axis=1)
    flat = numpy.abs(c[:, 0] * d[:, 1] - c[:, 1] * d[:, 0])
    real = area > 0.0
    mapped = real & (flat > 1e-12)
    if not mapped.any():
        return None
    along, across = _scales(a[mapped], b[mapped], c[mapped], d[mapped])
    size = numpy.sqrt(along * across)
    weights = area[mapped]
    return Stretch(
        _quantile(size, weights, SHARE), _quantile(size, weights, 0.5), _quantile(size, weights, 1.0 - SHARE),
        _quantile(along / numpy.maximum(across, 1e-30), weights, 0.5),
        float(area[real & ~mapped].sum() / area[real].sum()),
    )


def of_object(object_, texcoord=0):
    """Of a mesh as it is in the scene, without modifiers; None where it has no such UV map or no area."""
    mesh = object_.data
    if object_.type != "MESH" or texcoord >= len(mesh.uv_layers) or len(mesh.polygons) == 0:
        return None
    return of_triangles(*_triangles(mesh, object_.matrix_world, mesh.uv_layers[texcoord]))


def warnings(found, uv_scale):
    """What an artist should know about a Stretch, one sentence each."""
    said = []
    if found.quotient > MOST_STRETCH:
        said.append(f"UVs stretch: {found.least:.3g} to {found.most:.3g} m per unit, {found.quotient:.2g} times")
    if found.anisotropy > MOST_STRETCH:
        said.append(f"UVs are {found.anisotropy:.2g} times longer one way: so are flakes")
    if found.unmapped > SHARE:
        said.append(f"{100.0 * found.unmapped:.0f} % of the surface has no UVs: no flakes there")
    # A quotient of scales that changes the density as much.
    if not 1.0 / MOST_STRETCH < found.middle / uv_scale < MOST_STRETCH:
        said.append(f"A UV unit measures {found.middle:.3g} m, not {uv_scale:.3g}: the density is off")
    return said
