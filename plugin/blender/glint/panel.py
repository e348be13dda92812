# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels under Properties > Material, and the operators that they need."""

import bpy

from . import gltf, nodes, presets, principled, readout, stretch
from .extension import MOST_COLORS


class OfMaterial:
    """An operator on the material of the panel."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return getattr(context, "material", None) is not None


class GLINT_OT_build_nodes(OfMaterial, bpy.types.Operator):
    bl_idname = "glint.build_nodes"
    bl_label = "Build Cycles/EEVEE Nodes"
    bl_description = "Show every flake in Cycles and EEVEE, by a node group that follows these properties"

    def execute(self, context):
        nodes.build(context.material)
        left_out = nodes.notes(context.material)
        if left_out:
            self.report({"WARNING"}, "Nodes cannot show: " + "; ".join(left_out))
        return {"FINISHED"}


class GLINT_OT_remove_nodes(OfMaterial, bpy.types.Operator):
    bl_idname = "glint.remove_nodes"
    bl_label = "Remove Nodes"
    bl_description = "Show the Principled BSDF again"

    def execute(self, context):
        nodes.remove(context.material)
        return {"FINISHED"}


class OfPalette(OfMaterial):
    coat: bpy.props.BoolProperty(options={"HIDDEN"})

    def colors(self, context):
        group = context.material.glint
        return (group.coat if self.coat else group).colors


class GLINT_OT_add_color(OfPalette, bpy.types.Operator):
    bl_idname = "glint.add_color"
    bl_label = "Add Colour"
    bl_description = f"Each flake has one of these colours, at most {MOST_COLORS}; the surface keeps its base colour"

    def execute(self, context):
        colors = self.colors(context)
        if len(colors) >= MOST_COLORS:
            self.report({"ERROR"}, f"A palette has at most {MOST_COLORS} colours")
            return {"CANCELLED"}
        colors.add()
        nodes.refresh(context.material)
        return {"FINISHED"}


class GLINT_OT_remove_color(OfPalette, bpy.types.Operator):
    bl_idname = "glint.remove_color"
    bl_label = "Remove Colour"
    bl_description = "Take this colour out of the palette"

    index: bpy.props.IntProperty(options={"HIDDEN"})

    def execute(self, context):
        self.colors(context).remove(self.index)
        nodes.refresh(context.material)
        return {"FINISHED"}


class GLINT_OT_take_uv_scale(OfMaterial, bpy.types.Operator):
    bl_idname = "glint.take_uv_scale"
    bl_label = "Measure"
    bl_description = "Set the metres per UV unit to what half of the active mesh has less of"

    coat: bpy.props.BoolProperty(options={"HIDDEN"})

    def execute(self, context):
        group = context.material.glint
        values = group.coat if self.coat else group
        found = stretch.of_object(context.object, values.texcoord) if context.object else None
        if found is None:
            self.report({"ERROR"}, f"The active object has no UV map {values.texcoord} with an area")
            return {"CANCELLED"}
        values.uv_scale = found.middle
        return {"FINISHED"}


# ---- drawing ----


def _draw_texture(layout, texture, text):
    column = layout.column(align=True)
    row = column.row(align=True)
    row.prop(texture, "image", text=text)
    row.operator("image.open", text="", icon="FILEBROWSER")
    if texture.image is not None:
        column.prop(texture, "texcoord")
        column.prop(texture, "offset")
        column.prop(texture, "rotation")
        column.prop(texture, "scale")
        column.prop(texture, "closest")


def _draw_density(layout, context, values, found):
    column = layout.column(align=True)
    column.prop(values, "density_exponent", text="Density, 10^x per cm²", slider=True)
    column.prop(values, "density_per_cm2", text="Per cm²")
    column.prop(values, "facet_size_um", text="Flake size, µm")
    alpha = principled.alpha_of(context.material)
    for line in readout.lines(context.scene, context.object, values, alpha, found):
        row = layout.row()
        row.alignment = "RIGHT"
        row.label(text=line)


def _draw_example(layout, values):
    _draw_texture(layout, values.example_texture, "Normal map")
    if values.example_texture.image is None:
        layout.label(text="An example needs a normal map of 8 to 256 texels", icon="ERROR")
    column = layout.column(align=True)
    column.prop(values, "example_placement")
    column.prop(values, "example_size")
    if values.example_placement == "SCATTERED":
        column.prop(values, "example_rotation_variation")
        column.prop(values, "example_scale_variation")


def _draw_facets(layout, context, values, found):
    layout.prop(values, "structure")
    if values.structure == "EXAMPLE":
        _draw_example(layout, values)
    else:
        _draw_density(layout, context, values, found)
        layout.prop(values, "distribution")
    layout.prop(values, "factor")
    layout.prop(values, "facet_roughness")
    layout.prop(values, "coverage")
    if values.structure == "FLAKES":
        layout.prop(values, "elongation")
        layout.prop(values, "density_variation")
    layout.prop(values, "seed")


def _draw_colors(layout, values, coat):
    layout.prop(values, "color")
    layout.prop(values, "color_variation")
    for i, entry in enumerate(values.colors):
        row = layout.row(align=True)
        row.prop(entry, "color", text=f"Palette {i + 1}")
        remove = row.operator("glint.remove_color", text="", icon="X")
        remove.index, remove.coat = i, coat
    if len(values.colors) < MOST_COLORS:
        layout.operator("glint.add_color", icon="ADD").coat = coat


def _draw_mapping(layout, values, coat, found):
    layout.prop(values, "space")
    if values.space == "OBJECT":
        return
    layout.prop(values, "texcoord")
    row = layout.row(align=True)
    row.prop(values, "uv_scale")
    row.operator("glint.take_uv_scale", text="", icon="DRIVER_DISTANCE").coat = coat
    if found is None:
        layout.label(text="The object has no such UV map", icon="ERROR")
        return
    layout.label(text=f"A UV unit measures {found.middle:.3g} m")
    for line in stretch.warnings(found, values.uv_scale):
        layout.label(text=line, icon="ERROR")


def _stretch_of(context, values):
    """Of the active mesh, where flakes lie in UVs."""
    if values.space != "UV" or context.object is None:
        return None
    return stretch.of_object(context.object, values.texcoord)


def _draw_layer(layout, context, values, coat):
    found = _stretch_of(context, values)
    _draw_facets(layout, context, values, found)
    _draw_colors(layout.column(), values, coat)
    _draw_mapping(layout.column(), values, coat, found)


# ---- panels ----


class MaterialPanel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.material is not None

    @property
    def split(self):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = True
        return self.layout


class SubPanel(MaterialPanel):
    bl_parent_id = "GLINT_PT_material"
    bl_options = {"DEFAULT_CLOSED"}


class GLINT_PT_material(MaterialPanel, bpy.types.Panel):
    bl_idname = "GLINT_PT_material"
    bl_label = "Glints"

    def draw_header(self, context):
        self.layout.prop(context.material.glint, "enabled", text="")

    def draw(self, context):
        layout, group = self.split, context.material.glint
        layout.menu(presets.GLINT_MT_presets.bl_idname)
        row = layout.row(align=True)
        row.operator("glint.build_nodes", icon="NODETREE")
        row.operator("glint.remove_nodes", text="", icon="X")
        for problem in gltf.problems[-2:]:
            layout.label(text=problem, icon="ERROR")
        if nodes.find(context.material) is not None:
            for note in nodes.notes(context.material):
                layout.label(text="Nodes cannot show " + note, icon="INFO")
        column = layout.column()
        column.active = group.enabled
        column.prop(group, "layer")
        _draw_layer(column, context, group, coat=False)


class GLINT_PT_textures(SubPanel, bpy.types.Panel):
    bl_idname = "GLINT_PT_textures"
    bl_label = "Textures"

    def draw(self, context):
        layout, group = self.split, context.material.glint
        layout.active = group.enabled
        _draw_texture(layout, group.density_texture, "Density (green)")
        _draw_texture(layout, group.factor_texture, "Strength (red)")
        _draw_texture(layout, group.color_texture, "Tint")
        layout.prop(group, "specular_color")


class GLINT_PT_coat(SubPanel, bpy.types.Panel):
    bl_idname = "GLINT_PT_coat"
    bl_label = "Glints in the Clear Coat"

    def draw_header(self, context):
        self.layout.prop(context.material.glint.coat, "enabled", text="")

    def draw(self, context):
        layout, group = self.split, context.material.glint
        layout.active = group.coat.enabled
        if group.enabled and group.layer == "CLEARCOAT":
            layout.label(text="The flakes above lie in the coat already", icon="INFO")
        node = principled.find(context.material)
        if principled.value_of(node, principled.COAT, 0.0) == 0.0:
            layout.label(text="The Principled BSDF has no clear coat", icon="INFO")
        _draw_layer(layout, context, group.coat, coat=True)
        _draw_texture(layout, group.coat.density_texture, "Density (green)")


CLASSES = (
    GLINT_OT_build_nodes, GLINT_OT_remove_nodes, GLINT_OT_add_color, GLINT_OT_remove_color, GLINT_OT_take_uv_scale,
    GLINT_PT_material, GLINT_PT_textures, GLINT_PT_coat,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
