# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes and pictures of libglint_preview as Python objects that hold numpy arrays. The calls release the GIL, so that C
works beside Blender's main thread."""

import ctypes
import functools
import os

import numpy

from . import abi

NAME = "libglint_preview.so"

CHANNELS = {abi.COMBINED: 4, abi.SMOOTH: 3, abi.GLINT_COUNT: 1, abi.GLINT_PROBABILITY: 1, abi.NORMAL: 3, abi.ALBEDO: 3,
            abi.DEPTH: 1}


# Room for a few thousand decisions.
PLAN_BYTES = 1 << 20


class GlintError(RuntimeError):
    """What the library cannot render, in its own words."""


def places():
    """Where the library may be: the caller's choice, inside the add-on, or built in this checkout."""
    here = os.path.dirname(os.path.realpath(__file__))
    chosen = os.environ.get("GLINT_PREVIEW_LIBRARY")
    built = os.path.join(here, "..", "..", "..", "build", "release", "lib", NAME)
    return [chosen] if chosen else [os.path.join(here, "lib", NAME), os.path.normpath(built)]


@functools.lru_cache(maxsize=None)
def load():
    """The library, loaded once a process: the dynamic linker keeps no second copy either."""
    found = [path for path in places() if os.path.exists(path)]
    if not found:
        raise GlintError(f"{NAME} is not in {' or '.join(places())}: the render engine needs it")
    try:
        return abi.load(found[0])
    except OSError as problem:
        raise GlintError(str(problem)) from problem


def _call(function, *arguments):
    """Calls a function that ends with a message; its result unless that is a failure."""
    message = ctypes.create_string_buffer(1024)
    result = function(*arguments, message, len(message))
    if result == abi.BAD_INPUT:
        raise GlintError(message.value.decode("utf-8", "replace"))
    return result


def _text(text):
    return text.encode("utf-8", "replace")


class Scene:
    """A description (scene_data.Description), copied and made ready for rays."""

    def __init__(self, description):
        self.handle = ctypes.c_void_p()
        self._library = load()
        options = _options(description, with_meshes=True)
        _call(self._library.glint_preview_scene_create, ctypes.byref(options), ctypes.byref(self.handle))

    def change(self, description, parts):
        """Puts parts of another description in the place of this one's, while the meshes stay. Its pictures must be closed. False:
        it takes a new scene; this one is as it was."""
        options = _options(description, with_meshes=False)
        result = _call(self._library.glint_preview_scene_change, self.handle, parts, ctypes.byref(options))
        return result != abi.OTHER_MESHES

    @property
    def warnings(self):
        return self._library.glint_preview_scene_warnings(self.handle).decode("utf-8", "replace").splitlines()

    def close(self):
        """Its pictures must be closed."""
        self._library.glint_preview_scene_destroy(self.handle)
        self.handle = ctypes.c_void_p()


def _options(description, with_meshes):
    meshes = abi.array_of(abi.Mesh, [_mesh(mesh) for mesh in description.meshes]) if with_meshes else None
    images = abi.array_of(abi.Image, [_image(image) for image in description.images])
    options = abi.SceneOptions(
        images=images, image_count=len(description.images), materials=_text(description.materials),
        lights=abi.array_of(abi.Light, description.lights), light_count=len(description.lights),
        world=_world(description.world), model=description.model,
        exact_lights=int(description.exact_lights),
    )
    if with_meshes:
        options.meshes, options.mesh_count = meshes, len(description.meshes)
        options.instance_count = len(description.instance_mesh)
        options.instance_to_world = abi.pointer(description.instance_to_world, "float")
        options.instance_mesh = abi.pointer(description.instance_mesh, "int32_t")
        options.instance_object = abi.pointer(description.instance_object, "int32_t")
    return options


def _mesh(mesh):
    return abi.Mesh(
        name=_text(mesh.name), vertex_count=len(mesh.positions), triangle_count=len(mesh.indices) // 3,
        positions=abi.pointer(mesh.positions, "float"), normals=abi.pointer(mesh.normals, "float"),
        texcoords=tuple(abi.pointer(uv, "float") for uv in mesh.texcoords), indices=abi.pointer(mesh.indices, "uint32_t"),
        materials=abi.pointer(mesh.materials, "int32_t"),
    )


def _image(image):
    if image.path is not None:
        return abi.Image(name=_text(image.name), path=os.fsencode(image.path))
    if image.data is not None:
        data = numpy.frombuffer(image.data, numpy.uint8)
        return abi.Image(name=_text(image.name), bytes=abi.pointer(data, "uint8_t"), byte_count=len(data))
    height, width, _ = image.pixels.shape
    return abi.Image(name=_text(image.name), pixels=abi.pointer(image.pixels, "float"), width=width, height=height)


def _world(world):
    if world.map is None:
        return abi.World(color=tuple(world.color))
    height, width, _ = world.map.shape
    return abi.World(map=abi.pointer(world.map, "float"), map_width=width, map_height=height,
                     map_rotation=tuple(world.rotation), map_scale=world.scale)


def plan(scene, camera, width, height, **options):
    """What a picture would do and leave out, as glint_preview_plan says it: lines of fields."""
    wanted = abi.PictureOptions(camera=ctypes.pointer(camera), width=width, height=height, **options)
    text = ctypes.create_string_buffer(PLAN_BYTES)
    _call(load().glint_preview_plan, scene.handle, ctypes.byref(wanted), text, len(text))
    return [line.split("\t") for line in text.value.decode("utf-8", "replace").splitlines()]


class Picture:
    """A picture that grows. One thread at a time refines and reads it; any may cancel it or ask how far it is."""

    def __init__(self, scene, camera, width, height, part=None, **options):
        self.handle = ctypes.c_void_p()
        self._library = load()
        left, top, part_width, part_height = part or (0, 0, width, height)
        self.width, self.height = part_width, part_height
        wanted = abi.PictureOptions(camera=ctypes.pointer(camera), width=width, height=height, part_left=left, part_top=top,
                                    part_width=part_width, part_height=part_height, **options)
        _call(self._library.glint_preview_picture_create, scene.handle, ctypes.byref(wanted), ctypes.byref(self.handle))

    def refine(self, samples):
        """False: cancelled."""
        return _call(self._library.glint_preview_picture_refine, self.handle, samples) == abi.OK

    def cancel(self):
        self._library.glint_preview_picture_cancel(self.handle, 1)

    @property
    def samples(self):
        """Of a pixel in the end."""
        return self._library.glint_preview_picture_samples(self.handle)

    @property
    def progress(self):
        return self._library.glint_preview_picture_progress(self.handle)

    def read(self, which):
        """A pass as an array with a row a pixel, as Blender wants it: the lowest row of the picture first."""
        values = numpy.empty((self.width * self.height, CHANNELS[which]), numpy.float32)
        _call(self._library.glint_preview_picture_read, self.handle, which, 1, abi.pointer(values, "float"), values.size)
        return values

    def close(self):
        self._library.glint_preview_picture_destroy(self.handle)
        self.handle = ctypes.c_void_p()
