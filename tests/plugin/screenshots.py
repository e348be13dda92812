# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the add-on for docs/blender.md, and what only a Blender with a window can show: menus, panels, undo.

Run by screenshots.sh. Blender has no exit code for a script that fails beside a window, so the last thing written is
FOLDER/done.
"""

import os
import sys
import traceback

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "plugin", "blender")]

import addon_utils  # noqa: E402
import bpy  # noqa: E402
import mathutils  # noqa: E402
import numpy  # noqa: E402

FOLDER = sys.argv[sys.argv.index("--") + 1]
bpy.context.preferences.view.show_splash = False  # before there is a window


def window():
    return bpy.context.window_manager.windows[0]


def main_area():
    return max(window().screen.areas, key=lambda area: area.width * area.height)


def override(area):
    region = next(r for r in area.regions if r.type == "WINDOW")
    return {"window": window(), "screen": window().screen, "area": area, "region": region}


def draw():
    """Draws the window now."""
    with bpy.context.temp_override(**override(main_area())):
        bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=2)


def shoot(name, area):
    path = os.path.join(FOLDER, name + ".png")
    with bpy.context.temp_override(**override(area)):
        bpy.ops.screen.screenshot_area(filepath=path)
    assert os.path.getsize(path) > 2000, path


def light_the_ball():
    """Three soft boxes in the dark: many flakes are lit."""
    bpy.data.objects.remove(bpy.data.objects["Light"])
    bpy.context.scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.012, 0.012, 0.014, 1.0)
    for place, watts, color in (((-0.25, -0.25, 0.3), 0.9, (1.0, 0.93, 0.85)), ((0.35, -0.1, 0.1), 0.5, (0.75, 0.85, 1.0)),
                                ((0.0, 0.3, 0.3), 0.9, (1.0, 1.0, 1.0))):
        lamp = bpy.data.lights.new("Soft box", "AREA")
        lamp.size, lamp.energy, lamp.color = 0.2, watts, color
        holder = bpy.data.objects.new("Soft box", lamp)
        holder.location = place
        holder.rotation_euler = mathutils.Vector(place).to_track_quat("Z", "Y").to_euler()
        bpy.context.scene.collection.objects.link(holder)


def crop(name, left, top, width, height):
    """Keeps a part of a picture: pixels from the upper left."""
    image = bpy.data.images.load(os.path.join(FOLDER, name + ".png"))
    columns, rows = image.size
    pixels = numpy.empty(columns * rows * 4, numpy.float32)
    image.pixels.foreach_get(pixels)
    part = pixels.reshape(rows, columns, 4)[rows - top - height : rows - top, left : left + width]
    kept = bpy.data.images.new(name, width, height)
    kept.pixels.foreach_set(numpy.ascontiguousarray(part).ravel())
    kept.filepath_raw, kept.file_format = image.filepath, "PNG"
    kept.save()
    bpy.data.images.remove(image)
    bpy.data.images.remove(kept)


def set_up():
    """A glittering ball on the factory's stage."""
    addon_utils.enable("glint", default_set=True)
    cube = bpy.data.objects["Cube"]
    bpy.data.objects.remove(cube)
    with bpy.context.temp_override(**override(main_area())):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.05)
        bpy.ops.object.shade_smooth()
    ball = bpy.context.view_layer.objects.active
    ball.name = "Ball"
    camera = bpy.context.scene.camera
    camera.location, camera.data.clip_start = (0.0, -0.21, 0.05), 0.01
    camera.rotation_euler = camera.location.to_track_quat("Z", "Y").to_euler()
    light_the_ball()
    material = bpy.data.materials.new("Glitter")
    material.use_nodes = True
    ball.data.materials.append(material)
    return material


def apply_preset(material, name):
    with bpy.context.temp_override(material=material, **override(main_area())):
        assert bpy.ops.glint.apply_preset(name=name) == {"FINISHED"}


def undo_takes_a_preset_back(material):
    apply_preset(material, "gold-leaf")
    seed = material.glint.seed
    bpy.ops.ed.undo_push(message="gold leaf")
    apply_preset(material, "sand")
    bpy.ops.ed.undo_push(message="sand")
    assert material.glint.seed != seed
    with bpy.context.temp_override(**override(main_area())):
        bpy.ops.ed.undo()
    material = bpy.data.materials["Glitter"]  # undo makes data anew
    assert material.glint.seed == seed, (material.glint.seed, seed)
    return material


def show_panel():
    """The Material tab in place of the 3-D view, scrolled down to our panel."""
    area = main_area()
    area.type = "PROPERTIES"
    draw()  # which finds out what tabs there are
    area.spaces.active.context = "MATERIAL"
    draw()
    for _ in range(3):
        with bpy.context.temp_override(**override(area)):
            bpy.ops.view2d.scroll_down(deltay=220)
        draw()
    return area


def show_nodes():
    area = main_area()
    area.type = "NODE_EDITOR"
    area.ui_type = "ShaderNodeTree"
    area.spaces.active.show_region_ui = False
    draw()
    with bpy.context.temp_override(**override(area)):
        bpy.ops.node.view_all()
    draw()
    return area


def build_nodes(material):
    with bpy.context.temp_override(material=material, **override(main_area())):
        assert bpy.ops.glint.build_nodes() == {"FINISHED"}


def render(name):
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 64, False
    scene.render.resolution_x, scene.render.resolution_y = 480, 360
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = os.path.join(FOLDER, name + ".png")
    bpy.ops.render.render(write_still=True)


def steps():
    """Blender draws in between."""
    material = set_up()
    yield
    material = undo_takes_a_preset_back(material)
    yield
    apply_preset(material, "craft-glitter")
    build_nodes(material)
    render("blender-first-sparkle")
    area = show_nodes()
    yield
    draw()
    shoot("blender-nodes", area)
    crop("blender-nodes", 170, 280, 440, 440)
    material.glint.space = "UV"  # a sphere's map stretches: the panel says so
    area = show_panel()
    yield
    draw()
    shoot("blender-panel", area)
    with bpy.context.temp_override(**override(area)):
        bpy.ops.wm.call_menu(name="GLINT_MT_presets")
    yield
    draw()
    shoot("blender-presets", area)


def run(sequence=None):
    try:
        next(sequence)
        return 0.3
    except StopIteration:
        with open(os.path.join(FOLDER, "done"), "w", encoding="utf-8") as file:
            file.write("done\n")
    except Exception:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()
    return None


os.makedirs(FOLDER, exist_ok=True)
sequence = steps()
bpy.app.timers.register(lambda: run(sequence), first_interval=0.5)
