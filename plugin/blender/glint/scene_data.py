# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender scene as arrays for libglint_preview: meshes, instances and lights of an evaluated depsgraph.

Axes are turned as the glTF exporter turns them, objects and world alike: x, y, z become x, z, -y. Lengths are metres: those
of Blender times the scene's unit scale.
"""

import dataclasses
import math
import zlib
from typing import Optional

import bpy
import numpy

from . import abi, area_lights, compat
from .scene_materials import Materials
from .scene_world import World, world_of

# From z up to y up, for columns.
TURN = numpy.array(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)), numpy.float64)


@dataclasses.dataclass
class Mesh:
    name: str
    positions: numpy.ndarray  # n x 3
    normals: numpy.ndarray
    texcoords: tuple  # two of n x 2, or None
    indices: numpy.ndarray  # 3 a triangle
    materials: numpy.ndarray  # 1 a triangle


@dataclasses.dataclass
class Description:
    """What library.Scene wants. Nothing of it refers to Blender's data, so that it may go to another thread."""

    meshes: list
    instance_to_world: numpy.ndarray
    instance_mesh: numpy.ndarray
    instance_object: numpy.ndarray
    lights: list
    world: World
    materials: str
    images: list
    warnings: list
    model: int = -1  # of the library, for every material; -1: for each the one that shows what it asks for


class Cache:
    """What stays the same from one view of a scene to the next: arrays of meshes, pixels of images. Forget what has
    changed."""

    def __init__(self):
        self.geometry, self.images = {}, {}

    def forget_geometry(self):
        self.geometry.clear()

    def forget_images(self):
        self.images.clear()


@dataclasses.dataclass
class Geometry:
    """Arrays of a mesh before materials are known."""

    positions: numpy.ndarray
    normals: numpy.ndarray
    texcoords: tuple
    indices: numpy.ndarray
    slots: numpy.ndarray
    uv_names: tuple
    active_uv: int


def y_up(vectors):
    """Rows x y z as rows x z -y."""
    turned = numpy.empty_like(vectors)
    turned[:, 0], turned[:, 1] = vectors[:, 0], vectors[:, 2]
    numpy.negative(vectors[:, 1], out=turned[:, 2])
    return turned


def to_world(matrix, scale, turn_object):
    """A matrix of Blender's in our axes and metres, column by column. Cameras and lights keep their own axes: both
    programs have them look along -z."""
    m = TURN @ numpy.array(matrix, numpy.float64)
    if turn_object:
        m = m @ TURN.T
    m[:3, :] *= scale
    return m.T.astype(numpy.float32).ravel()


def object_number(instance, source):
    """Which flakes an object has: the same in every frame, others for every object and every copy of one."""
    number = zlib.crc32(source.name.encode())
    if instance.is_instance:
        number ^= instance.random_id
    return number & 0x7FFFFFFF


# ---- meshes ----


def _get(collection, attribute, kind, width=1):
    values = numpy.empty(len(collection) * width, kind)
    collection.foreach_get(attribute, values)
    return values.reshape(-1, width) if width > 1 else values


def _texcoords(mesh, layer):
    uv = compat.uv_arrays(layer, len(mesh.loops))
    numpy.subtract(1.0, uv[:, 1], out=uv[:, 1])
    return uv


def _slots(mesh):
    """Slots of the materials of triangles; unsigned, since Blender has a fast way for its own type only."""
    if len(mesh.materials) <= 1:
        return numpy.zeros(len(mesh.loop_triangles), numpy.uint32)
    return _get(mesh.loop_triangles, "material_index", numpy.uint32)


def geometry_of(mesh):
    """Corners become vertices: normals and texture coordinates belong to corners."""
    mesh.calc_loop_triangles()
    normals = compat.corner_normals(mesh)
    vertex_of_corner = _get(mesh.loops, "vertex_index", numpy.uint32)
    positions = y_up(_get(mesh.vertices, "co", numpy.float32, 3))
    layers = list(mesh.uv_layers)[:2]
    active = next((i for i, layer in enumerate(mesh.uv_layers) if layer.active_render), 0)
    texcoords = [_texcoords(mesh, layer) for layer in layers] + [None, None]
    return Geometry(
        positions=numpy.take(positions, vertex_of_corner, axis=0),
        normals=y_up(normals),
        texcoords=tuple(texcoords[:2]),
        indices=_get(mesh.loop_triangles, "loops", numpy.uint32, 3).ravel(),
        slots=_slots(mesh),
        uv_names=tuple(layer.name for layer in layers),
        active_uv=min(active, 1),
    )


