# SPDX-License-Identifier: GPL-3.0-or-later
"""What is another one from a description of a scene to the next: all of it, or parts that can change while meshes stay."""

import numpy

from . import abi

NOTHING = 0
LOOKS = abi.MATERIALS | abi.IMAGES | abi.LIGHTS | abi.WORLD


def _same_mesh(a, b):
    """Arrays come from a cache that forgets what has changed, so that they need not be compared; materials do not."""
    kept = all(x is y for x, y in zip((a.positions, a.normals, a.indices, *a.texcoords),
                                      (b.positions, b.normals, b.indices, *b.texcoords)))
    return kept and numpy.array_equal(a.materials, b.materials)


def _same_ground(a, b):
    return (
        len(a.meshes) == len(b.meshes)
        and all(numpy.array_equal(getattr(a, name), getattr(b, name))
                for name in ("instance_to_world", "instance_mesh", "instance_object"))
        and all(_same_mesh(x, y) for x, y in zip(a.meshes, b.meshes))
    )


def _same_images(a, b):
    return len(a) == len(b) and all(x is y for x, y in zip(a, b))


def _same_lights(a, b):
    return len(a) == len(b) and all(bytes(x) == bytes(y) for x, y in zip(a, b))


def _same_world(a, b):
    return a.map is b.map and (a.color, a.rotation, a.scale) == (b.color, b.rotation, b.scale)


def changed_parts(before, after):
    """Of two descriptions: a sum of parts as the library counts them, NOTHING for the same scene; None: other meshes or places."""
    if not _same_ground(before, after):
        return None
    parts = NOTHING
    if not _same_images(before.images, after.images):
        parts |= abi.MATERIALS | abi.IMAGES
    if (before.materials, before.model) != (after.materials, after.model):
        parts |= abi.MATERIALS
    if not _same_lights(before.lights, after.lights):
        parts |= abi.LIGHTS
    if not _same_world(before.world, after.world):
        parts |= abi.WORLD
    return parts
