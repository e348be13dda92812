# SPDX-License-Identifier: GPL-3.0-or-later
"""Final renders by the engine Glint: the same picture as the glint command's, passes, borders, animation, memory, stopping.

    blender -b --factory-startup --python-exit-code 3 -P test_engine.py -- FOLDER GLINT
"""

import contextlib
import json
import math
import os
import struct
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import bpy
import numpy

import blender_case
from blender_case import folder
from engine_case import (add_camera, add_light, add_plane, black_world, connect_image, flakes, matte, new_image, new_material,
                         new_scene, read, render)

GLINT = sys.argv[-1]

CHECKS = [[[1.0, 0.2, 0.1, 1.0], [0.1, 0.8, 0.2, 1.0]], [[0.1, 0.2, 0.9, 1.0], [0.9, 0.9, 0.9, 1.0]]]


def sparkling_floor(width=48, height=36, samples=4):
    """A floor with flakes under a sun, seen from above at an angle."""
    scene = new_scene(width, height, samples)
    # About 100 flakes a pixel, of which a few mirror a sun behind the floor.
    material = flakes(density_per_cm2=20.0)
    floor = add_plane(material, 4.0)
    add_light("SUN", 3.0, rotation=(-0.9, 0.0, 0.0), angle=0.2)
    add_camera((0.0, -4.0, 3.0), (0.9, 0.0, 0.0))
    black_world()
    return scene, floor, material


def busy_scene():
    """A texture, flakes in both spaces, every kind of light, a lens; what the glTF exporter can say."""
    scene = new_scene(120, 90, 16)
    scene.glint.bounces = 1
    scene.render.film_transparent = True
    floor = add_plane(matte("floor"), 6.0)
    image = new_image("checks", CHECKS)
    image.pack()
    connect_image(floor.data.materials[0], image, "Base Color", interpolation="Closest")
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, location=(-0.8, 0.3, 1.0), rotation=(0.3, 0.2, 0.9))
    bpy.ops.object.shade_smooth()
    bpy.context.object.data.materials.append(flakes("ball", 300.0, space="OBJECT"))
    bpy.ops.mesh.primitive_cube_add(location=(1.2, -0.3, 0.6), size=1.2, rotation=(0.1, 0.2, 0.7))
    bpy.context.object.data.materials.append(flakes("cube", 30.0))
    bpy.ops.mesh.primitive_ico_sphere_add(location=(0.3, -1.5, 0.4), radius=0.4)
    bpy.context.object.data.materials.append(
        new_material("coated", Base_Color=(0.8, 0.1, 0.1, 1.0), Clearcoat=0.7, Clearcoat_Roughness=0.2, Specular=0.3)
    )
    add_light("SUN", 2.0, rotation=(0.6, 0.2, 0.1), angle=0.02)
    add_light("POINT", 100.0, (2.0, 2.0, 3.0), shadow_soft_size=0.2)
    add_light("SPOT", 200.0, (-2.0, -2.0, 4.0), (0.5, -0.4, 0.1), spot_size=1.0, spot_blend=0.4, shadow_soft_size=0.1)
    add_light("AREA", 50.0, (0.0, -2.0, 3.0), (0.7, 0.0, 0.0), shape="RECTANGLE", size=1.0, size_y=0.5)
    add_camera((0.5, -6.0, 3.0), (1.15, 0.0, 0.08), lens=40.0)
    return scene


@contextlib.contextmanager
def numbered_by(nodes):
    """Objects have the facets of the file's nodes: those of a number, where the engine takes a hash of the name."""
    from glint import scene_data

    before = scene_data.object_number
    scene_data.object_number = lambda instance, source: nodes[source.name]
    try:
        yield
    finally:
        scene_data.object_number = before


