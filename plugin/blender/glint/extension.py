# SPDX-License-Identifier: GPL-3.0-or-later
"""GLINT_materials_glint as a dictionary, and the values of a property group: tables say how they correspond.

No bpy here: the add-on, its tests and other programs can use it alike. A texture is a textureInfo here; what its index means
is for the caller to say.
"""

import math
import struct

NAME = "GLINT_materials_glint"
COAT = "KHR_materials_clearcoat"

CM2_PER_M2 = 1e4
MOST_COLORS = 8


def single(x):
    """Rounded to the single precision in which Blender keeps numbers."""
    return struct.unpack("f", struct.pack("f", x))[0]


def _shortest(x, stored, keep):
    """The shortest decimal near x that Blender would keep as `stored`: what an artist typed, or a file said."""
    for digits in range(1, 10):
        candidate = float(f"{x:.{digits}g}")
        if keep(candidate) == stored:
            return candidate
    return x


def number(x):
    return _shortest(float(x), single(x), single)


def _color(c):
    return [number(x) for x in c]


def _exponent(density):
    return math.log10(density / CM2_PER_M2)


def _density(exponent):
    return _shortest(10.0**exponent * CM2_PER_M2, single(exponent), lambda density: single(_exponent(density)))


def _lower(x):
    return x.lower()


def _upper(x):
    return x.upper()


# Property of glTF, attribute of the group, default of glTF, to glTF, from glTF.
TABLE = (
    ("glintFactor", "factor", 0.0, number, float),
    ("glintDistribution", "distribution", "ggx", _lower, _upper),
    ("glintDensity", "density_exponent", 1e8, _density, _exponent),
    ("glintFacetRoughness", "facet_roughness", 0.05, number, float),
    ("glintColorFactor", "color", [1.0, 1.0, 1.0], _color, list),
    ("glintColorVariation", "color_variation", 0.0, number, float),
    ("glintElongation", "elongation", 1.0, number, float),
    ("glintCoverage", "coverage", 1.0, number, float),
    ("glintDensityVariation", "density_variation", 0.0, number, float),
    ("glintSpace", "space", "uv", _lower, _upper),
    ("glintTexCoord", "texcoord", 0, int, int),
    ("glintUvScale", "uv_scale", 1.0, number, float),
    ("glintLayer", "layer", "base", _lower, _upper),
    ("glintSeed", "seed", 0, int, int),
    ("glintStructure", "structure", "flakes", _lower, _upper),
    ("glintExamplePlacement", "example_placement", "tiled", _lower, _upper),
    ("glintExampleSize", "example_size", 0.01, number, float),
    ("glintExampleRotationVariation", "example_rotation_variation", math.pi, number, float),
    ("glintExampleScaleVariation", "example_scale_variation", 0.2, number, float),
)

# Property of glTF, attribute of the group.
TEXTURES = (
    ("glintTexture", "factor_texture"),
    ("glintDensityTexture", "density_texture"),
    ("glintColorTexture", "color_texture"),
    ("glintExampleTexture", "example_texture"),
)


def _same(a, b):
    """Equal as Blender keeps them: pi is not its own single-precision neighbour."""
    return single(a) == single(b) if isinstance(a, float) and isinstance(b, float) else a == b


def from_values(values, texture_info=lambda texture: None):
    """The extension that says what a property group (or anything with its attributes) says; defaults are left out.

    texture_info  makes a textureInfo of an attribute of TEXTURES, or None
    """
    out = {}
    for name, attribute, default, to_gltf, _ in TABLE:
        if not hasattr(values, attribute):
            continue
        value = to_gltf(getattr(values, attribute))
        if not _same(value, default):
            out[name] = value
    colors = [_color(entry.color) for entry in getattr(values, "colors", ())]
    if colors:
        out["glintColors"] = colors
    for name, attribute in TEXTURES:
        info = texture_info(getattr(values, attribute, None))
        if info is not None:
            out[name] = info
    return out


def _read(extension, name, default, from_gltf):
    found = extension.get(name, default)
    try:
        return from_gltf(found)
    except (TypeError, ValueError, AttributeError):
        raise ValueError(f"{name}: found {found!r}, expected something like {default!r}") from None


def to_values(extension):
    """Attributes and what to set them to: all of them, so that nothing of an earlier material stays."""
    return {
        attribute: _read(extension, name, default, from_gltf) for name, attribute, default, _, from_gltf in TABLE
    }


def _apply_colors(extension, group):
    group.colors.clear()
    for color in extension.get("glintColors", [])[:MOST_COLORS]:
        group.colors.add().color = [float(c) for c in color]


def apply(extension, group, set_texture=lambda texture, info: None):
    """Sets a property group.

    set_texture  sets an attribute of TEXTURES from a textureInfo, None: to nothing
    """
    values = to_values(extension)
    for attribute, value in values.items():
        if hasattr(group, attribute):
            setattr(group, attribute, value)
    _apply_colors(extension, group)
    for name, attribute in TEXTURES:
        set_texture(getattr(group, attribute), extension.get(name))
    group.enabled = group.factor > 0.0


def apply_material(extensions, group, set_texture=lambda texture, info: None):
    """Sets the group of a material, coat included, from the extensions of a glTF material."""
    apply(extensions.get(NAME, {}), group, set_texture)
    coat = extensions.get(COAT, {}).get("extensions", {}).get(NAME, {})
    apply(coat, group.coat, set_texture)


def of_material(group, texture_info=lambda texture: None):
    """What a material's own extension and that inside its coat say; None: nothing."""
    own = from_values(group, texture_info) if group.enabled else None
    # Two sets of facets cannot lie in one coat.
    in_coat = group.coat.enabled and not (group.enabled and group.layer == "CLEARCOAT")
    return own, from_values(group.coat, texture_info) if in_coat else None
