# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of the render engine: properties of the scene and of its view layers, and the panels that show them."""

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty

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
        name="Samples", description="Samples a pixel of a final render; powers of 4 are spread best", min=1, max=65536,
        default=64,
    )
    preview_samples: IntProperty(
        name="Viewport Samples", description="Samples a pixel of the viewport, which come one after the other", min=1,
        max=65536, default=64,
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


class _Panel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES


class GLINT_PT_sampling(_Panel, bpy.types.Panel):
    bl_label = "Sampling"
    bl_context = "render"

    def draw(self, context):
        layout, settings = self.layout, context.scene.glint
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(align=True)
        column.prop(settings, "samples", text="Render")
        column.prop(settings, "preview_samples", text="Viewport")
        layout.prop(settings, "bounces")
        layout.prop(settings, "model")
        row = layout.row(align=True)
        row.prop(settings, "seed")
        row.prop(settings, "animate_seed", text="", icon="TIME")


class GLINT_PT_film(_Panel, bpy.types.Panel):
    bl_label = "Film"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.prop(context.scene.render, "film_transparent", text="Transparent")


class GLINT_PT_passes(_Panel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        layout, layer = self.layout, context.view_layer
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(heading="Glints", align=True)
        for name in OWN_PASSES:
            column.prop(layer.glint, name)
        column = layout.column(heading="Data", align=True)
        column.prop(layer, "use_pass_z", text="Depth")
        column.prop(layer, "use_pass_normal", text="Normal")
        column.prop(layer, "use_pass_diffuse_color", text="Albedo")


class GLINT_PT_light(_Panel, bpy.types.Panel):
    bl_label = "Light"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return context.light is not None and super().poll(context)

    def draw(self, context):
        layout, light = self.layout, context.light
        layout.use_property_split = True
        layout.prop(light, "type", expand=True)
        layout.prop(light, "color")
        layout.prop(light, "energy")
        if light.type == "SUN":
            layout.prop(light, "angle")
        elif light.type == "AREA":
            layout.prop(light, "shape")
            layout.prop(light, "size")
            if light.shape in {"RECTANGLE", "ELLIPSE"}:
                layout.prop(light, "size_y")
        else:
            layout.prop(light, "shadow_soft_size", text="Radius")
        if light.type == "SPOT":
            layout.prop(light, "spot_size", text="Angle")
            layout.prop(light, "spot_blend", text="Blend", slider=True)


class GLINT_PT_surface(_Panel, bpy.types.Panel):
    bl_label = "Surface"
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.material is not None and super().poll(context)

    def draw(self, context):
        layout, material = self.layout, context.material
        layout.use_property_split = True
        layout.prop(material, "use_nodes", icon="NODETREE")
        if material.use_nodes:
            output = material.node_tree.get_output_node("ALL")
            if output is not None:
                layout.template_node_view(material.node_tree, output, output.inputs["Surface"])
            return
        for name in ("diffuse_color", "metallic", "roughness"):
            layout.prop(material, name)


class GLINT_PT_world(_Panel, bpy.types.Panel):
    bl_label = "Surface"
    bl_context = "world"

    @classmethod
    def poll(cls, context):
        return context.world is not None and super().poll(context)

    def draw(self, context):
        layout, world = self.layout, context.world
        layout.use_property_split = True
        layout.prop(world, "use_nodes", icon="NODETREE")
        output = world.node_tree.get_output_node("ALL") if world.use_nodes else None
        if output is not None:
            layout.template_node_view(world.node_tree, output, output.inputs["Surface"])
        else:
            layout.prop(world, "color")


PROPERTIES = (GlintRenderSettings, GlintLayerSettings)
PANELS = (GLINT_PT_sampling, GLINT_PT_film, GLINT_PT_passes, GLINT_PT_light, GLINT_PT_surface, GLINT_PT_world)

# Blender's own panels that mean nothing here although they are marked for the simplest engine.
NOT_OURS = {"DATA_PT_light", "DATA_PT_area", "DATA_PT_falloff_curve", "VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes"}


def shared_panels():
    """Panels of Blender's that make sense for any engine: those of its simplest, and the preview spheres."""
    for cls in bpy.types.Panel.__subclasses__():
        engines = getattr(cls, "COMPAT_ENGINES", None)
        if engines and "BLENDER_RENDER" in engines and cls.__name__ not in NOT_OURS:
            yield cls


def register():
    for cls in PROPERTIES + PANELS:
        bpy.utils.register_class(cls)
    bpy.types.Scene.glint = PointerProperty(type=GlintRenderSettings)
    bpy.types.ViewLayer.glint = PointerProperty(type=GlintLayerSettings)
    for cls in shared_panels():
        cls.COMPAT_ENGINES.add(ENGINE)


def unregister():
    for cls in shared_panels():
        cls.COMPAT_ENGINES.discard(ENGINE)
    del bpy.types.ViewLayer.glint, bpy.types.Scene.glint
    for cls in reversed(PROPERTIES + PANELS):
        bpy.utils.unregister_class(cls)