def export(path):
    """Names of the nodes of the glTF file that the scene becomes, with their numbers."""
    bpy.ops.export_scene.gltf(filepath=path, export_lights=True, export_cameras=True, convert_lighting_mode="COMPAT")
    with open(path, "rb") as file:
        file.seek(12)
        document = json.loads(file.read(struct.unpack("<I", file.read(8)[:4])[0]))
    return {node["name"]: number for number, node in enumerate(document["nodes"])}


class FinalRender(unittest.TestCase):
    def both(self, bounces):
        """The picture of the engine, and that of the command of the exported scene."""
        scene = busy_scene()
        scene.glint.bounces = bounces
        file = os.path.join(folder(), "same.glb")
        nodes = export(file)
        with numbered_by(nodes):
            ours = render("same")
        theirs = os.path.join(folder(), "same-by-command.exr")
        subprocess.run([GLINT, "render", file, "-o", theirs, "--size", "120x90", "--spp", "16", "--bounces", str(bounces)],
                       check=True, capture_output=True)
        return ours, read(theirs)

    def test_the_glint_command_makes_the_same_picture_of_the_exported_scene(self):
        """Both see the same triangles, texels and flakes, through matrices that were rounded on other ways: one part in
        1e7, which moves shades by a thousand times less than the bound. What stays are samples that pass the other side
        of an edge, and facets on the edge of being counted: fewer than one pixel in fifty has one."""
        ours, expected = self.both(0)
        floor = 1e-3 * expected[..., :3].mean()
        off = (numpy.abs(ours - expected) / (numpy.abs(expected) + floor)).max(axis=-1)
        print(f"off: median {numpy.median(off):.2g}, 98 % {numpy.quantile(off, 0.98):.2g}, worst {off.max():.2g}, "
              f"means {ours.mean() / expected.mean() - 1.0:.2g}; bit for bit {(off == 0.0).mean():.2f}")
        self.assertGreater(expected.std(), 0.1 * expected.mean())
        self.assertLess(numpy.median(off), 1e-6)
        self.assertLess(numpy.quantile(off, 0.98), 1e-4)
        self.assertLess(abs(ours.mean() / expected.mean() - 1.0), 1e-3)

    def test_indirect_light_is_the_same_but_for_its_noise(self):
        """Surfaces without flakes have no tangents in the engine, which does not need them, and so other random
        directions: the sum over all pixels may differ by four times the noise of their differences."""
        ours, expected = self.both(1)
        difference = (ours - expected)[..., :3].sum(axis=-1)
        sigmas = difference.sum() / math.sqrt((difference**2).sum())
        print(f"the sums differ by {sigmas:.2f} sigmas")
        self.assertLess(abs(sigmas), 4.0)
        self.assertLess(abs(difference.sum() / expected[..., :3].sum()), 0.01)

    def test_passes_reach_the_file(self):
        scene = new_scene(40, 30, 4)
        # A UV unit is the plane's side of 2 m.
        add_plane(flakes(density_per_cm2=1.0, uv_scale=2.0), 2.0)
        add_light("SUN", 3.0, angle=0.2)
        add_camera(type="ORTHO", ortho_scale=4.0)
        layer = bpy.context.view_layer
        layer.glint.use_smooth = layer.glint.use_count = layer.glint.use_probability = True
        layer.use_pass_normal = layer.use_pass_z = layer.use_pass_diffuse_color = True
        scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
        scene.render.filepath = os.path.join(folder(), "passes.exr")
        bpy.ops.render.render(write_still=True)
        got = read_channels(scene.render.filepath)
        normal = [got[f"{layer.name}.Normal.{axis}"] for axis in "XYZ"]
        inside, outside = (slice(10, 20), slice(15, 25)), (slice(0, 30), slice(0, 5))
        numpy.testing.assert_allclose(normal[2][inside], 1.0, atol=1e-6)
        numpy.testing.assert_allclose(normal[0][inside], 0.0, atol=1e-6)
        numpy.testing.assert_allclose(got[f"{layer.name}.Depth.Z"][inside], 5.0, rtol=1e-6)
        self.assertTrue((got[f"{layer.name}.Depth.Z"][outside] > 1e9).all())
        numpy.testing.assert_allclose(got[f"{layer.name}.DiffCol.R"][inside], 1.0, rtol=1e-6)
        # A pixel is .1 m wide.
        numpy.testing.assert_allclose(got[f"{layer.name}.Glint Count.X"][inside], 1e4 * 0.01, rtol=0.01)
        probability = got[f"{layer.name}.Glint Probability.X"]
        self.assertTrue(((probability >= 0.0) & (probability <= 1.0)).all() and probability.max() > 0.0)
        combined, smooth = got[f"{layer.name}.Combined.R"], got[f"{layer.name}.Glint Smooth.R"]
        self.assertLess(smooth[inside].std(), 0.1 * smooth[inside].mean())
        self.assertGreater(combined[inside].std(), smooth[inside].std())

    def test_a_border_is_a_part_of_the_whole(self):
        scene, _, _ = sparkling_floor()
        whole = render("whole")
        render_settings = scene.render
        render_settings.use_border, render_settings.use_crop_to_border = True, True
        render_settings.border_min_x, render_settings.border_max_x = 0.25, 0.8
        render_settings.border_min_y, render_settings.border_max_y = 0.3, 0.7
        part = render("part")
        left, bottom = 12, 10  # 0.25 * 48 and 0.3 * 36, cut
        self.assertEqual(part.shape[:2], (25 - bottom, 38 - left))
        numpy.testing.assert_array_equal(part, whole[10:25, 12:38])
        render_settings.use_crop_to_border = False
        framed = render("framed")
        self.assertEqual(framed.shape, whole.shape)
        numpy.testing.assert_array_equal(framed[10:25, 12:38], whole[10:25, 12:38])
        self.assertEqual(framed[:9].max(), 0.0)

    def test_three_frames_of_an_animation_move(self):
        scene, floor, _ = sparkling_floor()
        floor.keyframe_insert("location", frame=1)
        floor.location.x = 1.0
        floor.keyframe_insert("location", frame=3)
        scene.frame_start, scene.frame_end = 1, 3
        scene.render.filepath = os.path.join(folder(), "frame-####.exr")
        bpy.ops.render.render(animation=True)
        frames = [read(os.path.join(folder(), f"frame-{n:04d}.exr")) for n in (1, 2, 3)]
        alone = []
        for n in (1, 2, 3):
            scene.frame_set(n)
            alone.append(render(f"alone-{n}"))
        for frame, still in zip(frames, alone):
            numpy.testing.assert_array_equal(frame, still)
        # The floor leaves to the right, so that the left edge darkens from frame to frame.
        light = [frame[:, :12, 0].sum() for frame in frames]
        self.assertTrue(light[0] > light[1] > light[2], light)

    def test_keyframes_and_drivers_of_flakes_change_the_picture(self):
        scene, _, material = sparkling_floor()
        material.glint.keyframe_insert("seed", frame=1)
        material.glint.seed = 5
        material.glint.keyframe_insert("seed", frame=2)
        scene.frame_set(1)
        first = render("seed-1")
        scene.frame_set(2)
        second = render("seed-2")
        self.assertGreater(numpy.abs(first - second).max(), 0.1 * first.max())
        material.animation_data_clear()
        material.glint.seed = 0
        numpy.testing.assert_array_equal(render("seed-0"), first)
        material.driver_add("glint.factor").driver.expression = "0"
        bpy.context.view_layer.update()
        smooth = render("smooth")
        self.assertLess(smooth[..., 0].std(), first[..., 0].std())

    def test_a_scene_without_a_camera_is_an_error_that_says_so(self):
        new_scene()
        add_plane()
        with self.assertRaisesRegex(RuntimeError, "camera"):
            bpy.ops.render.render()

    def test_what_the_library_refuses_is_an_error_that_says_why(self):
        scene, _, material = sparkling_floor()
        material.glint.density_exponent = 9.0
        scene.glint.model = "EXPLICIT"
        with self.assertRaisesRegex(RuntimeError, "explicit model visits every facet"):
            bpy.ops.render.render()