class Builder:
    """Walks over the depsgraph once."""

    def __init__(self, depsgraph, cache):
        self.depsgraph, self.cache = depsgraph, cache
        self.scale = depsgraph.scene.unit_settings.scale_length
        self.warnings = []
        self.materials = Materials(cache.images, self.warn)
        self.meshes, self.mesh_numbers = [], {}
        self.placed, self.lights = [], []

    def warn(self, text):
        if text not in self.warnings:
            self.warnings.append(text)

    def geometry(self, source):
        # What modifiers and nodes make is data of its own.
        key = source.data.as_pointer()
        if key not in self.cache.geometry:
            # A mesh under edit lies elsewhere, and only a copy has it.
            mesh = source.to_mesh() if source.data.is_editmode else source.data
            self.cache.geometry[key] = geometry_of(mesh) if len(mesh.polygons) > 0 else None
            if source.data.is_editmode:
                source.to_mesh_clear()
        return key, self.cache.geometry[key]

    def mesh_number(self, source):
        """The place of the object's mesh with its materials; None where there is nothing to see."""
        key, geometry = self.geometry(source)
        if geometry is None:
            return None
        slots = [slot.material for slot in source.material_slots] or [None]
        numbers = tuple(self.materials.add(m, geometry.uv_names, geometry.active_uv) for m in slots)
        if (key, numbers) not in self.mesh_numbers:
            self.mesh_numbers[key, numbers] = len(self.meshes)
            of_slot = numpy.array(numbers, numpy.int32)
            self.meshes.append(Mesh(
                source.name, geometry.positions, geometry.normals, geometry.texcoords, geometry.indices,
                numpy.take(of_slot, geometry.slots, mode="clip"),
            ))
        return self.mesh_numbers[key, numbers]

    def add_surface(self, instance, source):
        if source.is_holdout:
            self.warn(f"{source.name}: holdouts are rendered like other objects")
        if not source.visible_camera or not source.visible_shadow:
            self.warn(f"{source.name}: is seen by every ray; ray visibility is not read")
        number = self.mesh_number(source)
        if number is not None:
            matrix = to_world(instance.matrix_world, self.scale, turn_object=True)
            self.placed.append((number, object_number(instance, source), matrix))

    def add(self, instance):
        source = instance.object
        if not instance.show_self:
            return
        # What curves, text and metaballs evaluate to comes as a mesh of its own.
        if isinstance(source.data, bpy.types.Mesh):
            self.add_surface(instance, source)
        elif source.type == "LIGHT":
            self.lights.append(light_of(source.data, instance.matrix_world, self.scale, self.warn))
        elif source.type in {"VOLUME", "CURVES", "POINTCLOUD", "GPENCIL"}:
            self.warn(f"{source.name}: objects of type {source.type} are not rendered")

    def description(self):
        for instance in self.depsgraph.object_instances:
            self.add(instance)
        world = world_of(self.depsgraph.scene.world, self.cache.images, self.warn)
        matrices = [matrix for _, _, matrix in self.placed]
        return Description(
            meshes=self.meshes,
            instance_to_world=numpy.concatenate(matrices) if matrices else numpy.empty(0, numpy.float32),
            instance_mesh=numpy.array([number for number, _, _ in self.placed], numpy.int32),
            instance_object=numpy.array([number for _, number, _ in self.placed], numpy.int32),
            lights=self.lights,
            world=world,
            materials=self.materials.text(),
            images=self.materials.images,
            warnings=self.warnings,
        )


def describe(depsgraph, cache=None, model=-1):
    """The scene of a depsgraph."""
    made = Builder(depsgraph, cache or Cache()).description()
    made.model = model
    return made


# ---- lights ----


def light_of(light, matrix, scale, warn):
    """Watts as Cycles means them: a point of P watts has the intensity P / (4 pi), a flat light of area A the radiance P /
    (4 A), a sun its irradiance.

    Brightness is that of the same numbers in Cycles whatever the unit scale is: lengths shrink to metres, and intensities
    with their square.
    """
    if light.use_nodes and light.node_tree is not None:
        warn(f"{light.name}: nodes of lights are not read; colour and power are those of the light")
    made = abi.Light(color=tuple(light.color), to_world=tuple(to_world(matrix, scale, turn_object=False)))
    if light.type == "SUN":
        made.kind, made.intensity, made.angular_diameter_rad = abi.LIGHT_SUN, light.energy, light.angle
        return made
    if light.type == "AREA":
        return _area_light(made, light, matrix, scale)
    made.kind = abi.LIGHT_SPOT if light.type == "SPOT" else abi.LIGHT_POINT
    made.intensity = light.energy / (4.0 * math.pi) * scale * scale
    made.radius_m = light.shadow_soft_size * scale
    if light.type == "SPOT":
        made.outer_cone_rad = 0.5 * light.spot_size
        # A cone without a soft edge still has one of a thousandth: they may not be equal.
        made.inner_cone_rad = made.outer_cone_rad * min(1.0 - light.spot_blend, 0.999)
    return made


def _area_light(made, light, matrix, scale):
    width, height = area_lights.sides(light)
    is_round = light.shape in area_lights.ROUND
    across, along = matrix.col[0].to_3d().length, matrix.col[1].to_3d().length
    width, height = width * across, height * along
    made.kind = abi.LIGHT_DISK if is_round else abi.LIGHT_RECT
    made.width_m, made.height_m = width * scale, height * scale
    area = area_lights.area(width, height, is_round)
    made.intensity = light.energy / (area_lights.WATTS_PER_RADIANCE * area) if area > 0.0 else 0.0
    return made
