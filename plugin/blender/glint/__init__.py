# SPDX-License-Identifier: GPL-3.0-or-later
"""Glints for Blender: metallic paint, craft glitter, snow and sand whose flakes sparkle one by one.

One property group on the material says what the flakes are; the node graph for Cycles and EEVEE, the reference renders and
glTF files are made from it.
"""

bl_info = {
    "name": "Glint",
    "description": "Materials made of discrete microfacets: glitter, metallic paint, snow, sand",
    "author": "The libglint authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Material > Glints",
    "category": "Material",
}

from . import engine, jobs, nodes, panel, plan_report, preferences, presets, properties, render_panels, render_settings
from .gltf import glTF2ExportUserExtension, glTF2ImportUserExtension  # io_scene_gltf2 looks for them here

MODULES = (preferences, properties, nodes, presets, jobs, panel, render_settings, render_panels, plan_report, engine)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
