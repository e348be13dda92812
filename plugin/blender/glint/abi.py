# SPDX-License-Identifier: GPL-3.0-or-later
# Made by make_abi.py from glint_preview.h. Do not edit.
"""The C interface of libglint_preview: structs with their defaults, constants, and functions of a library that speaks it."""

import ctypes

ABI = 1
OK = 0
BAD_INPUT = 1
CANCELLED = 2
OTHER_MESHES = 3
LIGHT_SUN = 0
LIGHT_POINT = 1
LIGHT_SPOT = 2
LIGHT_RECT = 3
LIGHT_DISK = 4
MATERIALS = 1
IMAGES = 2
LIGHTS = 4
WORLD = 8
PERSPECTIVE = 0
ORTHOGRAPHIC = 1
COMBINED = 0
SMOOTH = 1
GLINT_COUNT = 2
GLINT_PROBABILITY = 3
NORMAL = 4
ALBEDO = 5
DEPTH = 6


class Image(ctypes.Structure):
    NAME = "glint_preview_image"
    _fields_ = [
        ("size", ctypes.c_size_t),
        ("name", ctypes.c_char_p),
        ("path", ctypes.c_char_p),
        ("bytes", ctypes.POINTER(ctypes.c_uint8)),
        ("byte_count", ctypes.c_size_t),
        ("pixels", ctypes.POINTER(ctypes.c_float)),
        ("width", ctypes.c_int32),
        ("height", ctypes.c_int32),
    ]

    def __init__(self, **values):
        super().__init__()
        self.size = ctypes.sizeof(self)
        for name, value in values.items():
            setattr(self, name, value)


class Mesh(ctypes.Structure):
    NAME = "glint_preview_mesh"
    _fields_ = [
        ("size", ctypes.c_size_t),
        ("name", ctypes.c_char_p),
        ("vertex_count", ctypes.c_uint32),
        ("triangle_count", ctypes.c_uint32),
        ("positions", ctypes.POINTER(ctypes.c_float)),
        ("normals", ctypes.POINTER(ctypes.c_float)),
        ("tangents", ctypes.POINTER(ctypes.c_float)),
        ("texcoords", ctypes.POINTER(ctypes.c_float) * 2),
        ("colors", ctypes.POINTER(ctypes.c_float)),
        ("indices", ctypes.POINTER(ctypes.c_uint32)),
        ("materials", ctypes.POINTER(ctypes.c_int32)),
    ]

    def __init__(self, **values):
        super().__init__()
        self.size = ctypes.sizeof(self)
        for name, value in values.items():
            setattr(self, name, value)


class Light(ctypes.Structure):
    NAME = "glint_preview_light"
    _fields_ = [
        ("size", ctypes.c_size_t),
        ("kind", ctypes.c_int32),
        ("color", ctypes.c_float * 3),
        ("intensity", ctypes.c_float),
        ("range_m", ctypes.c_float),
        ("inner_cone_rad", ctypes.c_float),
        ("outer_cone_rad", ctypes.c_float),
        ("angular_diameter_rad", ctypes.c_float),
        ("radius_m", ctypes.c_float),
        ("width_m", ctypes.c_float),
        ("height_m", ctypes.c_float),
        ("to_world", ctypes.c_float * 16),
    ]

    def __init__(self, **values):
        super().__init__()
        self.size = ctypes.sizeof(self)
        self.kind = LIGHT_SUN
        self.color = (1, 1, 1,)
        self.intensity = 1
        self.outer_cone_rad = 0.785398
        self.angular_diameter_rad = 0.00929
        self.radius_m = 0.01
        self.width_m = 1
        self.height_m = 1
        self.to_world = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,)
        for name, value in values.items():
            setattr(self, name, value)


class World(ctypes.Structure):
    NAME = "glint_preview_world"
    _fields_ = [
        ("size", ctypes.c_size_t),
        ("color", ctypes.c_float * 3),
        ("map", ctypes.POINTER(ctypes.c_float)),
        ("map_width", ctypes.c_int32),
        ("map_height", ctypes.c_int32),
        ("map_rotation", ctypes.c_float * 4),
        ("map_scale", ctypes.c_float),
    ]

    def __init__(self, **values):
        super().__init__()
        self.size = ctypes.sizeof(self)
        self.map_rotation = (0, 0, 0, 1,)
        self.map_scale = 1
        for name, value in values.items():
            setattr(self, name, value)


class SceneOptions(ctypes.Structure):
    NAME = "glint_preview_scene_options"
    _fields_ = [
        ("size", ctypes.c_size_t),
        ("images", ctypes.POINTER(Image)),
        ("image_count", ctypes.c_size_t),
        ("materials", ctypes.c_char_p),
        ("meshes", ctypes.POINTER(Mesh)),
        ("mesh_count", ctypes.c_size_t),
        ("instance_count", ctypes.c_size_t),
        ("instance_to_world", ctypes.POINTER(ctypes.c_float)),
        ("instance_mesh", ctypes.POINTER(ctypes.c_int32)),
        ("instance_object", ctypes.POINTER(ctypes.c_int32)),
        ("lights", ctypes.POINTER(Light)),
        ("light_count", ctypes.c_size_t),
        ("world", World),
        ("model", ctypes.c_int32),
        ("exact_lights", ctypes.c_int32),
    ]

    def __init__(self, **values):
        super().__init__()
        self.size = ctypes.sizeof(self)
        self.world = World()
        self.model = -1
        for name, value in values.items():
            setattr(self, name, value)


