# SPDX-License-Identifier: GPL-3.0-or-later
"""The viewport of the engine in a window: it fills in, follows a change of the flakes and its undoing, drops what it does for a
turn of the view, and leaves no thread behind.

    xvfb-run -a -s "-screen 0 800x600x24" blender --factory-startup -P test_viewport.py -- FOLDER

Writes FOLDER/viewport.png, a picture of the window, and ends with exit code 0 or 3.
"""

import os
import sys
import threading

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import bpy
import mathutils
import numpy

import window_case
from blender_case import folder
from engine_case import add_camera, add_light, add_plane, flakes, matte
from window_case import area, override, shoot, wait_for

MANY_SAMPLES = 4096  # of this view they take minutes


# Every session that the engine began, the newest last; whether they made a scene or changed theirs.
sessions, made = [], []


def watch():
    """Keeps the sessions of viewports, which are the engine's own otherwise."""
    from glint import engine, viewport

    class Watched(viewport.Session):
        def __init__(self, redraw):
            sessions.append(self)
            super().__init__(redraw)

    class Counted(viewport.Scene):
        def __init__(self, description):
            made.append("scene")
            super().__init__(description)

        def change(self, description, parts):
            made.append("change")
            return super().change(description, parts)

    engine.Session, viewport.Scene = Watched, Counted


def frame():
    """The picture in the viewport once it is done, or None."""
    return sessions[-1].frame if sessions and sessions[-1].is_done() else None


def set_up():
    import addon_utils

    addon_utils.enable("glint", default_set=True)
    watch()
    for each in list(bpy.data.objects):
        bpy.data.objects.remove(each)
    add_plane(matte("floor", (0.3, 0.3, 0.35, 1.0)), 8.0)
    bpy.ops.mesh.primitive_uv_sphere_add(location=(0.0, 0.0, 1.0), segments=64, ring_count=32)
    bpy.ops.object.shade_smooth()
    ball = bpy.context.object
    ball.data.materials.append(flakes("ball", 300.0, space="OBJECT"))
    ball.data.materials[0].node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.9, 0.5, 0.2, 1.0)
    add_light("SUN", 3.0, rotation=(0.6, 0.3, 0.0), angle=0.05)
    camera = add_camera((0.0, -6.0, 3.2), (1.2, 0.0, 0.0))
    scene = bpy.context.scene
    scene.camera, scene.glint.preview_samples = camera, 4
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.2, 0.3, 0.5, 1.0)
    scene.render.engine = "GLINT"
    view = area("VIEW_3D")
    view.spaces[0].region_3d.view_perspective = "CAMERA"
    view.spaces[0].shading.type = "RENDERED"
    return ball


def script():
    ball = set_up()
    yield from wait_for("the first picture", lambda: frame() is not None)
    first = frame().pixels.copy()
    assert numpy.isfinite(first).all() and first[:, :3].max() > 0.5, "the view is black"
    assert frame().samples == 4

    path = os.path.join(folder(), "viewport.png")
    view = area("VIEW_3D")
    yield 0.5
    yield from shoot(path, view)
    shot = bpy.data.images.load(path)
    pixels = numpy.array(shot.pixels[:]).reshape(-1, 4)
    assert pixels[:, :3].std() > 0.05, "the window shows one colour"

    yield from change_and_undo(view, first)
    yield from light_and_world_keep_the_tree(view)
    yield from turn_while_it_works(view)
    yield from leave(view)


def change_and_undo(view, first):
    """A property is another picture, and undone it is the old one."""
    bpy.ops.ed.undo_push(message="before")
    glint = bpy.data.materials["ball"].glint
    glint.seed = 7
    bpy.data.materials["ball"].update_tag()  # which a click in the panel does by itself
    bpy.ops.ed.undo_push(message="another seed")
    yield from wait_for("the picture of another seed", lambda: frame() is not None and not same(frame().pixels, first))
    assert made == ["scene", "change"], made
    other = frame().pixels.copy()
    for operator, expected in ((bpy.ops.ed.undo, first), (bpy.ops.ed.redo, other), (bpy.ops.ed.undo, first)):
        with bpy.context.temp_override(**override(view)):
            assert operator() == {"FINISHED"}
        view.tag_redraw()  # which a key does by itself
        yield from wait_for(f"the picture after {operator.idname()}",
                            lambda expected=expected: frame() is not None and same(frame().pixels, expected))
    assert bpy.data.materials["ball"].glint.seed == 0  # undo makes data anew


def light_and_world_keep_the_tree(view):
    """And a mesh that is another one does not."""
    def energy():
        bpy.data.lights["sun"].energy = 1.0

    def world():
        bpy.context.scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 2.0

    def place():
        bpy.data.objects["sun"].rotation_euler.x = 0.3

    def mesh():
        ball = next(mesh for mesh in bpy.data.meshes if len(mesh.vertices) > 100)
        ball.transform(mathutils.Matrix.Scale(0.5, 4))
        ball.update()

    for change, expected in ((energy, "change"), (world, "change"), (place, "change"), (mesh, "scene")):
        before = frame().pixels.copy()
        made.clear()
        change()
        view.tag_redraw()
        yield from wait_for(change.__name__, lambda before=before: frame() is not None and not same(frame().pixels, before))
        assert made == [expected], (change.__name__, made)


def turn_while_it_works(view):
    """A picture that would take minutes makes room at once."""
    settings = bpy.context.scene.glint
    settings.preview_samples = MANY_SAMPLES
    view.tag_redraw()  # which a click in the panel does by itself
    yield from wait_for("a picture of many samples to begin", lambda: sessions[-1].frame.view.samples == MANY_SAMPLES)
    assert not sessions[-1].is_done()
    settings.preview_samples = 4
    view.spaces[0].region_3d.view_perspective = "PERSP"
    view.tag_redraw()
    before = sessions[-1].frame.view.camera
    yield from wait_for("the picture of another view", lambda: frame() is not None and frame().samples == 4
                        and bytes(frame().view.camera) != bytes(before))


def leave(view):
    """Without a rendered view there is no engine, and its thread and scene are gone."""
    view.spaces[0].shading.type = "SOLID"
    view.tag_redraw()
    yield from wait_for("the thread of the viewport to end",
                        lambda: not any(thread.name == "glint viewport" for thread in threading.enumerate()))


def same(a, b):
    return a.shape == b.shape and numpy.array_equal(a, b)


window_case.run("viewport", script)
