# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles reference renders: the settings without which Cycles is no truth for glints, and how many samples it takes."""

import math
import os
import time

import addon_utils
import bpy

from . import compat, nodes, principled, readout

# Samples for each flake in a pixel: 4 give a correlation of .94 with the exact picture, 14 of .99.
SAMPLES_PER_FLAKE = 16
LEAST_SAMPLES, MOST_SAMPLES = 64, 16384


def _chosen_camera(scene, path, camera):
    cameras = [o for o in scene.objects if o.type == "CAMERA"]
    if not camera and scene.camera is not None:
        return scene.camera
    named = [o for o in cameras if camera in {o.name, o.data.name}] if camera else cameras
    if not named:
        names = ", ".join(o.name for o in cameras) or "none"
        raise RuntimeError(f"{path}: no camera '{camera}'; there are: {names}")
    return named[0]


def open_scene(path, camera=""):
    """The scene of a .blend file, or a new file with nothing in it but a glTF scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable(__package__, default_set=True)
    if path.lower().endswith(".blend"):
        bpy.ops.wm.open_mainfile(filepath=os.path.abspath(path))
        addon_utils.enable(__package__, default_set=True)
    elif "FINISHED" not in compat.import_gltf(os.path.abspath(path)):
        raise RuntimeError(f"{path}: Blender's importer gave up")
    scene = bpy.context.scene
    scene.camera = _chosen_camera(scene, path, camera)
    if not path.lower().endswith(".blend"):
        fit_camera(scene.camera)
    return scene


def set_up(scene, width, height, threads=0, bounces=0, seed=0):
    """Everything that would bias or blur the picture is off."""
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.seed = seed
    cycles.light_threshold = 0.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.blur_glossy = 0.0
    cycles.caustics_reflective = True
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1.0
    # Cycles counts the bounce that finds a light.
    cycles.max_bounces = cycles.glossy_bounces = cycles.diffuse_bounces = bounces
    cycles.transmission_bounces = cycles.volume_bounces = cycles.transparent_max_bounces = 0
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.use_persistent_data = False
    render.film_transparent = True
    render.dither_intensity = 0.0
    render.threads_mode = "FIXED" if threads else "AUTO"
    if threads:
        render.threads = threads
    settings = render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGBA"
    settings.exr_codec = "ZIP"
    scene.view_settings.view_transform = "Raw"
    for light in bpy.data.lights:
        light.cycles.use_multiple_importance_sampling = True


def choose_tile(render, tile):
    """Renders a part of the picture only: left and top, width and height in pixels; None is all."""
    render.use_border = render.use_crop_to_border = tile is not None
    if tile is None:
        return
    left, top, width, height = tile
    bottom = render.resolution_y - top - height
    # Blender cuts to whole pixels: a quarter of one more than rounding can take away.
    render.border_min_x = (left + 0.25) / render.resolution_x
    render.border_max_x = (left + width + 0.25) / render.resolution_x
    render.border_min_y = (bottom + 0.25) / render.resolution_y
    render.border_max_y = (bottom + height + 0.25) / render.resolution_y


def fit_camera(camera):
    """glTF's field of view is that of the height, its orthographic sizes are halves of the picture's."""
    if camera.data.type == "PERSP":
        camera.data.sensor_fit = "VERTICAL"


def most_flakes_per_pixel(scene):
    most = 0.0
    for object_ in scene.objects:
        for slot in object_.material_slots if object_.type == "MESH" else ():
            if slot.material is None:
                continue
            group = slot.material.glint
            counts = [readout.flakes_per_pixel(scene, object_, v) for v in (group, group.coat) if v.enabled]
            most = max([most, *(c for c in counts if c is not None)])
    return most


def samples_for(flakes):
    wanted = max(SAMPLES_PER_FLAKE * flakes, LEAST_SAMPLES)
    return int(min(MOST_SAMPLES, 2 ** math.ceil(math.log2(wanted))))


def show_flakes(scene, smooth):
    """Builds the nodes of every material that has flakes; returns what they are made of."""
    materials = {}
    for material in bpy.data.materials:
        group = material.glint
        if not group.enabled and not group.coat.enabled:
            continue
        for note in nodes.notes(material):
            print(f"reference: {material.name}: Cycles cannot show {note}")
        nodes.build(material, smooth)
        compat.keep_normals(material)
        alpha = principled.alpha_of(material)
        strength = principled.value_of(principled.find(material), ("Anisotropic",), 0.0)
        materials[material.name] = {
            "distribution": group.distribution, "alpha": [alpha + (1.0 - alpha) * strength**2, alpha],
            "density_per_m2": group.density_per_cm2 * 1e4, "facet_roughness": group.facet_roughness, "seed": group.seed,
            "space": group.space, "left_out": nodes.notes(material),
        }
    return materials


def render(scene, values):
    """Renders to values.output; returns what the picture depends on."""
    set_up(scene, values.width, values.height, values.threads, values.bounces, values.seed)
    tile = getattr(values, "tile", None)
    choose_tile(scene.render, tile)
    keeps_world = getattr(values, "world", False)
    if not keeps_world:
        scene.world = None
    flakes = most_flakes_per_pixel(scene)
    scene.cycles.samples = values.spp or samples_for(flakes)
    materials = show_flakes(scene, values.smooth)
    scene.render.filepath = os.path.abspath(values.output)
    start = time.perf_counter()
    bpy.ops.render.render(write_still=True)
    return {
        "scene": os.path.basename(values.scene), "size": [values.width, values.height], "tile": tile,
        "spp": scene.cycles.samples, "seed": values.seed, "facets": "cycles", "smooth": values.smooth,
        "world": keeps_world, "camera": scene.camera.name, "flakes_per_pixel": flakes, "materials": materials,
        "blender": bpy.app.version_string, "seconds": time.perf_counter() - start,
    }
