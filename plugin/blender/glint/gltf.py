# SPDX-License-Identifier: GPL-3.0-or-later
"""Hooks of io_scene_gltf2: what its own importer and exporter leave out about glints and the sizes of lights.

An exception in a hook would be printed where no artist looks, so what goes wrong is collected and shown (`problems`).
"""

import traceback

import bpy

from . import extension

# What a hook could not do, newest last; the panel shows it.
problems = []


def _guarded(hook):
    def call(self, *arguments):
        try:
            return hook(self, *arguments)
        except Exception as problem:  # a file that we cannot read shall still open
            problems.append(f"{hook.__name__}: {problem}")
            traceback.print_exc()
            return None

    return call


def _made_extension(name, content):
    from io_scene_gltf2.io.com.gltf2_io_extensions import Extension

    return Extension(name=name, extension=content, required=False)


def light_size(light):
    """The extras that say how large a light is; libglint reads them."""
    if light.type == "SUN":
        return {"angularDiameter": light.angle}
    return {"radius": light.shadow_soft_size}


def apply_light_size(light, extras):
    if light.type == "SUN" and "angularDiameter" in extras:
        light.angle = extras["angularDiameter"]
    elif light.type in {"POINT", "SPOT"}:
        # Without a size libglint takes a centimetre.
        light.shadow_soft_size = extras.get("radius", 0.01)


class glTF2ExportUserExtension:
    @_guarded
    def gather_material_hook(self, gltf2_material, blender_material, export_settings):
        group = blender_material.glint
        if not group.enabled:
            return
        content = extension.from_values(group)
        if gltf2_material.extensions is None:
            gltf2_material.extensions = {}
        gltf2_material.extensions[extension.NAME] = _made_extension(extension.NAME, content)

    @_guarded
    def gather_node_hook(self, gltf2_node, blender_object, export_settings):
        if getattr(blender_object, "type", None) != "LIGHT" or not gltf2_node.extensions:
            return
        punctual = gltf2_node.extensions.get("KHR_lights_punctual")
        if punctual is None:
            return
        light = punctual.extension["light"].extension
        light["extras"] = {**(light.get("extras") or {}), **light_size(blender_object.data)}


class glTF2ImportUserExtension:
    def __init__(self):
        self.extensions = [_made_extension(extension.NAME, {})]

    @_guarded
    def gather_import_material_after_hook(self, gltf_material, vertex_color, blender_mat, gltf):
        content = (gltf_material.extensions or {}).get(extension.NAME)
        if content is not None:
            extension.apply(content, blender_mat.glint)

    @_guarded
    def gather_import_node_after_hook(self, vnode, gltf_node, blender_object, gltf):
        punctual = (gltf_node.extensions or {}).get("KHR_lights_punctual")
        if punctual is None:
            return
        light = gltf.data.extensions["KHR_lights_punctual"]["lights"][punctual["light"]]
        for candidate in (blender_object, *blender_object.children):
            if candidate.type == "LIGHT":
                apply_light_size(candidate.data, light.get("extras") or {})
