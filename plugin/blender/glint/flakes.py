# SPDX-License-Identifier: GPL-3.0-or-later
"""Every flake as shader nodes, for Cycles and EEVEE: a cell of the surface, its normal by White Noise, a mirror of its own.

The explicit model of libglint with `--facets cycles`, flake for flake. A normal map of random flakes alone is wrong: each
flake must be weighed by how much of it is seen and how much of that is masked,

    w = (wo.m) / ((n.m)(n.wo)) G1(wo) G1(wi),    wi = wo mirrored at m,

or the mean is not that of the smooth surface (0.46 to 1.58 times it).
"""

import math
from dataclasses import dataclass
from typing import Any

from . import tint

# A uniform of 1 would have an infinite slope: 1 - u is kept above this.
LEAST_REST = 1e-7


@dataclass
class Layer:
    """What one layer is made of: numbers, or sockets where a texture says them."""

    distribution: str = "GGX"
    alpha_x: Any = 0.25
    alpha_y: Any = 0.25
    f0: Any = (1.0, 1.0, 1.0)
    f90: Any = (1.0, 1.0, 1.0)
    factor: Any = 0.0  # 0: smooth
    density_per_m2: Any = 1e8
    facet_roughness: float = 0.05
    elongation: float = 1.0
    coverage: float = 1.0
    color_variation: float = 0.0
    colors: tuple = ()
    seed: int = 0
    example: Any = None  # see example.py
    through: Any = None  # called with the cosine of wo and that of wi: what comes through a coat above, a colour


class Frame:
    """Viewer and tangent frame, and what is known about them at every point. The first axis is that of alpha_x."""

    def __init__(self, g, along, normal=None, rotation=0.0):
        geometry = g.node("ShaderNodeNewGeometry")
        self.n = geometry.outputs["Normal"] if normal is None else normal
        self.wo = geometry.outputs["Incoming"]
        self.true_normal, self.position = geometry.outputs["True Normal"], geometry.outputs["Position"]
        flat = g.minus(along, g.scaled(self.n, g.dot(along, self.n)))
        self.t = g.normalized(flat)
        self.b = g.cross(self.n, self.t)
        if rotation != 0.0:
            c, s = math.cos(rotation), math.sin(rotation)
            turned = g.plus(g.scaled(self.t, c), g.scaled(self.b, s))
            self.t, self.b = turned, g.cross(self.n, turned)
        self.cos_o = g.at_least(g.dot(self.n, self.wo), 1e-4)


def _cell(g, layer, place):
    """The cell's whole coordinates, with the seed as the third."""
    cells = g.square_root(g.multiply(layer.density_per_m2, place.density_scale))
    stretch = math.sqrt(layer.elongation)
    x = g.math("FLOOR", g.multiply(place.u, g.multiply(cells, 1.0 / stretch)))
    y = g.math("FLOOR", g.multiply(place.v, g.multiply(cells, stretch)))
    # -0 is not hashed like 0; adding 0 makes it so.
    return g.combine(g.add(x, 0.0), g.add(y, 0.0), float(layer.seed))


def _slopes(g, layer, u1, u2):
    """Slope of a flake from two uniforms: P22, equal areas seen from above."""
    rest = g.at_least(g.subtract(1.0, u1), LEAST_REST)
    if layer.distribution == "GGX":
        squared = g.divide(u1, rest)
    else:
        squared = g.multiply(g.math("LOGARITHM", rest, math.e), -1.0)
    radius = g.square_root(g.at_least(squared, 0.0))
    turn = g.multiply(u2, 2.0 * math.pi)
    return (
        g.multiply(radius, g.math("COSINE", turn), layer.alpha_x),
        g.multiply(radius, g.math("SINE", turn), layer.alpha_y),
    )


def _unmasked(g, layer, frame, direction, cosine):
    """G1 of a direction whose cosine to the normal is given; Smith's, for the smooth surface that the flakes make up."""
    x = g.multiply(g.dot(direction, frame.t), layer.alpha_x)
    y = g.multiply(g.dot(direction, frame.b), layer.alpha_y)
    cosine2 = g.at_least(g.multiply(cosine, cosine), 1e-9)
    # (alpha tan theta)^2 along the direction.
    stretched = g.divide(g.add(g.multiply(x, x), g.multiply(y, y)), cosine2)
    if layer.distribution == "GGX":
        return g.divide(2.0, g.add(1.0, g.square_root(g.add(1.0, stretched))))
    return _beckmann_unmasked(g, g.divide(1.0, g.square_root(g.at_least(stretched, 1e-9))))


