# SPDX-License-Identifier: GPL-3.0-or-later
"""The render engine "Glint": final renders, material previews and the viewport, all by libglint_preview."""

import threading

import bpy
import gpu
import numpy
from gpu_extras.presets import draw_texture_2d

from . import abi, compat, scene_camera
from .library import GlintError, Picture, Scene
from .render_settings import ENGINE, passes_of, shading_of, threads_of
from .scene_data import Cache, describe
from .viewport import Session, View

# How often a final render looks whether it shall stop, and shows what there is, seconds.
LOOK_EVERY_S = 0.05
# Samples of the spheres that show a material.
PREVIEW_SAMPLES = 16
# Types of objects without a surface, and data besides meshes that has one.
WITHOUT_SURFACE = {"LIGHT", "CAMERA", "EMPTY", "LIGHT_PROBE", "SPEAKER", "ARMATURE", "LATTICE"}
WITH_SURFACE = (bpy.types.Curve, bpy.types.MetaBall)
# What Blender shows as infinitely far.
FAR = 1e10


def _depth(values, scale):
    """In Blender's units; where nothing was hit, far away."""
    return numpy.where(values > 0.0, values / scale, FAR).astype(numpy.float32)


def _z_up(vectors):
    """Rows x y z with y up as rows with z up."""
    return numpy.stack((vectors[:, 0], -vectors[:, 2], vectors[:, 1]), axis=1)


def _changes_meshes(update):
    """Whether arrays of meshes may be others now. Blender calls a change of materials, nodes and lights one of geometry, too."""
    source = update.id
    if isinstance(source, bpy.types.Object):
        return update.is_updated_geometry and source.type not in WITHOUT_SURFACE
    return isinstance(source, bpy.types.Mesh) or (update.is_updated_geometry and isinstance(source, WITH_SURFACE))


