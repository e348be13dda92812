# SPDX-License-Identifier: GPL-3.0-or-later
"""Where Blender's versions from 3.4 to 5 differ, and nowhere else."""

import bpy


def add_output(tree, kind, name):
    """An output of a node group."""
    if hasattr(tree, "interface"):  # 4.0
        return tree.interface.new_socket(name=name, in_out="OUTPUT", socket_type=kind)
    return tree.outputs.new(kind, name)


def keep_normals(material):
    """Cycles bends shading normals that reflect below the horizon; a flake's shall stay as it is."""
    settings = getattr(material, "cycles", None)
    if settings is not None and hasattr(settings, "use_bump_map_correction"):  # 4.1
        settings.use_bump_map_correction = False


def mend_numpy():
    """The glTF importer of 3.4 names numpy.bool, which numpy 1.24 took away."""
    import numpy

    if "bool" not in numpy.__dict__:
        numpy.bool = bool


def import_gltf(path):
    """Opens a glTF file; lights come without conversion to lumens."""
    mend_numpy()
    settings = {"filepath": path}
    properties = bpy.ops.import_scene.gltf.get_rna_type().properties
    for name in ("convert_lighting_mode", "export_import_convert_lighting_mode"):
        if name in properties:
            settings[name] = "COMPAT"
    return bpy.ops.import_scene.gltf(**settings)


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


def uv_values(layer, corner_count):
    """Texture coordinates of the corners of all faces, a row each."""
    import numpy

    values = numpy.empty(2 * corner_count, numpy.float32)
    if hasattr(layer, "uv"):  # 3.5
        layer.uv.foreach_get("vector", values)
    else:
        layer.data.foreach_get("uv", values)
    return values.reshape(-1, 2)



def engine_has_init():
    """RenderEngine.__init__ exists for Python since 4.4, and must then be called."""
    return bpy.app.version >= (4, 4, 0)
