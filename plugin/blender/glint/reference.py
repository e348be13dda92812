# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles reference renders: the settings without which Cycles is no truth for glints, and how many samples it takes."""

import math
import os
import time

import bpy

from . import compat, nodes, principled, readout

# Samples for each flake in a pixel: 4 give a correlation of .94 with the exact picture, 14 of .99.
SAMPLES_PER_FLAKE = 16
LEAST_SAMPLES, MOST_SAMPLES = 64, 16384


def open_scene(path, camera=""):
    """A new file with nothing in it but the glTF scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    import addon_utils

    addon_utils.enable("glint", default_set=True)
    result = compat.import_gltf(os.path.abspath(path))
    if "FINISHED" not in result:
        raise RuntimeError(f"{path}: Blender's importer gave up")
    scene = bpy.context.scene
    cameras = [o for o in scene.objects if o.type == "CAMERA"]
    named = [o for o in cameras if camera in {o.name, o.data.name}] if camera else cameras
    if not named:
        names = ", ".join(o.name for o in cameras) or "none"
        raise RuntimeError(f"{path}: no camera '{camera}'; there are: {names}")
    scene.camera = named[0]
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
    fit_camera(scene.camera, width, height)


def fit_camera(camera, width, height):
    """glTF's field of view is that of the height, its orthographic sizes are halves."""
    data = camera.data
    if data.type == "PERSP":
        data.sensor_fit = "VERTICAL"
    elif data.type == "ORTHO" and width < height:
        data.sensor_fit = "VERTICAL"


def most_flakes_per_pixel(scene):
    most = 0.0
    for object_ in scene.objects:
        if object_.type != "MESH":
            continue
        side = readout.pixel_side_m(scene, object_)
        for slot in object_.material_slots:
            if slot.material is not None and slot.material.glint.enabled and side is not None:
                most = max(most, slot.material.glint.density_per_cm2 * 1e4 * side * side)
    return most


def samples_for(flakes):
    wanted = max(SAMPLES_PER_FLAKE * flakes, LEAST_SAMPLES)
    return int(min(MOST_SAMPLES, 2 ** math.ceil(math.log2(wanted))))


def render(scene, values):
    """Renders to values.output; returns what the picture depends on."""
    set_up(scene, values.width, values.height, values.threads, values.bounces, values.seed)
    flakes = most_flakes_per_pixel(scene)
    scene.cycles.samples = values.spp or samples_for(flakes)
    materials = {}
    for material in bpy.data.materials:
        if not material.glint.enabled:
            continue
        left_out = principled.textured_inputs(material)
        if left_out:
            print(f"reference: {material.name}: taken as constants: {', '.join(left_out)}")
        nodes.build(material, values.smooth)
        compat.keep_normals(material)
        f = principled.flakes_of(material)
        materials[material.name] = {
            "distribution": f.distribution, "alpha": [f.alpha_x, f.alpha_y], "density_per_m2": f.density_per_m2,
            "facet_roughness": f.facet_roughness, "seed": f.seed,
        }
    scene.render.filepath = os.path.abspath(values.output)
    start = time.perf_counter()
    bpy.ops.render.render(write_still=True)
    return {
        "scene": os.path.basename(values.scene), "size": [values.width, values.height], "spp": scene.cycles.samples,
        "seed": values.seed, "facets": "cycles", "smooth": values.smooth, "flakes_per_pixel": flakes,
        "materials": materials, "blender": bpy.app.version_string, "seconds": time.perf_counter() - start,
    }
