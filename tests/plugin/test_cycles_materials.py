# SPDX-License-Identifier: GPL-3.0-or-later
"""What the node graph has beyond plain white flakes, pixel by pixel against libglint: textures, palettes, coats, object space.

    blender -b --factory-startup --python-exit-code 3 -P test_cycles_materials.py -- FOLDER GLINT

Every material is made in Blender, rendered by Cycles through its nodes, exported to glTF and rendered by libglint's explicit
model with the same flakes. What is left is sampling noise, so a correlation above .99 says that cells, normals, colours and
weights are the same: one flake in ten that were another's would cost .1.
"""

import math
import os
import subprocess
import sys
import types
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, HERE)

import bpy  # noqa: E402
import numpy  # noqa: E402

import blender_case  # noqa: E402
from blender_case import folder, fresh  # noqa: E402

SIZE, SAMPLES = 48, 512


def load(path):
    picture = bpy.data.images.load(path)
    picture.colorspace_settings.name = "Non-Color"
    pixels = numpy.empty(SIZE * SIZE * 4, numpy.float32)
    picture.pixels.foreach_get(pixels)
    bpy.data.images.remove(picture)
    return pixels.reshape(-1, 4)[:, :3].astype(float)


def stage(shape):
    """A camera over the object and a sun; returns the material that the object wears."""
    if shape == "plane":
        bpy.ops.mesh.primitive_plane_add(size=1.0)
    else:
        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.2)
        bpy.ops.object.shade_smooth()
    material = bpy.data.materials.new("flakes")
    material.use_nodes = True
    bpy.context.object.data.materials.append(material)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 0.45
    camera.location, camera.rotation_euler = (0.0, -0.5176, 1.9319), (math.radians(15.0), 0.0, 0.0)
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.angle, sun.data.energy, sun.rotation_euler = 0.1, 1.0, (math.radians(-10.0), 0.1, 0.0)
    for object_ in (camera, sun):
        bpy.context.collection.objects.link(object_)
    bpy.context.scene.camera = camera
    return material


def principled_inputs(material, **values):
    from glint import principled

    for name, value in values.items():
        principled.find(material).inputs[name.replace("_", " ")].default_value = value


def image_of(name, pixel):
    """A small image inside the file; pixel(x, y) gives red, green and blue."""
    image = bpy.data.images.new(name, 32, 32)
    image.pixels = [c for y in range(32) for x in range(32) for c in (*pixel(x, y), 1.0)]
    image.pack()
    return image


def link_image(material, image, to):
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    tree.links.new(node.outputs["Color"], to)


class SameFlakes(unittest.TestCase):
    def setUp(self):
        fresh()

    def pictures(self, name, model="explicit", samples=SAMPLES, ours=16):
        from glint import compat, reference

        path = os.path.join(folder(), name)
        compat.export_gltf(path + ".glb", export_format="GLB", export_lights=True, export_cameras=True)
        values = types.SimpleNamespace(scene="", output=path + "_cycles.exr", width=SIZE, height=SIZE, spp=samples, bounces=0,
                                       seed=0, threads=0, smooth=False)
        reference.render(bpy.context.scene, values)
        subprocess.run([sys.argv[-1], "render", path + ".glb", "-o", path + ".exr", "--model", model, "--facets", "cycles",
                        "--bounces", "0", "--size", f"{SIZE}x{SIZE}", "--spp", str(ours)], check=True,
                       stderr=subprocess.DEVNULL)
        return load(path + "_cycles.exr"), load(path + ".exr")

    def hold(self, name, correlation=0.99, mean=0.03, **settings):
        cycles, ours = self.pictures(name, **settings)
        found = numpy.corrcoef(cycles.ravel(), ours.ravel())[0, 1]
        ratios = ours.mean(0) / cycles.mean(0)
        print(f"{name}: correlation {found:.4f}, ratio of means {ratios.round(4)}", flush=True)
        self.assertGreater(cycles.std(), 0.05 * cycles.mean())
        self.assertGreater(found, correlation)
        for ratio in ratios:
            self.assertAlmostEqual(ratio, 1.0, delta=mean)

    def flakes(self, material, **values):
        group = material.glint
        for name, value in {"enabled": True, "density_per_cm2": 20.0, "facet_roughness": 0.1, "seed": 3, **values}.items():
            setattr(group, name, value)
        return group

    def test_palette_hue_and_turned_anisotropy(self):
        material = stage("plane")
        principled_inputs(material, Metallic=1.0, Base_Color=(0.9, 0.6, 0.3, 1.0), Roughness=0.4, Anisotropic=0.5,
                          Anisotropic_Rotation=0.1)
        group = self.flakes(material, color_variation=0.4, elongation=3.0, distribution="BECKMANN")
        for color in ((1.0, 0.1, 0.1), (0.2, 0.9, 0.1), (0.1, 0.2, 1.0)):
            group.colors.add().color = color
        self.hold("palette")

    def test_textures_of_density_tint_and_base(self):
        material = stage("plane")
        principled_inputs(material, Metallic=1.0, Roughness=0.5)
        group = self.flakes(material, density_per_cm2=40.0)
        group.density_texture.image = image_of("density", lambda x, y: (0.0, 1.0 if (x // 8 + y // 8) % 2 else 0.25, 0.0))
        group.density_texture.closest = True
        group.color_texture.image = image_of("tint", lambda x, y: (1.0, 0.5 if x < 16 else 1.0, 0.2))
        group.color_texture.closest = True
        group.color_texture.scale, group.color_texture.offset = (2.0, 1.0), (0.25, 0.0)
        base = image_of("base", lambda x, y: (0.9, 0.9 if y < 16 else 0.3, 0.8))
        from glint import principled

        link_image(material, base, principled.find(material).inputs["Base Color"])
        self.hold("textures")

    def test_flakes_in_base_and_coat(self):
        material = stage("plane")
        principled_inputs(material, Metallic=0.5, Base_Color=(0.1, 0.2, 0.6, 1.0), Roughness=0.5, Clearcoat=0.8,
                          Clearcoat_Roughness=0.4)
        group = self.flakes(material)
        group.coat.enabled, group.coat.density_per_cm2, group.coat.facet_roughness = True, 4.0, 0.1
        group.coat.color = (1.0, 0.6, 0.2)
        self.hold("coat", samples=1024)

    def test_object_space_on_a_sphere(self):
        material = stage("sphere")
        principled_inputs(material, Metallic=1.0, Roughness=0.6)
        # Uneven scales turn the tangents of Cycles: other flakes, of the same statistics.
        bpy.context.scene.objects["Sphere"].scale = (1.2, 1.2, 1.2)
        bpy.context.view_layer.update()
        self.flakes(material, space="OBJECT", density_per_cm2=10.0)
        self.hold("object", samples=1536, ours=128)

    def test_example_shows_its_texels(self):
        material = stage("plane")
        principled_inputs(material, Metallic=1.0, Roughness=0.5)
        group = self.flakes(material, structure="EXAMPLE", facet_roughness=0.25, example_size=0.4)
        rng = numpy.random.default_rng(1)
        slopes = rng.uniform(-0.3, 0.3, (32, 32, 2))

        def pixel(x, y):
            n = numpy.array([*slopes[y, x], 1.0])
            return 0.5 + 0.5 * n / numpy.linalg.norm(n)

        group.example_texture.image, group.example_texture.closest = image_of("texels", pixel), True
        self.hold("example", correlation=0.9, mean=0.05, model="example", ours=64)


blender_case.run(SameFlakes)
