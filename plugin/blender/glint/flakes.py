# SPDX-License-Identifier: GPL-3.0-or-later
"""Every flake as shader nodes, for Cycles and EEVEE: a cell of the UV map, its normal by White Noise, a mirror of its own.

The explicit model of libglint with `--facets cycles`, flake for flake. A normal map of random flakes alone is wrong: each
flake must be weighed by how much of it is seen and how much of that is masked,

    w = (wo.m) / ((n.m)(n.wo)) G1(wo) G1(wi),    wi = wo mirrored at m,

or the mean is not that of the smooth surface (0.46 to 1.58 times it).
"""

import math
from dataclasses import dataclass

from .graph import Graph

# A uniform of 1 would have an infinite slope: 1 - u is kept above this.
LEAST_REST = 1e-7


@dataclass
class Flakes:
    """Numbers of one material, as glTF has them; see docs/blender.md."""

    distribution: str = "GGX"
    alpha_x: float = 0.25
    alpha_y: float = 0.25
    density_per_m2: float = 1e8
    facet_roughness: float = 0.05
    elongation: float = 1.0
    coverage: float = 1.0
    factor: float = 1.0
    color_variation: float = 0.0
    seed: int = 0
    uv_map: str = ""
    uv_scale: float = 1.0
    f0: tuple = (1.0, 1.0, 1.0)
    f90: tuple = (1.0, 1.0, 1.0)
    diffuse: tuple = (0.0, 0.0, 0.0)


class Frame:
    """Viewer and tangent frame, and what is known about them at every point."""

    def __init__(self, g, uv_map):
        geometry = g.node("ShaderNodeNewGeometry")
        self.n, self.wo = geometry.outputs["Normal"], geometry.outputs["Incoming"]
        along = g.node("ShaderNodeTangent", direction_type="UV_MAP", uv_map=uv_map).outputs[0]
        flat = g.vector("SUBTRACT", along, g.scaled(self.n, g.dot(along, self.n)))
        self.t = g.normalized(flat)
        self.b = g.cross(self.n, self.t)
        self.cos_o = g.at_least(g.dot(self.n, self.wo), 1e-4)


def _cell(g, f):
    """The cell's whole coordinates, with the seed as the third. Blender's v runs upwards, that of glTF downwards."""
    uv = g.node("ShaderNodeUVMap", uv_map=f.uv_map).outputs[0]
    u, v, _ = g.separate(uv)
    cells = f.uv_scale * math.sqrt(f.density_per_m2)
    stretch = math.sqrt(f.elongation)
    x = g.math("FLOOR", g.multiply(u, cells / stretch))
    y = g.math("FLOOR", g.multiply(g.subtract(1.0, v), cells * stretch))
    # -0 is not hashed like 0; adding 0 makes it so.
    return g.combine(g.add(x, 0.0), g.add(y, 0.0), float(f.seed))


def _slopes(g, f, u1, u2):
    """Slope of a flake, in units of alpha, from two uniforms: P22, equal areas seen from above."""
    rest = g.at_least(g.subtract(1.0, u1), LEAST_REST)
    if f.distribution == "GGX":
        squared = g.divide(u1, rest)
    else:
        squared = g.multiply(g.math("LOGARITHM", rest, math.e), -1.0)
    radius = g.square_root(g.at_least(squared, 0.0))
    turn = g.multiply(u2, 2.0 * math.pi)
    return (
        g.multiply(radius, g.math("COSINE", turn), f.alpha_x),
        g.multiply(radius, g.math("SINE", turn), f.alpha_y),
    )


def _unmasked(g, f, frame, direction, cosine):
    """G1 of a direction whose cosine to the normal is given; Smith's, for the smooth surface that the flakes make up."""
    x, y = g.dot(direction, frame.t), g.dot(direction, frame.b)
    cosine2 = g.at_least(g.multiply(cosine, cosine), 1e-9)
    # (alpha tan theta)^2 along the direction.
    stretched = g.divide(
        g.add(g.multiply(x, x, f.alpha_x**2), g.multiply(y, y, f.alpha_y**2)), cosine2
    )
    if f.distribution == "GGX":
        return g.divide(2.0, g.add(1.0, g.square_root(g.add(1.0, stretched))))
    return _beckmann_unmasked(g, g.divide(1.0, g.square_root(g.at_least(stretched, 1e-9))))


def _beckmann_unmasked(g, a):
    """2 / (1 + erf(a) + exp(-a^2) / (a sqrt(pi))). Shader nodes have no erf: Abramowitz and Stegun 7.1.26, to 1.5e-7."""
    a = g.math("MINIMUM", a, 6.0)
    t = g.divide(1.0, g.add(1.0, g.multiply(a, 0.3275911)))
    p = 1.061405429
    for coefficient in (-1.453152027, 1.421413741, -0.284496736, 0.254829592):
        p = g.add(g.multiply(t, p), coefficient)
    gauss = g.math("EXPONENT", g.multiply(a, a, -1.0))
    erf = g.subtract(1.0, g.multiply(t, p, gauss))
    tail = g.divide(gauss, g.multiply(a, math.sqrt(math.pi)))
    return g.divide(2.0, g.add(g.add(1.0, erf), tail))


