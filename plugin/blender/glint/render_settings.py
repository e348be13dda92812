# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of the render engine: properties of the scene and of its view layers."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

from . import abi

ENGINE = "GLINT"

# Names of passes in Blender and in files, channels, their letters, kind, and the library's pass.
OWN_PASSES = {
    "use_smooth": ("Glint Smooth", 3, "RGB", "COLOR", abi.SMOOTH),
    "use_count": ("Glint Count", 1, "X", "VALUE", abi.GLINT_COUNT),
    "use_probability": ("Glint Probability", 1, "X", "VALUE", abi.GLINT_PROBABILITY),
}
# Those that every engine calls so, by the property of the view layer that asks for them.
COMMON_PASSES = {
    "use_pass_normal": ("Normal", 3, "XYZ", "VECTOR", abi.NORMAL),
    "use_pass_z": ("Depth", 1, "Z", "VALUE", abi.DEPTH),
    "use_pass_diffuse_color": ("DiffCol", 3, "RGB", "COLOR", abi.ALBEDO),
}

# Numbers of glint.h.
MODELS = {"AUTO": -1, "SMOOTH": 0, "COUNTING": 1, "EXPLICIT": 2, "DICTIONARY": 3, "EXAMPLE": 4}


class GlintRenderSettings(bpy.types.PropertyGroup):
    samples: IntProperty(
        name="Samples", min=0, max=65536, default=64,
        description="Samples a pixel of a final render; powers of 4 are spread best. 0: as many as the accuracy takes",
    )
    preview_samples: IntProperty(
        name="Viewport Samples", description="Samples a pixel of the viewport, which come one after the other", min=1,
        max=65536, default=64,
    )
    accuracy: FloatProperty(
        name="Accuracy",
        description="The error that a final render may have for speed: relative, root mean square over pixels. 0 leaves nothing out",
        min=0.0, max=1.0, default=0.02, precision=3, step=1,
    )
    preview_accuracy: FloatProperty(
        name="Viewport Accuracy", description="The error that the viewport may have for speed", min=0.0, max=1.0, default=0.05,
        precision=3, step=1,
    )
    bounces: IntProperty(
        name="Bounces", description="Of light from surface to surface; 0 shows lights and world only", min=0, max=64,
        default=1,
    )
    model: EnumProperty(
        name="Model",
        description="How facets are evaluated",
        items=(
            ("AUTO", "Automatic", "For each material the one that shows what it asks for"),
            ("SMOOTH", "Smooth", "Infinitely many facets: no sparkle"),
            ("COUNTING", "Counting", "The number of lit facets under a pixel, by their statistics"),
            ("EXPLICIT", "Explicit", "Every facet under a pixel, one by one: the truth, slow"),
            ("DICTIONARY", "Dictionary", "Patches of hundreds of lobes"),
            ("EXAMPLE", "Example", "A small normal map, repeated"),
        ),
        default="AUTO",
    )
    seed: IntProperty(
        name="Seed", description="Of the sampling noise. The flakes have the material's own", min=0, max=2**31 - 1, default=0,
    )
    animate_seed: BoolProperty(
        name="Animate Seed", description="Other noise in every frame; the flakes stay", default=False,
    )


class GlintLayerSettings(bpy.types.PropertyGroup):
    use_smooth: BoolProperty(name="Smooth", description="The picture without single facets", default=False)
    use_count: BoolProperty(name="Glint Count", description="Facets under the pixel", default=False)
    use_probability: BoolProperty(
        name="Glint Probability", description="That a facet under the pixel mirrors the brightest light to the camera",
        default=False,
    )


def passes_of(layer):
    """Passes besides Combined that a view layer asks for."""
    own = [each for name, each in OWN_PASSES.items() if getattr(layer.glint, name)]
    return own + [each for name, each in COMMON_PASSES.items() if getattr(layer, name)]


def threads_of(scene):
    """Of Blender's own setting; 0: one a core."""
    return scene.render.threads if scene.render.threads_mode == "FIXED" else 0


def shading_of(scene, accuracy):
    """How materials are evaluated: with nothing left out where the accuracy is 0."""
    return {"model": MODELS[scene.glint.model], "exact_lights": not accuracy > 0.0}


PROPERTIES = (GlintRenderSettings, GlintLayerSettings)


def register():
    for cls in PROPERTIES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.glint = PointerProperty(type=GlintRenderSettings)
    bpy.types.ViewLayer.glint = PointerProperty(type=GlintLayerSettings)


def unregister():
    del bpy.types.ViewLayer.glint, bpy.types.Scene.glint
    for cls in reversed(PROPERTIES):
        bpy.utils.unregister_class(cls)
