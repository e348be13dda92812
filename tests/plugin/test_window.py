# SPDX-License-Identifier: GPL-3.0-or-later
"""What needs a window besides viewport and panel: spheres that show a material, the plan, jobs that Esc stops, messages of the
glTF hooks.

    xvfb-run -a -s "-screen 0 940x1100x24" blender --factory-startup --enable-event-simulate -P test_window.py -- FOLDER

Writes pictures of the window to FOLDER, and ends with exit code 0 or 3.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import bpy
import numpy

import window_case
from blender_case import folder
from engine_case import flakes
from window_case import area, override, press, shoot, wait_for, window

# Of every picture of the engine's: whether it was a preview, and its side.
rendered = []


def watch():
    from glint.engine import GlintRenderEngine

    before = GlintRenderEngine._render

    def render(self, depsgraph):
        before(self, depsgraph)
        rendered.append((self.is_preview, depsgraph.scene.render.resolution_x))

    GlintRenderEngine._render = render


def set_up():
    import addon_utils

    addon_utils.enable("glint", default_set=True)
    watch()
    cube = bpy.data.objects["Cube"]
    material = flakes("glitter", 300.0, space="OBJECT")
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.9, 0.5, 0.2, 1.0)
    cube.data.materials.clear()
    cube.data.materials.append(material)
    bpy.context.scene.render.engine = "GLINT"
    return material


# ---- spheres ----


def show_material(view):
    """The tab of the material in place of the 3-D view."""
    view.type = "PROPERTIES"
    yield 0.5  # which finds out what tabs there are
    view.spaces[0].context = "MATERIAL"


def previews():
    """Sides of the pictures of spheres so far."""
    return [side for is_preview, side in rendered if is_preview]


def pixels_of_sphere(material):
    side = material.preview.image_size[0]
    return numpy.array(material.preview.image_pixels_float[:], numpy.float32).reshape(side, side, 4)


def middle_of_sphere(material):
    picture = pixels_of_sphere(material)
    side = picture.shape[0]
    return picture[side // 4 : 3 * side // 4, side // 4 : 3 * side // 4, :3].reshape(-1, 3)


def spheres_show_a_material(material, view):
    """The small one in the list of the material's slots, which Blender itself shows for EEVEE only, and a large one for libraries."""
    yield from show_material(view)
    yield from wait_for("the sphere in the list of slots", previews)
    with bpy.context.temp_override(window=window(), area=view, id=material):
        assert bpy.ops.ed.lib_id_generate_preview() == {"FINISHED"}
    yield from wait_for("the large sphere", lambda: max(previews()) > 100)
    yield 1.0
    yield from shoot(os.path.join(folder(), "slots.png"), view)
    # The engine is done before Blender has put its picture into the material: on a busy machine, by more than a second.
    yield from wait_for("the large sphere's pixels", lambda: middle_of_sphere(material).max(axis=1).min() > 0.0)
    ball = middle_of_sphere(material)
    red, _, blue = ball.mean(axis=0)
    assert red > 1.3 * blue > 0.0, f"a ball of copper is {ball.mean(axis=0)}"
    assert ball.std(axis=0).max() > 0.05, "no flake is to be seen"
    save(pixels_of_sphere(material), "sphere")


def save(picture, name):
    image = bpy.data.images.new(name, picture.shape[1], picture.shape[0])
    image.pixels.foreach_set(numpy.ascontiguousarray(picture).ravel())
    image.filepath_raw, image.file_format = os.path.join(folder(), name + ".png"), "PNG"
    image.save()


# ---- the plan ----


def the_plan_is_shown(view):
    view.spaces[0].context = "RENDER"
    yield 0.5
    before, after = (os.path.join(folder(), name + ".png") for name in ("unplanned", "plan"))
    shoot_area(before, view)
    with bpy.context.temp_override(**override(view)):
        assert bpy.ops.glint.plan() == {"FINISHED"}
    yield 0.5
    shoot_area(after, view)  # as docs/blender.md shows it
    rows = numpy.any(pixels_of(after) != pixels_of(before), axis=(1, 2)).sum()
    assert rows > 300, f"{rows} rows of pixels show the plan"


def shoot_area(path, of):
    with bpy.context.temp_override(**override(of)):
        bpy.ops.screen.screenshot_area(filepath=path)


# ---- jobs ----


def running_blenders():
    """Processes that this one has begun."""
    own = str(os.getpid())
    found = []
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/stat", encoding="ascii") as file:
                fields = file.read().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if fields[1] == own and fields[0] != "Z":
            found.append(int(name))
    return found


def escape_stops_a_job():
    scene = bpy.context.scene
    path = os.path.join(folder(), "never.exr")
    scene.glint_reference.path, scene.glint_reference.samples = path, 65536  # hours
    before = set(running_blenders())
    with bpy.context.temp_override(**override(area("PROPERTIES"))):
        assert bpy.ops.glint.render_reference("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield from wait_for("another Blender", lambda: set(running_blenders()) - before)
    yield 1.0
    press("ESC")
    yield from wait_for("the other Blender to end", lambda: not set(running_blenders()) - before)
    yield 0.5
    assert not os.path.exists(path), "half a picture"
    # The window is free for the next one.
    scene.glint_reference.path = "nothing"
    with bpy.context.temp_override(**override(area("PROPERTIES"))):
        try:
            bpy.ops.glint.render_reference("INVOKE_DEFAULT")
        except RuntimeError as problem:
            assert "expected a name that ends in .exr" in str(problem), problem


# ---- messages ----


def pixels_of(path):
    image = bpy.data.images.load(path)
    width, height = image.size
    values = numpy.empty(width * height * 4, numpy.float32)
    image.pixels.foreach_get(values)
    return values.reshape(height, width, 4)


def hooks_open_a_message():
    from glint import gltf

    view = area("PROPERTIES")
    quiet, loud = (os.path.join(folder(), name + ".png") for name in ("quiet", "message"))
    yield from shoot(quiet, view)
    gltf._show("glTF, 'glitter': glints or lights are left out: found a horse, expected a number")
    yield 1.5
    yield from shoot(loud, view)
    changed = numpy.abs(pixels_of(loud) - pixels_of(quiet)).max(axis=-1) > 0.05
    rows, columns = changed.any(axis=1).sum(), changed.any(axis=0).sum()
    assert rows > 30 and columns > 300, f"a message of {columns} x {rows} pixels"
    assert gltf.problems


def script():
    material = set_up()
    yield 0.5
    view = area("VIEW_3D")  # which becomes properties
    yield from spheres_show_a_material(material, view)
    yield from the_plan_is_shown(view)
    yield from escape_stops_a_job()
    yield from hooks_open_a_message()


window_case.run("window", script)
