# SPDX-License-Identifier: GPL-3.0-or-later
"""What a final render will do, what it will leave out, and what each costs: `glint plan` of the scene at hand, in a panel."""

import dataclasses

import bpy
from bpy.props import BoolProperty, CollectionProperty, FloatProperty, PointerProperty, StringProperty

from . import library, scene_camera
from .library import GlintError, Scene
from .render_panels import Panel
from .render_settings import ENGINE, shading_of, threads_of
from .scene_data import describe


@dataclasses.dataclass
class Outcome:
    """The first line of a plan."""

    ns_per_sample: float
    error: float
    noise: float
    is_met: bool
    enough_samples: int
    samples: int


def outcome_of(fields):
    ns, error, noise, met, enough, samples = fields
    return Outcome(float(ns), float(error), float(noise), met == "met", int(enough), int(samples))


def percent(share):
    """A share as somebody reads it."""
    if not share > 0.0:
        return ""
    if share < 0.0005:
        return "<.1 %"
    return f"{100.0 * share:.1f} %" if share < 0.0995 else f"{100.0 * share:.0f} %"


def conclusion(outcome, accuracy, pixels):
    """What the whole comes to, as lines of text."""
    seconds = 1e-9 * outcome.ns_per_sample * outcome.samples * pixels
    lines = [f"{outcome.samples} samples, about {seconds:.2g} s of one core; left out {outcome.error:.2g}, noise {outcome.noise:.2g}"]
    if not accuracy > 0.0:
        lines.append("Nothing is left out")
    elif outcome.is_met:
        lines.append(f"The accuracy of {accuracy:.3g} is met")
    elif outcome.enough_samples:
        lines.append(f"The accuracy of {accuracy:.3g} takes {outcome.enough_samples} samples")
    else:
        lines.append(f"The accuracy of {accuracy:.3g} cannot be met")
    return lines


class GlintPlanLine(bpy.types.PropertyGroup):
    """A decision."""

    material: StringProperty()
    effect: StringProperty()
    is_on: BoolProperty()
    choice: StringProperty()
    time_share: FloatProperty()
    error: FloatProperty()
    reason: StringProperty()


class GlintPlan(bpy.types.PropertyGroup):
    """The last plan that somebody asked for. It is no part of the file."""

    lines: CollectionProperty(type=GlintPlanLine)
    conclusion: StringProperty()  # lines


def plan_of(depsgraph):
    """Lines of fields for the picture that F12 would make."""
    source = depsgraph.scene
    settings = source.glint
    camera = scene_camera.of_render(depsgraph, lambda text: None)
    if camera is None:
        raise GlintError("The scene has no camera")
    scene = Scene(describe(depsgraph, **shading_of(source, settings.accuracy)))
    try:
        width, height = scene_camera.resolution(source)
        return library.plan(scene, camera, width, height, samples=settings.samples, bounces=settings.bounces,
                            seed=settings.seed, accuracy=settings.accuracy, threads=threads_of(source))
    finally:
        scene.close()


def keep(plan, rows, scene):
    """Puts a plan into the properties that the panel shows: what is on first, the dearest first."""
    plan.lines.clear()
    for fields in sorted(rows[1:], key=lambda row: (row[2] != "on", -float(row[4]))):
        line = plan.lines.add()
        line.material, line.effect, on, line.choice = fields[:4]
        line.is_on = on == "on"
        line.time_share, line.error, line.reason = float(fields[4]), float(fields[5]), fields[6]
    width, height = scene_camera.resolution(scene)
    plan.conclusion = "\n".join(conclusion(outcome_of(rows[0]), scene.glint.accuracy, width * height))


def redraw_panels(manager):
    """Blender itself draws only the region of a button that was pressed: not for a script, a shortcut or the search menu."""
    for window in manager.windows:
        for area in window.screen.areas:
            if area.type == "PROPERTIES":
                area.tag_redraw()


class GLINT_OT_plan(bpy.types.Operator):
    """Look at a few hundred pixels and say what the render will do, what it will leave out, and what each costs"""

    bl_idname = "glint.plan"
    bl_label = "Plan This Render"

    @classmethod
    def poll(cls, context):
        return context.engine == ENGINE

    def execute(self, context):
        try:
            rows = plan_of(context.evaluated_depsgraph_get())
        except GlintError as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        keep(context.window_manager.glint_plan, rows, context.scene)
        redraw_panels(context.window_manager)
        return {"FINISHED"}


class GLINT_PT_plan(Panel, bpy.types.Panel):
    bl_label = "Plan"
    bl_context = "render"

    def draw(self, context):
        layout, plan = self.layout, context.window_manager.glint_plan
        layout.operator("glint.plan", icon="VIEWZOOM")
        if not plan.conclusion:
            return
        for text in plan.conclusion.split("\n"):
            layout.label(text=text)
        box = layout.column(align=True)
        for line in plan.lines:
            self.draw_line(box.box().column(align=True), line)

    @staticmethod
    def draw_line(column, line):
        row = column.split(factor=0.75)
        what = f"{line.effect}: {line.choice}" if line.choice else line.effect
        row.label(text=f"{line.material or 'Picture'}, {what}", icon="CHECKMARK" if line.is_on else "REMOVE")
        side = row.row()
        side.alignment = "RIGHT"
        side.label(text=percent(line.time_share) if line.is_on else f"error {line.error:.2g}" if line.error > 0.0 else "off")
        reason = column.row()
        reason.active = False
        reason.label(text=line.reason, icon="BLANK1")


CLASSES = (GlintPlanLine, GlintPlan, GLINT_OT_plan, GLINT_PT_plan)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.WindowManager.glint_plan = PointerProperty(type=GlintPlan)


def unregister():
    del bpy.types.WindowManager.glint_plan
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
