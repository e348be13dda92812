# SPDX-License-Identifier: GPL-3.0-or-later
"""The render engine's panels in Blender's properties, and those of Blender's own that serve it as well."""

import bpy

from .render_settings import ENGINE, OWN_PASSES


class Panel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES


class GLINT_PT_sampling(Panel, bpy.types.Panel):
    bl_label = "Sampling"
    bl_context = "render"

    def draw(self, context):
        layout, settings = self.layout, context.scene.glint
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(align=True)
        column.prop(settings, "samples", text="Render")
        column.prop(settings, "preview_samples", text="Viewport")
        column = layout.column(align=True)
        column.prop(settings, "accuracy")
        column.prop(settings, "preview_accuracy", text="Viewport")
        layout.prop(settings, "bounces")
        layout.prop(settings, "model")
        row = layout.row(align=True)
        row.prop(settings, "seed")
        row.prop(settings, "animate_seed", text="", icon="TIME")


class GLINT_PT_performance(Panel, bpy.types.Panel):
    bl_label = "Performance"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, render = self.layout, context.scene.render
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(render, "threads_mode", text="Threads")
        column = layout.column()
        column.enabled = render.threads_mode == "FIXED"
        column.prop(render, "threads", text="Number")


class GLINT_PT_film(Panel, bpy.types.Panel):
    bl_label = "Film"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.prop(context.scene.render, "film_transparent", text="Transparent")


class GLINT_PT_passes(Panel, bpy.types.Panel):
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


class GLINT_PT_light(Panel, bpy.types.Panel):
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


def draw_surface(layout, owner, plain):
    """Nodes of a material or world; its plain values where nothing is linked."""
    layout.use_property_split = True
    layout.prop(owner, "use_nodes", icon="NODETREE")
    output = owner.node_tree.get_output_node("ALL") if owner.use_nodes else None
    if output is not None:
        layout.template_node_view(owner.node_tree, output, output.inputs["Surface"])
        return
    for name in plain:
        layout.prop(owner, name)


class GLINT_PT_surface(Panel, bpy.types.Panel):
    bl_label = "Surface"
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.material is not None and super().poll(context)

    def draw(self, context):
        draw_surface(self.layout, context.material, ("diffuse_color", "metallic", "roughness"))


class GLINT_PT_world(Panel, bpy.types.Panel):
    bl_label = "Surface"
    bl_context = "world"

    @classmethod
    def poll(cls, context):
        return context.world is not None and super().poll(context)

    def draw(self, context):
        draw_surface(self.layout, context.world, ("color",))


PANELS = (GLINT_PT_sampling, GLINT_PT_performance, GLINT_PT_film, GLINT_PT_passes, GLINT_PT_light, GLINT_PT_surface, GLINT_PT_world)

# Blender's own panels that mean nothing here although they are marked for the simplest engine.
NOT_OURS = {"DATA_PT_light", "DATA_PT_area", "DATA_PT_falloff_curve", "VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes"}
# Those that serve us although they are marked for EEVEE only: an object's material slots, and the spheres that show a material.
OURS_TOO = {"EEVEE_MATERIAL_PT_context_material", "MATERIAL_PT_preview"}


def shared_panels():
    """Panels of Blender's that make sense for any engine: those of its simplest, and a few."""
    for cls in bpy.types.Panel.__subclasses__():
        engines = getattr(cls, "COMPAT_ENGINES", None)
        is_for_all = engines and "BLENDER_RENDER" in engines and cls.__name__ not in NOT_OURS
        if is_for_all or cls.__name__ in OURS_TOO:
            yield cls


def register():
    for cls in PANELS:
        bpy.utils.register_class(cls)
    for cls in shared_panels():
        cls.COMPAT_ENGINES.add(ENGINE)


def unregister():
    for cls in shared_panels():
        cls.COMPAT_ENGINES.discard(ENGINE)
    for cls in reversed(PANELS):
        bpy.utils.unregister_class(cls)
