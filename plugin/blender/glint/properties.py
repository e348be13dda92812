# SPDX-License-Identifier: GPL-3.0-or-later
"""What the flakes of a material are: the one property group that everything else is made from."""

import math

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
)


def _changed(group, context):
    """Nodes that were built from the properties follow them."""
    from . import nodes  # which reads these properties

    nodes.refresh(group.id_data)


def _density(group):
    return 10.0**group.density_exponent


def _facet_size_um(group):
    """Side of the square that a flake has, micrometres: 1 / density is its area where flakes cover the surface."""
    return 1e4 / _density(group) ** 0.5


class GlintTexture(bpy.types.PropertyGroup):
    """An image and how it lies on the surface: glTF's textureInfo with KHR_texture_transform."""

    image: PointerProperty(name="Image", type=bpy.types.Image, update=_changed)
    texcoord: IntProperty(
        name="UV map", description="Which UV map of the mesh: 0 is the first", min=0, max=1, default=0, update=_changed
    )
    offset: FloatVectorProperty(name="Offset", size=2, default=(0.0, 0.0), update=_changed)
    rotation: FloatProperty(
        name="Rotation", description="As glTF turns textures", subtype="ANGLE", default=0.0, update=_changed
    )
    scale: FloatVectorProperty(name="Scale", size=2, default=(1.0, 1.0), update=_changed)
    closest: BoolProperty(
        name="Closest", description="No interpolation between texels", default=False, update=_changed
    )


class GlintColor(bpy.types.PropertyGroup):
    """One colour of a palette."""

    color: FloatVectorProperty(
        name="Colour", subtype="COLOR", size=3, min=0.0, max=1.0, default=(1.0, 1.0, 1.0), update=_changed
    )


