# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel under Properties > Material, and its operators."""

import bpy

from . import gltf, nodes, presets, principled, readout


class GLINT_OT_build_nodes(bpy.types.Operator):
    bl_idname = "glint.build_nodes"
    bl_label = "Build Cycles/EEVEE Nodes"
    bl_description = "Show every flake in Cycles and EEVEE, by a node group that is made from these properties"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return getattr(context, "material", None) is not None

    def execute(self, context):
        material = context.material
        left_out = principled.textured_inputs(material)
        nodes.build(material)
        if left_out:
            self.report({"WARNING"}, f"The flakes take these as constants: {', '.join(left_out)}")
        return {"FINISHED"}


class GLINT_OT_remove_nodes(bpy.types.Operator):
    bl_idname = "glint.remove_nodes"
    bl_label = "Remove Nodes"
    bl_description = "Show the Principled BSDF again"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return getattr(context, "material", None) is not None

    def execute(self, context):
        nodes.remove(context.material)
        return {"FINISHED"}


class GLINT_PT_material(bpy.types.Panel):
    bl_idname = "GLINT_PT_material"
    bl_label = "Glints"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.material is not None

    def draw_header(self, context):
        self.layout.prop(context.material.glint, "enabled", text="")

    def draw(self, context):
        layout, group = self.layout, context.material.glint
        layout.use_property_split = True
        layout.active = group.enabled
        layout.menu(presets.GLINT_MT_presets.bl_idname)

        column = layout.column(align=True)
        column.prop(group, "density_exponent", text="Density, 10^x per cm²", slider=True)
        column.prop(group, "density_per_cm2", text="Per cm²")
        column.prop(group, "facet_size_um", text="Flake size, µm")
        for line in readout.lines(context):
            row = layout.row()
            row.alignment = "RIGHT"
            row.label(text=line)

        layout.prop(group, "factor")
        layout.prop(group, "distribution")
        layout.prop(group, "facet_roughness")
        layout.prop(group, "color")
        layout.prop(group, "color_variation")
        layout.prop(group, "coverage")
        layout.prop(group, "elongation")
        layout.prop(group, "density_variation")

        column = layout.column(align=True)
        column.prop(group, "space")
        row = column.row()
        row.active = group.space == "UV"
        row.prop(group, "uv_scale")
        layout.prop(group, "layer")
        layout.prop(group, "seed")

        row = layout.row(align=True)
        row.operator("glint.build_nodes")
        row.operator("glint.remove_nodes", text="", icon="X")
        for problem in gltf.problems[-2:]:
            layout.label(text=problem, icon="ERROR")


CLASSES = (GLINT_OT_build_nodes, GLINT_OT_remove_nodes, GLINT_PT_material)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
