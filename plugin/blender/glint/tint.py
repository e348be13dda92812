# SPDX-License-Identifier: GPL-3.0-or-later
"""The colour of a flake from one uniform, as nodes: one of a palette, then a hue; the mean is white. As src/model/tint_lanes.h."""

import math


def _relative(colors):
    """The palette over its mean, so that the surface keeps its colour; a channel that no colour has stays."""
    sums = [sum(color[c] for color in colors) for c in range(3)]
    return [tuple(color[c] * len(colors) / sums[c] if sums[c] > 1e-6 else 1.0 for c in range(3)) for color in colors]


def _pick(g, colors, index):
    """The colour of this number: nodes have no table, so each is asked whether it is meant."""
    total = (0.0, 0.0, 0.0)
    for i, color in enumerate(colors):
        total = g.plus(total, g.scaled(color, g.math("COMPARE", index, float(i), 0.1)))
    return total


def of(g, layer, uniform):
    """None where all flakes have one colour."""
    if not layer.colors and layer.color_variation <= 0.0:
        return None
    uniform = g.at_most(uniform, 0.99999994)
    color, hue = None, uniform
    if len(layer.colors) > 1:
        place = g.multiply(uniform, float(len(layer.colors)))
        index = g.math("FLOOR", place)
        color, hue = _pick(g, _relative(layer.colors), index), g.subtract(place, index)
    if layer.color_variation > 0.0:
        waves = g.combine(*(
            g.add(1.0, g.multiply(g.math("COSINE", g.multiply(g.add(hue, c / 3.0), 2.0 * math.pi)), layer.color_variation))
            for c in range(3)
        ))
        color = waves if color is None else g.times(color, waves)
    return color
