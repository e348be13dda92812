# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the add-on for docs/blender.md, and what only a Blender with a window can show: menus, panels, undo.

    xvfb-run -a -s "-screen 0 1280x1024x24" blender --factory-startup --window-geometry 0 0 1280 1024 -P screenshots.py -- FOLDER

Blender has no exit code for a script that fails beside a window, so the last thing written is FOLDER/done.
"""

import os
import sys
import traceback

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "plugin", "blender")]

import addon_utils  # noqa: E402
import bpy  # noqa: E402

FOLDER = sys.argv[sys.argv.index("--") + 1]


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


def shoot(name, area=None):
    path = os.path.join(FOLDER, name + ".png")
    if area is None:
        with bpy.context.temp_override(window=window()):
            bpy.ops.screen.screenshot(filepath=path)
    else:
        with bpy.context.temp_override(**override(area)):
            bpy.ops.screen.screenshot_area(filepath=path)
    assert os.path.getsize(path) > 2000, path


def set_up():
    """A glittering ball on the factory's stage."""
    addon_utils.enable("glint", default_set=True)
    bpy.context.preferences.view.show_splash = False
    cube = bpy.data.objects["Cube"]
    bpy.data.objects.remove(cube)
    with bpy.context.temp_override(**override(main_area())):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.05)
        bpy.ops.object.shade_smooth()
    ball = bpy.context.view_layer.objects.active
    ball.name = "Ball"
    camera = bpy.context.scene.camera
    camera.location, camera.rotation_euler = (0.0, -0.32, 0.1), (1.27, 0.0, 0.0)
    light = bpy.data.objects["Light"]
    light.data.type, light.data.energy, light.data.angle, light.rotation_euler = "SUN", 6.0, 0.02, (0.6, 0.4, 0.0)
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


def show_panel(material):
    """The Material tab in place of the 3-D view, all panels but ours closed."""
    area = main_area()
    area.type = "PROPERTIES"
    draw()  # which finds out what tabs there are
    area.spaces.active.context = "MATERIAL"
    draw()
    return area


def show_nodes(material):
    area = main_area()
    area.type = "NODE_EDITOR"
    area.ui_type = "ShaderNodeTree"
    draw()
    with bpy.context.temp_override(**override(area)):
        bpy.ops.node.view_all()
    draw()
    return area


def steps():
    """Blender draws in between."""
    material = set_up()
    yield
    material = undo_takes_a_preset_back(material)
    yield
    apply_preset(material, "craft-glitter")
    material.glint.space = "UV"  # a sphere's map stretches: the panel says so
    area = show_panel(material)
    yield
    draw()
    shoot("blender-panel", area)
    with bpy.context.temp_override(**override(area)):
        bpy.ops.wm.call_menu(name="GLINT_MT_presets")
    yield
    draw()
    shoot("blender-presets", area)
    apply_preset(material, "craft-glitter")
    with bpy.context.temp_override(material=material, **override(area)):
        assert bpy.ops.glint.build_nodes() == {"FINISHED"}
    area = show_nodes(material)
    yield
    draw()
    shoot("blender-nodes", area)


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
