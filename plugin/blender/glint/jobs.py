# SPDX-License-Identifier: GPL-3.0-or-later
"""Reference and comparison from within Blender: other programs work on a copy of the scene, and Blender stays usable.

Escape stops a job. Under `blender -b` the operators wait for the end.
"""

import json
import os
import subprocess
import tempfile

import bpy

from . import compat, preferences

REFERENCE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "reference_command.py")


class GlintReferenceProperties(bpy.types.PropertyGroup):
    """How the reference of a scene is rendered and what it is held against."""

    path: bpy.props.StringProperty(
        name="Reference", description="The picture to write, and its record beside it", subtype="FILE_PATH",
        default="//reference.exr",
    )
    samples: bpy.props.IntProperty(
        name="Samples", description="Per pixel. 0: 16 for each flake in a pixel", min=0, max=65536, default=0
    )
    bounces: bpy.props.IntProperty(name="Bounces", description="Of indirect light", min=0, max=32, default=0)
    model: bpy.props.EnumProperty(
        name="Compare with",
        items=(
            ("explicit", "The same flakes", "libglint's explicit model: pixel by pixel"),
            ("counting", "Counted flakes", "libglint's fast model: others of the same statistics"),
        ),
        default="explicit",
    )


def _size(scene):
    render = scene.render
    return f"{render.resolution_x * render.resolution_percentage // 100}x" \
           f"{render.resolution_y * render.resolution_percentage // 100}"


def _reference_path(scene):
    """Absolute, or None with the reason."""
    path = bpy.path.abspath(scene.glint_reference.path)
    if scene.glint_reference.path.startswith("//") and not bpy.data.filepath:
        return None, "Save the file first, or give the reference a whole path: '//' is the folder of the file"
    if not path.lower().endswith(".exr"):
        return None, f"'{scene.glint_reference.path}': expected a name that ends in .exr"
    if scene.camera is None:
        return None, "The scene has no camera"
    return path, ""