def read_channels(path):
    """All channels of a multilayer EXR by name, by Blender's own compositor-free reader: oiiotool in Python's clothes."""
    names = subprocess.run(["oiiotool", "--info", "-v", path], check=True, capture_output=True, text=True).stdout
    names = [name.strip() for name in names.split("channel list:")[1].splitlines()[0].split(",")]
    out = {}
    for name in names:
        single = os.path.join(folder(), "channel.exr")
        subprocess.run(["oiiotool", path, "--ch", f"R={name},G={name},B={name}", "-d", "float", "-o", single], check=True)
        out[name] = read(single)[..., 0]
    return out


# ---- stopping and memory ----


class LongRuns(unittest.TestCase):
    def test_a_render_stops_when_blender_asks(self):
        scene, _, _ = sparkling_floor(512, 512, 4096)  # hours
        from glint.engine import GlintRenderEngine

        asked = time.monotonic() + 0.5
        before = GlintRenderEngine.shall_stop
        GlintRenderEngine.shall_stop = lambda self: time.monotonic() > asked
        try:
            bpy.ops.render.render()
        finally:
            GlintRenderEngine.shall_stop = before
        # Looking takes .05 s, a pixel of 4096 samples a tenth of a second; the rest is for a busy machine.
        self.assertLess(time.monotonic() - asked, 30.0)

    def test_200_renders_do_not_grow(self):
        """A render that kept its mesh, its tree or its picture would keep 100 kB and more: 18 MB in 180."""
        scene, floor, _ = sparkling_floor(32, 24, 1)
        floor.modifiers.new("fine", "SUBSURF").render_levels = 5
        floor.modifiers["fine"].subdivision_type = "SIMPLE"
        image = new_image("texture", numpy.ones((64, 64, 4)))
        connect_image(floor.data.materials[0], image, "Base Color")
        started = time.monotonic()
        sizes = {}
        for n in range(1, 201):
            bpy.ops.render.render()
            if n in (20, 200):
                sizes[n] = resident_mb()
        print(f"200 renders in {time.monotonic() - started:.1f} s: {sizes[20]:.1f} MB, then {sizes[200]:.1f} MB")
        self.assertLess(sizes[200] - sizes[20], 9.0)