def _beckmann_unmasked(g, a):
    """2 / (1 + erf(a) + exp(-a^2) / (a sqrt(pi))). Shader nodes have no erf: Abramowitz and Stegun 7.1.26, to 1.5e-7."""
    a = g.at_most(a, 6.0)
    t = g.divide(1.0, g.add(1.0, g.multiply(a, 0.3275911)))
    p = 1.061405429
    for coefficient in (-1.453152027, 1.421413741, -0.284496736, 0.254829592):
        p = g.add(g.multiply(t, p), coefficient)
    gauss = g.math("EXPONENT", g.multiply(a, a, -1.0))
    erf = g.subtract(1.0, g.multiply(t, p, gauss))
    tail = g.divide(gauss, g.multiply(a, math.sqrt(math.pi)))
    return g.divide(2.0, g.add(g.add(1.0, erf), tail))


def reflectance(g, layer, cosine):
    """Schlick's, from f0 to f90, as a colour."""
    away = g.subtract(1.0, g.at_most(cosine, 1.0))
    fifth = g.math("POWER", g.at_least(away, 0.0), 5.0)
    return g.plus(layer.f0, g.scaled(g.minus(layer.f90, layer.f0), fifth))


def _weighed(g, layer, frame, m):
    """The colour of a flake of normal m: what it reflects, how much of it is seen, what a coat lets through."""
    seen = g.at_least(g.dot(frame.wo, m), 0.0)
    mirrored = g.minus(g.scaled(m, g.multiply(seen, 2.0)), frame.wo)
    cos_i = g.dot(mirrored, frame.n)
    shown = g.divide(seen, g.multiply(g.dot(frame.n, m), frame.cos_o))
    masking = g.multiply(
        _unmasked(g, layer, frame, frame.wo, frame.cos_o),
        _unmasked(g, layer, frame, mirrored, g.at_least(cos_i, 1e-3)),
    )
    weight = g.multiply(shown, g.is_above(cos_i, 0.0), masking, layer.coverage)
    color = g.scaled(reflectance(g, layer, seen), weight)
    if layer.through is not None:
        color = g.times(color, layer.through(frame.cos_o, cos_i))
    return color


def _random_flake(g, layer, frame, place):
    """Normal and tint of the flake at a place."""
    noise = g.node("ShaderNodeTexWhiteNoise", noise_dimensions="3D")
    g.connect(_cell(g, layer, place), noise.inputs["Vector"])
    u1, u2, u3 = g.separate(noise.outputs["Color"])
    x, y = _slopes(g, layer, u1, u2)
    m = g.normalized(g.plus(frame.n, g.plus(g.scaled(frame.t, x), g.scaled(frame.b, y))))
    return m, tint.of(g, layer, u3)


def _flakes(g, layer, frame, place):
    """The lobe of the flake at a place."""
    if layer.example is not None:
        m, color = layer.example.normal(g, frame, place), None
    else:
        m, color = _random_flake(g, layer, frame, place)
    weighed = _weighed(g, layer, frame, m)
    if color is not None:
        weighed = g.times(weighed, color)
    return g.glossy(layer.distribution, layer.facet_roughness, weighed, m)


def _smooth(g, layer, frame):
    """The same surface without single flakes. Its Fresnel term is taken at the viewer: nodes know no half vector."""
    color = g.scaled(reflectance(g, layer, frame.cos_o), layer.coverage)
    if layer.through is not None:
        color = g.times(color, layer.through(frame.cos_o, frame.cos_o))
    # The mean of two roughnesses, whose product is that of the alphas.
    roughness = g.math("POWER", g.multiply(layer.alpha_x, layer.alpha_y), 0.25)
    return g.glossy(layer.distribution, roughness, color, frame.n)


def lobe(g, layer, frame, place):
    """The shader of a layer's flakes and of the share that is smooth. place is not looked at where all is smooth."""
    if not layer.factor:
        return _smooth(g, layer, frame)
    flakes = _flakes(g, layer, frame, place)
    if layer.factor == 1.0:
        return flakes
    return g.mix(layer.factor, _smooth(g, layer, frame), flakes)