class GlintRenderEngine(bpy.types.RenderEngine):
    bl_idname = ENGINE
    bl_label = "Glint"
    bl_use_preview = True
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False

    session = None

    def __init__(self, *arguments, **settings):
        if compat.engine_has_init():
            super().__init__(*arguments, **settings)
        self.session = None

    def __del__(self):
        # Blender may have freed the engine already; the thread must end all the same.
        try:
            session = self.session
        except ReferenceError:
            return
        if session is not None:
            session.close()

    # ---- final renders ----

    def update_render_passes(self, scene, renderlayer):
        self.register_pass(scene, renderlayer, "Combined", 4, "RGBA", "COLOR")
        for name, channels, letters, kind, _ in passes_of(renderlayer):
            self.register_pass(scene, renderlayer, name, channels, letters, kind)

    def update(self, data, depsgraph):
        """Blender's data may be read here; render() only works with what came of it."""
        self.description = describe(depsgraph, **shading_of(depsgraph.scene, depsgraph.scene.glint.accuracy))
        self.camera = scene_camera.of_render(depsgraph, self.description.warnings.append)

    def render(self, depsgraph):
        try:
            self._render(depsgraph)
        except GlintError as problem:
            # In the picture's own header, and for whoever called the operator.
            self.error_set(str(problem))
            self.report({"ERROR"}, str(problem))

    def _render(self, depsgraph):
        if self.camera is None:
            raise GlintError("The scene has no camera")
        scene = Scene(self.description)
        warnings = self.description.warnings + scene.warnings
        self.description = None
        try:
            if not self.is_preview:
                for warning in warnings:
                    self.report({"WARNING"}, warning)
            self._render_layer(depsgraph, scene)
        finally:
            scene.close()

    def _render_layer(self, depsgraph, scene):
        source, layer = depsgraph.scene, depsgraph.view_layer_eval
        width, height = scene_camera.resolution(source)
        left, bottom, part_width, part_height = scene_camera.border(source)
        settings, passes = source.glint, [] if self.is_preview else passes_of(layer)
        samples = PREVIEW_SAMPLES if self.is_preview else settings.samples
        picture = Picture(
            scene, self.camera, width, height, (left, height - bottom - part_height, part_width, part_height),
            samples=samples, bounces=settings.bounces, seed=settings.seed + (source.frame_current if settings.animate_seed else 0),
            threads=threads_of(source), accuracy=settings.accuracy,
            passes=int(bool(passes)), transparent=int(source.render.film_transparent),
        )
        try:
            for name, channels, letters, _, _ in passes:
                self.add_pass(name, channels, letters, layer=layer.name)
            scale = source.unit_settings.scale_length
            for target in self._targets(picture.samples):
                if not self._refine(picture, target):
                    break
                self._show(picture, layer.name, passes if target == picture.samples else [], scale)
        finally:
            picture.close()

    def _targets(self, samples):
        """In the background nobody looks before the end."""
        if bpy.app.background or samples == 1:
            return [samples]
        return [1] + [4**k for k in range(1, 8) if 4**k < samples] + [samples]

    def _refine(self, picture, target):
        """C works in a thread, so that this one can hear of a wish to stop. False: stopped."""
        outcome = []

        def work():
            try:
                outcome.append(picture.refine(target))
            except GlintError as problem:
                outcome.append(problem)

        worker = threading.Thread(target=work, name="glint render")
        worker.start()
        while worker.is_alive():
            worker.join(LOOK_EVERY_S)
            if self.shall_stop():
                picture.cancel()
            self.update_progress(picture.progress * target / picture.samples)
        if isinstance(outcome[0], GlintError):
            raise outcome[0]
        return outcome[0]

    def shall_stop(self):
        return self.test_break()

    def _show(self, picture, layer_name, passes, scale):
        result = self.begin_result(0, 0, picture.width, picture.height, layer=layer_name)
        into = result.layers[0].passes
        into["Combined"].rect.foreach_set(picture.read(abi.COMBINED))
        for name, _, _, _, which in passes:
            values = picture.read(which)
            if which == abi.NORMAL:
                values = _z_up(values)
            elif which == abi.DEPTH:
                values = _depth(values, scale)
            into[name].rect.foreach_set(numpy.ascontiguousarray(values))
        self.end_result(result)

    # ---- the viewport ----

    def view_update(self, context, depsgraph):
        """Blender calls it when the scene has changed."""
        if self.session is None:
            self.session, self.cache = Session(self._ask_for_redraw), Cache()
        self._forget(depsgraph)
        try:
            shading = shading_of(depsgraph.scene, depsgraph.scene.glint.preview_accuracy)
            self.session.show_scene(describe(depsgraph, self.cache, **shading))
        except GlintError as problem:
            self.session.problem = str(problem)

    def _forget(self, depsgraph):
        for update in depsgraph.updates:
            if _changes_meshes(update):
                self.cache.forget_geometry()
            if isinstance(update.id, bpy.types.Image):
                self.cache.forget_images()

    def _ask_for_redraw(self):
        """Sets a flag that Blender's main loop reads; the engine may be gone when its thread ends."""
        try:
            self.tag_redraw()
        except ReferenceError:
            pass

    def view_draw(self, context, depsgraph):
        region, scene = context.region, depsgraph.scene
        settings = scene.glint
        self.session.show_view(View(
            camera=scene_camera.of_view(context.region_data, scene), width=region.width, height=region.height,
            samples=settings.preview_samples, bounces=settings.bounces, seed=settings.seed,
            accuracy=settings.preview_accuracy, threads=threads_of(scene), transparent=scene.render.film_transparent,
        ))
        frame = self.session.frame
        self._tell(frame)
        if frame is not None:
            self._draw(frame, region, scene)

    def _tell(self, frame):
        if self.session.problem:
            self.update_stats("Glint", self.session.problem)
        elif frame is not None:
            notes = f"  ({self.session.warnings[0]})" if self.session.warnings else ""
            self.update_stats("Glint", f"Sample {frame.samples}/{frame.view.samples}{notes}")

    def _draw(self, frame, region, scene):
        values = gpu.types.Buffer("FLOAT", frame.pixels.size, frame.pixels.ravel())
        texture = gpu.types.GPUTexture((frame.width, frame.height), format="RGBA16F", data=values)
        gpu.state.blend_set("ALPHA_PREMULT")
        self.bind_display_space_shader(scene)
        draw_texture_2d(texture, (0, 0), region.width, region.height)
        self.unbind_display_space_shader()
        gpu.state.blend_set("NONE")


def register():
    bpy.utils.register_class(GlintRenderEngine)


def unregister():
    bpy.utils.unregister_class(GlintRenderEngine)