def resident_mb():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") / 2**20


# ---- coming and going ----


class Registration(unittest.TestCase):
    def test_engine_and_panels_come_and_go(self):
        import addon_utils

        new_scene()
        for _ in range(2):
            self.assertIn("GLINT", bpy.types.RENDER_PT_output.COMPAT_ENGINES)
            addon_utils.disable("glint", default_set=True)
            self.assertNotIn("GLINT", bpy.types.RENDER_PT_output.COMPAT_ENGINES)
            self.assertFalse(hasattr(bpy.types.Scene, "glint") or hasattr(bpy.types.ViewLayer, "glint"))
            self.assertIsNotNone(addon_utils.enable("glint", default_set=True))
        bpy.context.scene.render.engine = "GLINT"

    def test_without_the_library_a_render_is_an_error_and_blender_goes_on(self):
        sparkling_floor()
        from glint import library

        library.load.cache_clear()
        os.environ["GLINT_PREVIEW_LIBRARY"] = "/no/such/library.so"
        try:
            with self.assertRaisesRegex(RuntimeError, "is not in /no/such/library.so"):
                bpy.ops.render.render()
        finally:
            del os.environ["GLINT_PREVIEW_LIBRARY"]
            library.load.cache_clear()
        self.assertGreater(render("again").max(), 0.0)


blender_case.run(FinalRender, LongRuns, Registration)
