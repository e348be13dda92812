# SPDX-License-Identifier: GPL-3.0-or-later
"""Where Blender's versions from 3.4 to 5 differ, and nowhere else.

What is there is asked for, never which version it is: a test gives these functions what later versions have.
"""

import importlib

import bpy

# ---- nodes ----


def add_socket(tree, in_out, kind, name):
    """A socket of a node group, "INPUT" or "OUTPUT"."""
    if hasattr(tree, "interface"):  # 4.0
        return tree.interface.new_socket(name=name, in_out=in_out, socket_type=kind)
    return (tree.inputs if in_out == "INPUT" else tree.outputs).new(kind, name)


def new_glossy(nodes):
    """A round glossy lobe."""
    try:
        return nodes.new("ShaderNodeBsdfGlossy")
    except RuntimeError:  # 4.0 made it one with the anisotropic lobe
        lobe = nodes.new("ShaderNodeBsdfAnisotropic")
        lobe.inputs["Anisotropy"].default_value = 0.0
        return lobe


def input_of(node, *names):
    """The first of these inputs that this version's node has, or None: names changed in 4.0."""
    return next((node.inputs[name] for name in names if name in node.inputs), None)


def specular_scale(node):
    """What a Principled BSDF that is no metal reflects head-on over its dial: 8 %; since 4.0 twice what its IOR gives."""
    if "Specular" in node.inputs:
        return 0.08
    ior = node.inputs["IOR"].default_value
    return 2.0 * ((ior - 1.0) / (ior + 1.0)) ** 2


def head_on_reflectance(node):
    return specular_scale(node) * input_of(node, "Specular", "Specular IOR Level").default_value


def set_head_on_reflectance(node, ior):
    """Makes the Principled BSDF reflect what a surface of this index does."""
    node.inputs["IOR"].default_value = ior
    dial = node.inputs.get("Specular")
    if dial is not None:
        dial.default_value = ((ior - 1.0) / (ior + 1.0)) ** 2 / 0.08
    else:  # 4.0
        node.inputs["Specular IOR Level"].default_value = 0.5


def keep_normals(material):
    """Cycles bends shading normals that reflect below the horizon; a flake's shall stay as it is."""
    settings = getattr(material, "cycles", None)
    if settings is not None and hasattr(settings, "use_bump_map_correction"):  # 4.1
        settings.use_bump_map_correction = False


# ---- glTF ----


def mend_numpy():
    """The glTF importer of 3.4 names numpy.bool, which numpy 1.24 took away."""
    import numpy

    if "bool" not in numpy.__dict__:
        numpy.bool = bool


def _lighting_mode(operator):
    """What keeps both ways from converting lights to lumens; its name changed in 3.6."""
    known = operator.get_rna_type().properties
    names = ("convert_lighting_mode", "export_import_convert_lighting_mode")
    return {name: "COMPAT" for name in names if name in known}


def import_gltf(path):
    mend_numpy()
    operator = bpy.ops.import_scene.gltf
    return operator(filepath=path, **_lighting_mode(operator))


def export_gltf(path, **settings):
    mend_numpy()
    operator = bpy.ops.export_scene.gltf
    known = operator.get_rna_type().properties
    settings = {name: value for name, value in settings.items() if name in known}
    return operator(filepath=path, **settings, **_lighting_mode(operator))


def gltf_module(*names):
    """The first of these modules of io_scene_gltf2 that there is: 4.3 dropped `gltf2_` from their names."""
    for name in names:
        try:
            return importlib.import_module("io_scene_gltf2." + name)
        except ImportError:
            continue
    raise ImportError(f"this version of io_scene_gltf2 has none of {', '.join(names)}")


def binary_data(data):
    """Bytes that the exporter puts into a buffer view."""
    module = gltf_module("io.exp.gltf2_io_binary_data", "io.exp.binary_data")
    # Since 4.2 a buffer view also says what it is for.
    try:
        return module.BinaryData(data)
    except TypeError:
        return module.BinaryData(data, None)


def imported_image(gltf, index):
    """Blender's image of an image of the file that is being imported."""
    module = gltf_module("blender.imp.gltf2_blender_image", "blender.imp.image")
    module.BlenderImage.create(gltf, index)
    return bpy.data.images[gltf.data.images[index].blender_image_name]


# ---- meshes ----


def corner_normals(mesh):
    """Normals of the corners of all faces, a row each."""
    import numpy

    values = numpy.empty(3 * len(mesh.loops), numpy.float32)
    if hasattr(mesh, "corner_normals"):  # 4.1
        mesh.corner_normals.foreach_get("vector", values)
    else:
        mesh.calc_normals_split()
        mesh.loops.foreach_get("normal", values)
    return values.reshape(-1, 3)


def uv_arrays(layer, count):
    """u and v of every corner of a UV layer."""
    import numpy

    out = numpy.empty(2 * count, numpy.float32)
    if hasattr(layer, "uv"):  # 3.5
        layer.uv.foreach_get("vector", out)
    else:
        layer.data.foreach_get("uv", out)
    return out.reshape(count, 2)


# ---- the add-on ----


def engine_has_init():
    """RenderEngine.__init__ exists for Python since 4.4, and must then be called."""
    return bpy.app.version >= (4, 4, 0)


def preferences(context, package):
    """The add-on's preferences, or None while it is not enabled: since 4.2 an extension's name has its repository in
    front."""
    known = context.preferences.addons.get(package)
    return known.preferences if known is not None else None
