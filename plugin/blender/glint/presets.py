# SPDX-License-Identifier: GPL-3.0-or-later
"""The presets of libglint: glTF materials that carry the extension, the same files that the glint command reads."""

import json
import os

import bpy

from . import extension, nodes, principled, textures

SUFFIX = ".gltf-material.json"


def folders():
    """Where presets are: the user's own, those in the add-on, and, in a checkout, those of the repository."""
    here = os.path.dirname(os.path.realpath(__file__))
    own = bpy.utils.user_resource("SCRIPTS", path=os.path.join("presets", "glint"))
    return [own, os.path.join(here, "materials"), os.path.join(here, "..", "..", "..", "materials")]


def available():
    """Names of the presets and their files; a user's own comes before one of the same name."""
    found = {}
    for folder in reversed(folders()):
        if os.path.isdir(folder):
            for name in sorted(os.listdir(folder)):
                if name.endswith(SUFFIX):
                    found[name[: -len(SUFFIX)]] = os.path.join(folder, name)
    return dict(sorted(found.items()))


def apply(material, preset, path=""):
    """Sets the Principled BSDF and the property group from a glTF material object, the preset at path."""
    material.use_nodes = True
    with nodes.one_change(material):
        node = principled.find(material)
        if node is not None:
            principled.apply(node, material.glint, preset)
        extension.apply_material(preset.get("extensions", {}), material.glint, textures.preset_reader(preset, path))


def of_material(material):
    """A glTF material object that apply() turns into this material again, pictures inside."""
    node, writer = principled.find(material), textures.PresetWriter()
    preset = {"name": material.name}
    if node is not None:
        preset.update(principled.to_gltf(node, material.glint))
    extensions = preset.setdefault("extensions", {})
    own, coat = extension.of_material(material.glint, writer.info)
    if own is not None:
        extensions[extension.NAME] = own
    if coat is not None:
        extensions.setdefault(extension.COAT, {"clearcoatFactor": 0.0})["extensions"] = {extension.NAME: coat}
    preset["extras"] = {"title": material.name, **writer.extras(), "note": "Saved from Blender."}
    return preset


def textured_inputs(material):
    """Names of inputs of the Principled BSDF that something is linked to: a preset keeps their constants only."""
    node = principled.find(material)
    return [socket.name for socket in node.inputs if socket.is_linked] if node is not None else []


class GLINT_OT_apply_preset(bpy.types.Operator):
    bl_idname = "glint.apply_preset"
    bl_label = "Apply Glint Preset"
    bl_description = "Make this material what the preset says"
    bl_options = {"REGISTER", "UNDO"}

    name: bpy.props.StringProperty()

    @classmethod
    def poll(cls, context):
        return getattr(context, "material", None) is not None

    def execute(self, context):
        path = available().get(self.name)
        if path is None:
            self.report({"ERROR"}, f"There is no preset '{self.name}'; there are: {', '.join(available())}")
            return {"CANCELLED"}
        try:
            with open(path, encoding="utf-8") as file:
                apply(context.material, json.load(file), path)
        except (OSError, ValueError, TypeError, LookupError) as problem:
            self.report({"ERROR"}, f"{path}: {problem}")
            return {"CANCELLED"}
        return {"FINISHED"}


class GLINT_OT_save_preset(bpy.types.Operator):
    bl_idname = "glint.save_preset"
    bl_label = "Save as Glint Preset"
    bl_description = "Keep this material under its name among the presets"

    name: bpy.props.StringProperty(name="Name")

    @classmethod
    def poll(cls, context):
        return getattr(context, "material", None) is not None

    def invoke(self, context, event):
        self.name = context.material.name
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context):
        name = "-".join(self.name.lower().split())
        if not name or any(c in name for c in '/\\:*?"<>|') or name.startswith("."):
            self.report({"ERROR"}, f"'{self.name}' cannot be the name of a file")
            return {"CANCELLED"}
        path = os.path.join(folders()[0], name + SUFFIX)
        left_out = textured_inputs(context.material)
        try:
            os.makedirs(folders()[0], exist_ok=True)
            with open(path + ".part", "w", encoding="utf-8") as file:
                json.dump(of_material(context.material), file, indent=2)
            os.replace(path + ".part", path)
        except (OSError, ValueError) as problem:
            self.report({"ERROR"}, f"{path}: {problem}")
            return {"CANCELLED"}
        if left_out:
            self.report({"WARNING"}, f"A preset has constants: the textures of {', '.join(left_out)} are not in it")
        else:
            self.report({"INFO"}, f"Saved {path}")
        return {"FINISHED"}


class GLINT_MT_presets(bpy.types.Menu):
    bl_idname = "GLINT_MT_presets"
    bl_label = "Presets"

    def draw(self, context):
        for name in available():
            self.layout.operator("glint.apply_preset", text=name.replace("-", " ").capitalize()).name = name
        self.layout.separator()
        self.layout.operator("glint.save_preset")


CLASSES = (GLINT_OT_apply_preset, GLINT_OT_save_preset, GLINT_MT_presets)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