class Facets:
    """What base and clear coat have in common. Roughness, metallic and base colour stay where they are, in the Principled
    BSDF: they say how far flakes tilt and what they reflect."""

    enabled: BoolProperty(name="Glints", description="Show single flakes", default=False, update=_changed)
    factor: FloatProperty(
        name="Strength",
        description="Share of the reflected light that comes from single flakes; the rest is smooth. The mean stays",
        min=0.0, max=1.0, default=1.0, subtype="FACTOR", update=_changed,
    )
    factor_texture: PointerProperty(name="Strength texture", type=GlintTexture)
    distribution: EnumProperty(
        name="Distribution",
        description="How the flakes tilt",
        items=(
            ("GGX", "GGX", "Long tails: some flakes tilt far"),
            ("BECKMANN", "Beckmann", "As a rough surface of waves has it: few flakes tilt far"),
        ),
        default="GGX", update=_changed,
    )
    density_exponent: FloatProperty(
        name="Density (powers of ten)",
        description="Flakes per square centimetre as a power of ten: 2 is glitter, 5 metallic paint",
        min=-4.0, max=10.0, soft_min=0.0, soft_max=8.0, default=4.0, step=10, precision=2, update=_changed,
    )
    density_per_cm2: FloatProperty(
        name="Density",
        description="Flakes per square centimetre",
        min=1e-4, max=1e10, precision=0,
        get=_density,
        set=lambda group, value: setattr(group, "density_exponent", math.log10(max(value, 1e-4))),
    )
    facet_size_um: FloatProperty(
        name="Flake size",
        description="Side of a flake in micrometres, where flakes of this density cover the surface",
        min=0.1, max=1e6, precision=1,
        get=_facet_size_um,
        set=lambda group, value: setattr(group, "density_per_cm2", (1e4 / max(value, 0.1)) ** 2),
    )
    density_texture: PointerProperty(name="Density texture", type=GlintTexture)
    facet_roughness: FloatProperty(
        name="Flake roughness",
        description="How far one flake spreads its own reflection. Small: hard sparks",
        min=0.0, max=1.0, default=0.05, subtype="FACTOR", update=_changed,
    )
    color: FloatVectorProperty(
        name="Tint", description="Colour of the flakes, times the base colour", subtype="COLOR", size=3,
        min=0.0, max=1.0, default=(1.0, 1.0, 1.0), update=_changed,
    )
    color_texture: PointerProperty(name="Tint texture", type=GlintTexture)
    color_variation: FloatProperty(
        name="Colour variation", description="How far the hue of one flake strays", min=0.0, max=1.0, default=0.0,
        subtype="FACTOR", update=_changed,
    )
    colors: CollectionProperty(name="Palette", type=GlintColor)
    elongation: FloatProperty(
        name="Elongation", description="Length over width of a flake, along u", min=1.0, max=1e4, soft_max=50.0,
        default=1.0, update=_changed,
    )
    coverage: FloatProperty(
        name="Coverage", description="Share of the surface that carries flakes", min=0.0, max=1.0, default=1.0,
        subtype="FACTOR", update=_changed,
    )
    density_variation: FloatProperty(
        name="Density variation", description="Patches of more and of fewer flakes", min=0.0, max=8.0, soft_max=2.0,
        default=0.0, update=_changed,
    )
    space: EnumProperty(
        name="Mapping",
        items=(
            ("UV", "UV", "Flakes lie where the UV map puts them"),
            ("OBJECT", "Object", "Flakes are laid out in the object's own space: no UV map, no stretching"),
        ),
        default="UV", update=_changed,
    )
    texcoord: IntProperty(
        name="UV map", description="Which UV map of the mesh: 0 is the first", min=0, max=1, default=0, update=_changed
    )
    uv_scale: FloatProperty(
        name="Metres per UV unit", description="How long one unit of the UV map is on the surface", min=1e-6,
        max=1e6, soft_max=10.0, default=1.0, precision=4, update=_changed,
    )
    seed: IntProperty(
        name="Seed", description="Which flakes there are", min=0, max=2**31 - 1, default=0, update=_changed
    )
    structure: EnumProperty(
        name="Structure",
        items=(
            ("FLAKES", "Flakes", "Single flakes"),
            ("EXAMPLE", "Example", "Copies of a small normal map: scratches, brushed metal, leather"),
        ),
        default="FLAKES", update=_changed,
    )
    example_texture: PointerProperty(name="Example", type=GlintTexture)
    example_placement: EnumProperty(
        name="Placement",
        items=(
            ("TILED", "Tiled", "Side by side, all alike"),
            ("SCATTERED", "Scattered", "One at a random place in every square, turned and scaled at random"),
        ),
        default="TILED", update=_changed,
    )
    example_size: FloatProperty(
        name="Size", description="Side of the example on the surface, metres", min=1e-7, max=1e3, soft_min=1e-4,
        soft_max=1.0, default=0.01, precision=5, update=_changed,
    )
    example_rotation_variation: FloatProperty(
        name="Rotation", description="How far a scattered example is turned, either way", min=0.0, max=math.pi,
        default=math.pi, subtype="ANGLE", update=_changed,
    )
    example_scale_variation: FloatProperty(
        name="Scale", description="How far the size of a scattered example strays, either way", min=0.0, max=0.5,
        default=0.2, subtype="FACTOR", update=_changed,
    )


class GlintCoatProperties(Facets, bpy.types.PropertyGroup):
    """Flakes of the clear coat, beside those of the base."""


class GlintProperties(Facets, bpy.types.PropertyGroup):
    """Flakes of a material, and those of its clear coat."""

    layer: EnumProperty(
        name="Layer",
        items=(
            ("BASE", "Base", "Flakes are what the base reflects with"),
            ("CLEARCOAT", "Clearcoat", "Flakes lie in the clear coat"),
        ),
        default="BASE", update=_changed,
    )
    specular_color: FloatVectorProperty(
        name="Specular colour",
        description="Multiplies what a surface that is no metal reflects head-on; the Principled BSDF has no room for it",
        subtype="COLOR", size=3, min=0.0, max=100.0, soft_max=1.0, default=(1.0, 1.0, 1.0), update=_changed,
    )
    coat: PointerProperty(type=GlintCoatProperties)


CLASSES = (GlintTexture, GlintColor, GlintCoatProperties, GlintProperties)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Material.glint = PointerProperty(type=GlintProperties)


def unregister():
    del bpy.types.Material.glint
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