def _weight(g, f, frame, m):
    """What a flake reflects of the light, beside its Fresnel reflectance."""
    seen = g.at_least(g.dot(frame.wo, m), 0.0)
    n_m = g.dot(frame.n, m)
    mirrored = g.vector("SUBTRACT", g.scaled(m, g.multiply(seen, 2.0)), frame.wo)
    cos_i = g.dot(mirrored, frame.n)
    shown = g.divide(seen, g.multiply(n_m, frame.cos_o))
    masking = g.multiply(
        _unmasked(g, f, frame, frame.wo, frame.cos_o), _unmasked(g, f, frame, mirrored, g.at_least(cos_i, 1e-3))
    )
    return g.multiply(shown, g.is_above(cos_i, 0.0), masking, f.coverage), seen


def _reflectance(g, f, cosine):
    """Schlick's, from f0 to f90, as a colour."""
    away = g.subtract(1.0, g.math("MINIMUM", cosine, 1.0))
    fifth = g.math("POWER", g.at_least(away, 0.0), 5.0)
    rise = g.scaled(tuple(b - a for a, b in zip(f.f0, f.f90)), fifth)
    return g.plus(f.f0, rise)


def _tint(g, f, u3):
    """A hue by the flake's third uniform: 1 + variation cos(hue - a third of a turn per channel); the mean is white."""
    waves = [
        g.add(1.0, g.multiply(g.math("COSINE", g.multiply(g.add(u3, -c / 3.0), 2.0 * math.pi)), f.color_variation))
        for c in range(3)
    ]
    return g.combine(*waves)


def _glossy(g, f, roughness, color, normal=None):
    lobe = g.node("ShaderNodeBsdfGlossy", distribution=f.distribution)
    lobe.inputs["Roughness"].default_value = roughness
    g.connect(color, lobe.inputs["Color"])
    if normal is not None:
        g.connect(normal, lobe.inputs["Normal"])
    return lobe.outputs[0]


def _flake_lobe(g, f, frame):
    noise = g.node("ShaderNodeTexWhiteNoise", noise_dimensions="3D")
    g.connect(_cell(g, f), noise.inputs["Vector"])
    u1, u2, u3 = g.separate(noise.outputs["Color"])
    x, y = _slopes(g, f, u1, u2)
    m = g.normalized(g.plus(frame.n, g.plus(g.scaled(frame.t, x), g.scaled(frame.b, y))))
    weight, cosine = _weight(g, f, frame, m)
    color = g.scaled(_reflectance(g, f, cosine), weight)
    if f.color_variation > 0.0:
        color = g.vector("MULTIPLY", color, _tint(g, f, u3))
    # Cycles' roughness is the root of alpha, as glTF's is.
    return _glossy(g, f, f.facet_roughness, color, m)


def _smooth_lobe(g, f, frame):
    """The same surface without single flakes. Its Fresnel term is taken at the viewer: nodes know no half vector."""
    color = g.scaled(_reflectance(g, f, frame.cos_o), f.coverage)
    return _glossy(g, f, (f.alpha_x * f.alpha_y) ** 0.25, color)


def _base(g, f, frame):
    """What the flakes let through, seen from the viewer, over a Lambertian base."""
    through = g.vector("SUBTRACT", (1.0, 1.0, 1.0), g.scaled(_reflectance(g, f, frame.cos_o), f.coverage))
    base = g.node("ShaderNodeBsdfDiffuse")
    g.connect(g.vector("MULTIPLY", f.diffuse, through), base.inputs["Color"])
    return base.outputs[0]


def _sum(g, a, b):
    made = g.node("ShaderNodeAddShader")
    g.tree.links.new(a, made.inputs[0])
    g.tree.links.new(b, made.inputs[1])
    return made.outputs[0]


def _mix(g, share, a, b):
    made = g.node("ShaderNodeMixShader")
    made.inputs[0].default_value = share
    g.tree.links.new(a, made.inputs[1])
    g.tree.links.new(b, made.inputs[2])
    return made.outputs[0]


def build(tree, f, smooth=False):
    """Fills an empty node tree with the flakes; returns the shader's socket. smooth: the same without single flakes."""
    g = Graph(tree)
    frame = Frame(g, f.uv_map)
    factor = 0.0 if smooth else f.factor
    if factor >= 1.0:
        lobe = _flake_lobe(g, f, frame)
    elif factor <= 0.0:
        lobe = _smooth_lobe(g, f, frame)
    else:
        lobe = _mix(g, factor, _smooth_lobe(g, f, frame), _flake_lobe(g, f, frame))
    return _sum(g, lobe, _base(g, f, frame)) if any(c > 0.0 for c in f.diffuse) else lobe
