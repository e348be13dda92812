# SPDX-License-Identifier: GPL-3.0-or-later
"""Hooks of io_scene_gltf2: what its own importer and exporter leave out about glints and the sizes of lights.

What goes wrong is collected and shown (`problems`).
"""

import traceback

import bpy

from . import area_lights, compat, extension, principled, textures

# What a hook could not do, newest last; the panel shows it until the next file.
problems = []


def _show(problem):
    """Says it where an artist looks: a message window, once Blender has time for one; the panel keeps it."""
    if problem in problems:  # an exporter asks for a material more than once
        return
    problems.append(problem)
    if bpy.app.background:
        return

    def popup():
        def draw(menu, context):
            menu.layout.label(text=problem)

        bpy.context.window_manager.popup_menu(draw, title="Glint", icon="ERROR")

    # An importer's hook has no window to draw in; a timer's function has.
    bpy.app.timers.register(popup, first_interval=0.1)


def _guarded(hook):
    """An exception in a hook would be printed where no artist looks, and a file that we cannot read shall still open."""

    def call(self, *arguments):
        try:
            return hook(self, *arguments)
        except Exception as problem:
            named = next((a for a in arguments if getattr(a, "name", None)), None)
            what = f"'{named.name}': " if named is not None else ""
            kind = "" if isinstance(problem, ValueError) else f"{type(problem).__name__}: "
            _show(f"glTF, {what}glints or lights are left out: {kind}{problem}")
            traceback.print_exc()
            return None

    return call


def _made_extension(name, content):
    from io_scene_gltf2.io.com.gltf2_io_extensions import Extension

    return Extension(name=name, extension=content, required=False)


class _Textures:
    """Textures of one export: a picture goes into the file once."""

    def __init__(self):
        self.images, self.made = {}, {}

    def _image(self, image):
        from io_scene_gltf2.io.com import gltf2_io

        if image.name not in self.images:
            data = textures.bytes_of(image)
            self.images[image.name] = gltf2_io.Image(
                buffer_view=compat.binary_data(data), extensions=None, extras=None,
                mime_type=textures.mime_type_of(data), name=image.name, uri=None,
            )
        return self.images[image.name]

    def info(self, texture):
        """Its textureInfo, or None."""
        if texture is None or texture.image is None:
            return None
        try:
            return textures.info_of(texture, self._texture(texture))
        except (ValueError, OSError, RuntimeError) as problem:
            _show(f"glTF: a texture of the glints is left out: {problem}")
            return None

    def _texture(self, texture):
        from io_scene_gltf2.io.com import gltf2_io

        key = texture.image.name, texture.closest
        if key not in self.made:
            sampler = None
            if texture.closest:
                sampler = gltf2_io.Sampler(
                    extensions=None, extras=None, mag_filter=textures.NEAREST, min_filter=textures.NEAREST, name=None,
                    wrap_s=None, wrap_t=None,
                )
            self.made[key] = gltf2_io.Texture(
                extensions=None, extras=None, name=None, sampler=sampler, source=self._image(texture.image)
            )
        return self.made[key]


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
    def __init__(self):
        problems.clear()
        self._textures = _Textures()

    @_guarded
    def gather_material_hook(self, gltf2_material, blender_material, export_settings):
        group, node = blender_material.glint, principled.find(blender_material)
        own, coat = extension.of_material(group, self._textures.info)
        if own is None and coat is None:
            return
        extensions = gltf2_material.extensions = dict(gltf2_material.extensions or {})
        if node is not None:
            for name in (principled.IOR, principled.SPECULAR):
                if name in extensions and not principled.is_textured(node):
                    del extensions[name]
            for name, content in principled.extensions_of(node, group).items():
                extensions.setdefault(name, _made_extension(name, content))
        if own is not None:
            extensions[extension.NAME] = _made_extension(extension.NAME, own)
        if coat is not None:
            held = extensions.setdefault(extension.COAT, _made_extension(extension.COAT, {"clearcoatFactor": 0.0}))
            held.extension["extensions"] = {extension.NAME: _made_extension(extension.NAME, coat)}

    @_guarded
    def gather_node_hook(self, gltf2_node, blender_object, export_settings):
        if getattr(blender_object, "type", None) != "LIGHT":
            return
        if gltf2_node.extensions is None:
            gltf2_node.extensions = {}
        if blender_object.data.type == "AREA":
            gltf2_node.extensions[area_lights.NAME] = area_lights.of_light(blender_object.data)
            return
        punctual = gltf2_node.extensions.get("KHR_lights_punctual")
        if punctual is None:
            return
        light = punctual.extension["light"].extension
        light["extras"] = {**(light.get("extras") or {}), **light_size(blender_object.data)}


def _texture_reader(gltf):
    """Sets a texture from a textureInfo of the file."""

    def set_texture(texture, info):
        if info is None:
            textures.set_from(texture, None, None)
            return
        entry = gltf.data.textures[info["index"]]
        sampler = gltf.data.samplers[entry.sampler] if entry.sampler is not None else None
        closest = sampler is not None and sampler.mag_filter == textures.NEAREST
        textures.set_from(texture, info, compat.imported_image(gltf, entry.source), closest)

    return set_texture


class glTF2ImportUserExtension:
    def __init__(self):
        problems.clear()
        known = (extension.NAME, area_lights.NAME, principled.ANISOTROPY)
        self.extensions = [_made_extension(name, {}) for name in known]

    @_guarded
    def gather_import_material_after_hook(self, gltf_material, vertex_color, blender_mat, gltf):
        extensions = gltf_material.extensions or {}
        in_coat = extensions.get(extension.COAT, {}).get("extensions", {})
        if extension.NAME not in extensions and extension.NAME not in in_coat:
            return
        node = principled.find(blender_mat)
        if node is not None:
            principled.apply_extensions(node, blender_mat.glint, extensions)
        extension.apply_material(extensions, blender_mat.glint, _texture_reader(gltf))

    @_guarded
    def gather_import_node_after_hook(self, vnode, gltf_node, blender_object, gltf):
        extensions = gltf_node.extensions or {}
        area = extensions.get(area_lights.NAME)
        if area is not None:
            lights = gltf.data.extensions[area_lights.NAME]["lights"]
            area_lights.add(lights[area["light"]], blender_object, gltf)
        punctual = extensions.get("KHR_lights_punctual")
        if punctual is None:
            return
        light = gltf.data.extensions["KHR_lights_punctual"]["lights"][punctual["light"]]
        for candidate in (blender_object, *blender_object.children):
            if candidate.type == "LIGHT":
                apply_light_size(candidate.data, light.get("extras") or {})
