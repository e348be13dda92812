# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of the render engine share: small scenes, and pictures as numpy arrays with the lowest row first."""

import os
import sys

import bpy
import numpy

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from blender_case import folder, fresh  # noqa: E402


def new_scene(width=64, height=48, samples=4):
    """An empty file whose engine is Glint, with floats as they are and no view transform."""
    fresh()
    scene = bpy.context.scene
    render = scene.render
    render.engine = "GLINT"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.image_settings.color_mode = "RGBA"
    scene.view_settings.view_transform = "Raw"
    scene.glint.samples, scene.glint.bounces = samples, 0
    return scene


def link(name, data, matrix=None):
    made = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(made)
    if matrix is not None:
        made.matrix_world = matrix
    return made


def add_camera(location=(0.0, 0.0, 5.0), rotation=(0.0, 0.0, 0.0), **settings):
    data = bpy.data.cameras.new("camera")
    for name, value in settings.items():
        setattr(data, name, value)
    made = link("camera", data)
    made.location, made.rotation_euler = location, rotation
    bpy.context.scene.camera = made
    return made


def add_light(kind, energy, location=(0.0, 0.0, 3.0), rotation=(0.0, 0.0, 0.0), **settings):
    data = bpy.data.lights.new(kind.lower(), kind)
    data.energy = energy
    for name, value in settings.items():
        setattr(data, name, value)
    made = link(kind.lower(), data)
    made.location, made.rotation_euler = location, rotation
    return made


def add_plane(material=None, size=2.0, location=(0.0, 0.0, 0.0)):
    bpy.ops.mesh.primitive_plane_add(size=size, location=location)
    made = bpy.context.object
    if material is not None:
        made.data.materials.append(material)
    return made


def new_material(name="material", **inputs):
    """A Principled BSDF; inputs by their names with _ for a space."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    for key, value in inputs.items():
        material.node_tree.nodes["Principled BSDF"].inputs[key.replace("_", " ")].default_value = value
    return material


def matte(name="matte", color=(0.5, 0.5, 0.5, 1.0)):
    """Diffuse and nothing else."""
    return new_material(name, Base_Color=color, Metallic=0.0, Specular=0.0, Roughness=1.0)


def flakes(name="flakes", density_per_cm2=1.0, **values):
    material = new_material(name, Base_Color=(1.0, 1.0, 1.0, 1.0), Metallic=1.0, Roughness=0.5)
    material.glint.enabled = True
    material.glint.density_per_cm2 = density_per_cm2
    for key, value in values.items():
        setattr(material.glint, key, value)
    return material


def new_image(name, pixels, **settings):
    """A generated image of rows of RGBA from the top."""
    rows = numpy.array(pixels, numpy.float32)
    image = bpy.data.images.new(name, rows.shape[1], rows.shape[0], **settings)
    image.pixels.foreach_set(numpy.ascontiguousarray(rows[::-1]).ravel())
    return image


def connect_image(material, image, socket, output="Color", **settings):
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    for key, value in settings.items():
        setattr(node, key, value)
    tree.links.new(node.outputs[output], tree.nodes["Principled BSDF"].inputs[socket])
    return node


def read(path):
    """An EXR's first four channels."""
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    values = numpy.empty(width * height * image.channels, numpy.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    return values.reshape(height, width, -1)


def render(name="picture"):
    """Renders the scene and returns its Combined pass."""
    path = os.path.join(folder(), name + ".exr")
    scene = bpy.context.scene
    scene.render.filepath = path
    if bpy.ops.render.render(write_still=True) != {"FINISHED"}:
        raise RuntimeError("not rendered")
    return read(path)


def render_with_cycles(name="cycles", samples=64, bounces=0, node="ShaderNodeBsdfDiffuse"):
    """The same by Cycles, with what makes it a truth: see docs/blender.md. Materials have this one node from now on, with the colour
    and the roughness that they had."""
    scene = bpy.context.scene
    before = scene.render.engine
    make_single(node)
    scene.render.engine = "CYCLES"
    settings = scene.cycles
    settings.samples, settings.use_adaptive_sampling, settings.use_denoising = samples, False, False
    settings.light_sampling_threshold, settings.blur_glossy, settings.sample_clamp_indirect = 0.0, 0.0, 0.0
    settings.max_bounces = bounces
    settings.pixel_filter_type, settings.filter_width = "BOX", 1.0
    try:
        return render(name)
    finally:
        scene.render.engine = before


def make_single(kind):
    """Puts a single lobe in the place of every Principled BSDF: the diffuse part of that is Burley's in Cycles."""
    for material in bpy.data.materials:
        tree = material.node_tree
        node, old = tree.nodes.new(kind), tree.nodes["Principled BSDF"].inputs
        if kind == "ShaderNodeBsdfGlossy":
            node.distribution = "GGX"
            node.inputs["Roughness"].default_value = old["Roughness"].default_value
        color = old["Base Color"]
        node.inputs["Color"].default_value = color.default_value
        if color.is_linked:
            tree.links.new(color.links[0].from_socket, node.inputs["Color"])
        tree.links.new(node.outputs["BSDF"], tree.nodes["Material Output"].inputs["Surface"])


def black_world():
    world = bpy.data.worlds.new("black")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    bpy.context.scene.world = world
    return world
