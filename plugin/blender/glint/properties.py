# SPDX-License-Identifier: GPL-3.0-or-later
"""What the flakes of a material are: the one property group that everything else is made from."""

import math

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty


def _density(group):
    return 10.0**group.density_exponent


def _facet_size_um(group):
    """Side of the square that a flake has, micrometres: 1 / density is its area where flakes cover the surface."""
    return 1e4 / _density(group) ** 0.5


class GlintProperties(bpy.types.PropertyGroup):
    """Flakes of a material. Roughness, metallic and base colour stay where they are, in the Principled BSDF: they say how
    far flakes tilt and what they reflect."""

    enabled: BoolProperty(name="Glints", description="Show single flakes", default=False)
    factor: FloatProperty(
        name="Strength",
        description="Share of the reflected light that comes from single flakes; the rest is smooth. The mean stays",
        min=0.0, max=1.0, default=1.0, subtype="FACTOR",
    )
    distribution: EnumProperty(
        name="Distribution",
        description="How the flakes tilt",
        items=(
            ("GGX", "GGX", "Long tails: some flakes tilt far"),
            ("BECKMANN", "Beckmann", "As a rough surface of waves has it: few flakes tilt far"),
        ),
        default="GGX",
    )
    density_exponent: FloatProperty(
        name="Density (powers of ten)",
        description="Flakes per square centimetre as a power of ten: 2 is glitter, 5 metallic paint",
        min=-4.0, max=10.0, soft_min=0.0, soft_max=8.0, default=4.0, step=10, precision=2,
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
    facet_roughness: FloatProperty(
        name="Flake roughness",
        description="How far one flake spreads its own reflection. Small: hard sparks",
        min=0.0, max=1.0, default=0.05, subtype="FACTOR",
    )
    color: FloatVectorProperty(
        name="Tint", description="Colour of the flakes, times the base colour", subtype="COLOR", size=3,
        min=0.0, max=1.0, default=(1.0, 1.0, 1.0),
    )
    color_variation: FloatProperty(
        name="Colour variation", description="How far the hue of one flake strays", min=0.0, max=1.0, default=0.0,
        subtype="FACTOR",
    )
    elongation: FloatProperty(
        name="Elongation", description="Length over width of a flake, along u", min=1.0, max=1e4, soft_max=50.0,
        default=1.0,
    )
    coverage: FloatProperty(
        name="Coverage", description="Share of the surface that carries flakes", min=0.0, max=1.0, default=1.0,
        subtype="FACTOR",
    )
    density_variation: FloatProperty(
        name="Density variation", description="Patches of more and of fewer flakes", min=0.0, max=8.0, soft_max=2.0,
        default=0.0,
    )
    space: EnumProperty(
        name="Mapping",
        items=(
            ("UV", "UV", "Flakes lie where the UV map puts them"),
            ("OBJECT", "Object", "Flakes are laid out in the object's own space: no UV map, no stretching"),
        ),
        default="UV",
    )
    uv_scale: FloatProperty(
        name="Metres per UV unit", description="How long one unit of the UV map is on the surface", min=1e-6,
        max=1e6, soft_max=10.0, default=1.0, precision=4,
    )
    layer: EnumProperty(
        name="Layer",
        items=(
            ("BASE", "Base", "Flakes are what the base reflects with"),
            ("CLEARCOAT", "Clearcoat", "Flakes lie in the clear coat"),
        ),
        default="BASE",
    )
    seed: IntProperty(name="Seed", description="Which flakes there are", min=0, max=2**31 - 1, default=0)


def register():
    bpy.utils.register_class(GlintProperties)
    bpy.types.Material.glint = PointerProperty(type=GlintProperties)


def unregister():
    del bpy.types.Material.glint
    bpy.utils.unregister_class(GlintProperties)
