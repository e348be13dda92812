# SPDX-License-Identifier: GPL-3.0-or-later
"""Area lights as EXT_lights_area: rectangles and disks, intensity their radiance, shining along -z on one side."""

import math

import bpy

NAME = "EXT_lights_area"

ROUND = {"DISK", "ELLIPSE"}

# Cycles gives an area light of power P and area A the radiance P / (4 A), not a Lambertian emitter's P / (pi A): measured
# by tests/plugin/test_cycles_flakes.py.
WATTS_PER_RADIANCE = 4.0


def sides(light):
    """Width and height; Blender's second size counts for two of its shapes only."""
    return light.size, light.size_y if light.shape in {"RECTANGLE", "ELLIPSE"} else light.size


def area(width, height, is_round):
    return width * height * (math.pi / 4.0 if is_round else 1.0)


def of_light(light):
    """The node's extension for a light of Blender's: a reference to one in the file's list."""
    from io_scene_gltf2.io.com.gltf2_io_extensions import ChildOfRootExtension, Extension

    width, height = sides(light)
    is_round = light.shape in ROUND
    content = {
        "type": "disk" if is_round else "rect",
        "name": light.name,
        "color": list(light.color),
        "intensity": light.energy / (WATTS_PER_RADIANCE * area(width, height, is_round)),
        "size": height,
    }
    if width != height:
        # The draft knows no ellipses; the aspect of one is lost on others but comes back here.
        content["rect"] = {"aspect": width / height}
    listed = ChildOfRootExtension(name=NAME, path=["lights"], extension=content, required=False)
    return Extension(name=NAME, extension={"light": listed}, required=False)


def add(content, parent, gltf):
    """A light of Blender's under the empty that the importer made of the node."""
    is_round = content.get("type", "rect") == "disk"
    height = content.get("size", 1.0)
    width = height * content.get("rect", {}).get("aspect", 1.0)
    light = bpy.data.lights.new(content.get("name", "Area"), "AREA")
    light.shape = ("ELLIPSE" if width != height else "DISK") if is_round else "RECTANGLE"
    light.size, light.size_y = width, height
    light.color = content.get("color", [1.0, 1.0, 1.0])
    light.energy = content.get("intensity", 1000.0) * WATTS_PER_RADIANCE * area(width, height, is_round)
    made = bpy.data.objects.new(parent.name, light)
    made.parent = parent
    # The importer turns y up into z up; a light then looks along its own y.
    made.rotation_euler = (math.pi / 2.0, 0.0, 0.0)
    bpy.data.scenes[gltf.blender_scene].collection.objects.link(made)