class Job:
    """Runs steps one after another: functions that return a command line, or None."""

    def steps(self, context):
        """A list, or None after a report."""
        raise NotImplementedError

    def finish(self, context):
        raise NotImplementedError

    def accepts(self, code):
        return code == 0

    def _begin(self, context):
        self.folder = tempfile.TemporaryDirectory(prefix="glint")
        self.waiting = self.steps(context)
        return self.waiting is not None

    def _start_next(self):
        """The next command's process, or None when all are done."""
        while self.waiting:
            command = self.waiting.pop(0)()
            if command is not None:
                self.said = open(os.path.join(self.folder.name, "said"), "w+", encoding="utf-8", errors="replace")
                return subprocess.Popen(command, stdout=self.said, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        return None

    def _succeeded(self, code):
        self.said.seek(0)
        self.output = self.said.read()
        self.said.close()
        if self.accepts(code):
            return True
        lines = [line for line in self.output.splitlines() if line.strip()]
        self.report({"ERROR"}, f"Exit code {code}: {' / '.join(lines[-3:])}")
        return False

    def execute(self, context):
        if not self._begin(context):
            return {"CANCELLED"}
        try:
            process = self._start_next()
            while process is not None:
                if not self._succeeded(process.wait()):
                    return {"CANCELLED"}
                process = self._start_next()
        except OSError as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        return self.finish(context)

    def invoke(self, context, event):
        if not self._begin(context):
            return {"CANCELLED"}
        try:
            self.process = self._start_next()
        except OSError as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        self.timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.modal_handler_add(self)
        context.workspace.status_text_set(f"{self.bl_label}: at work; Esc stops it")
        return {"RUNNING_MODAL"}

    def _end(self, context):
        context.window_manager.event_timer_remove(self.timer)
        context.workspace.status_text_set(None)

    def modal(self, context, event):
        if event.type == "ESC":
            self.process.kill()
            self.process.wait()
            self._end(context)
            self.report({"INFO"}, f"{self.bl_label}: stopped")
            return {"CANCELLED"}
        if event.type != "TIMER" or self.process.poll() is None:
            return {"PASS_THROUGH"}
        if not self._succeeded(self.process.returncode):
            self._end(context)
            return {"CANCELLED"}
        try:
            self.process = self._start_next()
        except OSError as problem:
            self._end(context)
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        if self.process is not None:
            return {"PASS_THROUGH"}
        self._end(context)
        return self.finish(context)


class GLINT_OT_render_reference(Job, bpy.types.Operator):
    bl_idname = "glint.render_reference"
    bl_label = "Render Reference"
    bl_description = (
        "Render this scene in Cycles with every flake and the settings without which it is no truth, in another Blender. "
        "The world's light is left out"
    )

    def steps(self, context):
        scene = context.scene
        path, problem = _reference_path(scene)
        if path is None:
            self.report({"ERROR"}, problem)
            return None
        copy = os.path.join(self.folder.name, "scene.blend")
        bpy.ops.wm.save_as_mainfile(filepath=copy, copy=True)
        self.path = path
        return [lambda: [
            bpy.app.binary_path, "-b", "--factory-startup", "--python-exit-code", "3", "-P", REFERENCE, "--", copy, "-o", path,
            "--size", _size(scene), "--spp", str(scene.glint_reference.samples), "--bounces", str(scene.glint_reference.bounces),
        ]]

    def finish(self, context):
        self.report({"INFO"}, f"Rendered {self.path}")
        return {"FINISHED"}


class GLINT_OT_compare(Job, bpy.types.Operator):
    bl_idname = "glint.compare"
    bl_label = "Compare with libglint"
    bl_description = "Render the scene with libglint and hold it against the reference; the report opens in the browser"

    show: bpy.props.BoolProperty(name="Open the report", default=True)

    def steps(self, context):
        scene = context.scene
        path, problem = _reference_path(scene)
        if path is not None and not os.path.isfile(path):
            problem = f"There is no {path}: render the reference first"
        command = preferences.find_command(context)
        if command is None:
            problem = "The glint command is neither in the add-on nor on the path: the add-on's preferences may name it"
        if problem:
            self.report({"ERROR"}, problem)
            return None
        return self._steps(scene, path, command)

    def _steps(self, scene, path, command):
        exported = os.path.join(self.folder.name, "scene.glb")
        start = os.path.splitext(path)[0]
        ours, self.page = start + "_libglint.exr", start + ".html"

        def export():
            compat.export_gltf(exported, export_format="GLB", export_lights=True, export_cameras=True, export_apply=True)

        return [
            export,
            lambda: [command, "render", exported, "-o", ours, "--size", _size(scene), "--spp", "64", "--model",
                     scene.glint_reference.model, "--facets", "cycles", "--bounces", str(scene.glint_reference.bounces), "--camera",
                     scene.camera.name],
            lambda: [command, "compare", path, ours, "-o", self.page, "--json"],
        ]

    def accepts(self, code):
        # 1: the pictures do not agree, which is an answer.
        return code == 0 or (code == 1 and "{" in self.output)

    def finish(self, context):
        found, _ = json.JSONDecoder().raw_decode(self.output, self.output.index("{"))  # warnings may stand around it
        verdict = {"pass": "agree", "unclear": "may agree", "fail": "do not agree"}[found["verdict"]]
        level = "WARNING" if found["verdict"] == "fail" else "INFO"
        self.report({level}, f"The pictures {verdict}: {self.page}")
        if self.show and not bpy.app.background:
            bpy.ops.wm.url_open(url="file://" + self.page)
        return {"FINISHED"}


class GLINT_PT_reference(bpy.types.Panel):
    bl_idname = "GLINT_PT_reference"
    bl_label = "Glint Reference"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, values = self.layout, context.scene.glint_reference
        layout.use_property_split = True
        layout.prop(values, "path")
        layout.prop(values, "samples")
        layout.prop(values, "bounces")
        layout.operator("glint.render_reference", icon="RENDER_STILL")
        layout.prop(values, "model")
        layout.operator("glint.compare", icon="IMAGE_REFERENCE")


CLASSES = (GlintReferenceProperties, GLINT_OT_render_reference, GLINT_OT_compare, GLINT_PT_reference)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.glint_reference = bpy.props.PointerProperty(type=GlintReferenceProperties)


def unregister():
    del bpy.types.Scene.glint_reference
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
