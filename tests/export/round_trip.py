"""Blender's own importer and exporter on files of `glint export gltf`: geometry and base material survive both ways.

blender -b --factory-startup --python-exit-code 3 -P round_trip.py -- FILE OUT.glb
The importer knows nothing of GLINT_materials_glint and drops it; what it must not do is trip over it.
"""
import json
import struct
import sys

import numpy

numpy.bool = bool  # the importer of Blender 3.4 uses a name that numpy 1.24 dropped

import bpy  # noqa: E402


def read_json(path):
    data = open(path, "rb").read()
    if data[:4] != b"glTF":
        return json.loads(data)
    length, = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + length])


def shape(gltf):
    """What both files must agree in: triangles, extents, base materials."""
    accessors, triangles, low, high = gltf["accessors"], 0, [], []
    for mesh in gltf["meshes"]:
        for primitive in mesh["primitives"]:
            position = accessors[primitive["attributes"]["POSITION"]]
            indices = primitive.get("indices")
            triangles += (position if indices is None else accessors[indices])["count"] // 3
            low.append(position["min"])
            high.append(position["max"])
    return triangles, numpy.min(low, axis=0), numpy.max(high, axis=0)


def base(material):
    pbr = material.get("pbrMetallicRoughness", {})
    return (*pbr.get("baseColorFactor", (1, 1, 1, 1)), pbr.get("metallicFactor", 1), pbr.get("roughnessFactor", 1))


def clear_coat(material):
    coat = material.get("extensions", {}).get("KHR_materials_clearcoat", {})
    return coat.get("clearcoatFactor", 0), coat.get("clearcoatRoughnessFactor", 0)


def principled(name):
    node = bpy.data.materials[name].node_tree.nodes["Principled BSDF"]
    inputs = node.inputs
    return (*inputs["Base Color"].default_value, inputs["Metallic"].default_value, inputs["Roughness"].default_value)


def main(source, target):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=source)
    before = read_json(source)
    for material in before["materials"]:
        numpy.testing.assert_allclose(principled(material["name"]), base(material), atol=1e-6, err_msg=material["name"])

    bpy.ops.export_scene.gltf(filepath=target, export_format="GLB", export_tangents=True)
    after = read_json(target)
    assert shape(before)[0] == shape(after)[0], (shape(before), shape(after))
    numpy.testing.assert_allclose(shape(before)[1:], shape(after)[1:], atol=1e-5)
    known = {material["name"]: material for material in after["materials"]}
    for material in before["materials"]:
        found = known[material["name"]]
        numpy.testing.assert_allclose(base(found), base(material), atol=1e-5)
        numpy.testing.assert_allclose(clear_coat(found), clear_coat(material), atol=1e-5)
        assert ("normalTexture" in found) == ("normalTexture" in material), material["name"]


main(*sys.argv[sys.argv.index("--") + 1:])
