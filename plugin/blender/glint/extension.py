# SPDX-License-Identifier: GPL-3.0-or-later
"""GLINT_materials_glint as a dictionary, and the values of a property group: one table says how they correspond.

No bpy here: the add-on, its tests and other programs can use it alike.
"""

import math

NAME = "GLINT_materials_glint"

CM2_PER_M2 = 1e4


def _significant(x, digits=6):
    """Rounded, so that a float of Blender's comes out as what an artist typed."""
    return 0.0 if x == 0.0 else round(x, digits - 1 - math.floor(math.log10(abs(x))))


def _number(x):
    return _significant(float(x))


def _color(c):
    return [_significant(float(x)) for x in c]


def _density(exponent):
    return _significant(10.0**exponent * CM2_PER_M2)


def _exponent(density):
    return math.log10(density / CM2_PER_M2)


def _lower(x):
    return x.lower()


def _upper(x):
    return x.upper()


# Property of glTF, attribute of the group, default of glTF, to glTF, from glTF.
TABLE = (
    ("glintFactor", "factor", 0.0, _number, float),
    ("glintDistribution", "distribution", "ggx", _lower, _upper),
    ("glintDensity", "density_exponent", 1e8, _density, _exponent),
    ("glintFacetRoughness", "facet_roughness", 0.05, _number, float),
    ("glintColorFactor", "color", [1.0, 1.0, 1.0], _color, list),
    ("glintColorVariation", "color_variation", 0.0, _number, float),
    ("glintElongation", "elongation", 1.0, _number, float),
    ("glintCoverage", "coverage", 1.0, _number, float),
    ("glintDensityVariation", "density_variation", 0.0, _number, float),
    ("glintSpace", "space", "uv", _lower, _upper),
    ("glintUvScale", "uv_scale", 1.0, _number, float),
    ("glintLayer", "layer", "base", _lower, _upper),
    ("glintSeed", "seed", 0, int, int),
)


def from_values(values):
    """The extension that says what a property group (or anything with its attributes) says; defaults are left out."""
    out = {}
    for name, attribute, default, to_gltf, _ in TABLE:
        value = to_gltf(getattr(values, attribute))
        if value != default:
            out[name] = value
    return out


def to_values(extension):
    """Attributes and what to set them to: all of them, so that nothing of an earlier material stays."""
    return {
        attribute: from_gltf(extension.get(name, default)) for name, attribute, default, _, from_gltf in TABLE
    }


def apply(extension, group):
    for attribute, value in to_values(extension).items():
        setattr(group, attribute, value)
    group.enabled = group.factor > 0.0