class Camera(ctypes.Structure):
    NAME = "glint_preview_camera"
    _fields_ = [
        ("size", ctypes.c_size_t),
        ("projection", ctypes.c_int32),
        ("left", ctypes.c_float),
        ("right", ctypes.c_float),
        ("bottom", ctypes.c_float),
        ("top", ctypes.c_float),
        ("near_m", ctypes.c_float),
        ("far_m", ctypes.c_float),
        ("to_world", ctypes.c_float * 16),
    ]

    def __init__(self, **values):
        super().__init__()
        self.size = ctypes.sizeof(self)
        self.projection = PERSPECTIVE
        self.left = -0.5
        self.right = 0.5
        self.bottom = -0.5
        self.top = 0.5
        self.near_m = 0.01
        self.to_world = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,)
        for name, value in values.items():
            setattr(self, name, value)


class PictureOptions(ctypes.Structure):
    NAME = "glint_preview_picture_options"
    _fields_ = [
        ("size", ctypes.c_size_t),
        ("camera", ctypes.POINTER(Camera)),
        ("width", ctypes.c_int32),
        ("height", ctypes.c_int32),
        ("part_left", ctypes.c_int32),
        ("part_top", ctypes.c_int32),
        ("part_width", ctypes.c_int32),
        ("part_height", ctypes.c_int32),
        ("samples", ctypes.c_int32),
        ("bounces", ctypes.c_int32),
        ("threads", ctypes.c_int32),
        ("seed", ctypes.c_uint32),
        ("passes", ctypes.c_int32),
        ("transparent", ctypes.c_int32),
        ("accuracy", ctypes.c_float),
    ]

    def __init__(self, **values):
        super().__init__()
        self.size = ctypes.sizeof(self)
        self.width = 640
        self.height = 360
        self.samples = 16
        self.bounces = 1
        self.passes = 1
        for name, value in values.items():
            setattr(self, name, value)


STRUCTS = (Image, Mesh, Light, World, SceneOptions, Camera, PictureOptions)

# Result and arguments.
FUNCTIONS = {
    "glint_preview_abi": (ctypes.c_uint32, []),
    "glint_preview_version": (ctypes.c_char_p, []),
    "glint_preview_size_of": (ctypes.c_size_t, [ctypes.c_char_p]),
    "glint_preview_scene_create": (ctypes.c_int, [ctypes.POINTER(SceneOptions), ctypes.POINTER(ctypes.c_void_p), ctypes.c_char_p, ctypes.c_size_t]),
    "glint_preview_scene_change": (ctypes.c_int, [ctypes.c_void_p, ctypes.c_int32, ctypes.POINTER(SceneOptions), ctypes.c_char_p, ctypes.c_size_t]),
    "glint_preview_scene_warnings": (ctypes.c_char_p, [ctypes.c_void_p]),
    "glint_preview_scene_destroy": (None, [ctypes.c_void_p]),
    "glint_preview_plan": (ctypes.c_int, [ctypes.c_void_p, ctypes.POINTER(PictureOptions), ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]),
    "glint_preview_picture_create": (ctypes.c_int, [ctypes.c_void_p, ctypes.POINTER(PictureOptions), ctypes.POINTER(ctypes.c_void_p), ctypes.c_char_p, ctypes.c_size_t]),
    "glint_preview_picture_samples": (ctypes.c_int32, [ctypes.c_void_p]),
    "glint_preview_picture_refine": (ctypes.c_int, [ctypes.c_void_p, ctypes.c_int32, ctypes.c_char_p, ctypes.c_size_t]),
    "glint_preview_picture_cancel": (None, [ctypes.c_void_p, ctypes.c_int32]),
    "glint_preview_picture_progress": (ctypes.c_double, [ctypes.c_void_p]),
    "glint_preview_picture_read": (ctypes.c_int, [ctypes.c_void_p, ctypes.c_int32, ctypes.c_int32, ctypes.POINTER(ctypes.c_float), ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]),
    "glint_preview_picture_destroy": (None, [ctypes.c_void_p]),
}


def load(path):
    """The library at a path, its functions declared. Raises OSError for one that does not load or speaks another ABI."""
    library = ctypes.CDLL(path)
    try:
        for name, (result, arguments) in FUNCTIONS.items():
            function = getattr(library, name)
            function.restype, function.argtypes = result, arguments
    except AttributeError as problem:
        raise OSError(f"{path}: {problem}") from problem
    if library.glint_preview_abi() != ABI:
        raise OSError(f"{path}: found ABI {library.glint_preview_abi()}, expected {ABI}")
    for struct in STRUCTS:
        found, expected = library.glint_preview_size_of(struct.NAME.encode()), ctypes.sizeof(struct)
        if found != expected:
            raise OSError(f"{path}: found {found} bytes in {struct.NAME}, expected {expected}")
    return library


def array_of(struct, items):
    """An array of structs for a pointer and a count; None for none."""
    return (struct * len(items))(*items) if items else None


def pointer(values, kind):
    """The address of a contiguous numpy array of that kind ("float", "int32_t", ...); None stays None. The array must
    live as long as the pointer is used."""
    if values is None:
        return None
    kinds = {"float": ("float32", ctypes.c_float), "int32_t": ("int32", ctypes.c_int32),
             "uint32_t": ("uint32", ctypes.c_uint32), "uint8_t": ("uint8", ctypes.c_uint8)}
    name, scalar = kinds[kind]
    if values.dtype != name or not values.flags.c_contiguous:
        raise TypeError(f"found an array of {values.dtype}, expected a contiguous one of {name}")
    return values.ctypes.data_as(ctypes.POINTER(scalar))
