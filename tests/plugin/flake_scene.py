# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a glTF scene that Cycles and libglint can both show: a plane or a sphere of white mirrors under one light. Plain Python.

    python3 flake_scene.py OUT.glb SHAPE DISTRIBUTION [LIGHT]     plane|sphere, ggx|beckmann, sun|rect|far
"""

import json
import math
import struct
import sys

ROUGHNESS = 0.5477225575  # alpha .3
FACET_ROUGHNESS = 0.1414213562  # alpha .02
# Flakes per square of the UV map. The picture shows half a metre: at 96 pixels some seven a pixel on the plane, and one in
# the middle of the sphere but far more at its edge.
CELLS = {"plane": 512.0, "sphere": 256.0}
# Of a sun the angle, of a rectangle width and height over its distance: sizes at which the noise of Cycles is least for what a
# sample costs. "far" is a square so far away that every point of the plane sees it alike, and so wide that a pixel of the middle of
# the highlight expects facets to be lit in numbers.
LIGHT_SIZES = {"sun": (math.radians(2.0),), "rect": (0.28, 0.14), "far": (0.3, 0.3)}
VIEW_RAD = math.radians(15.0)
LIGHT_DISTANCES = {"sun": 2.0, "rect": 2.0, "far": 500.0}


def plane():
    """A square metre, u along x, v (downwards in glTF) along +z."""
    corners = [(-0.5, 0.0, -0.5), (-0.5, 0.0, 0.5), (0.5, 0.0, 0.5), (0.5, 0.0, -0.5)]
    uv = [(x + 0.5, z + 0.5) for x, _, z in corners]
    return corners, [(0.0, 1.0, 0.0)] * 4, uv, [0, 1, 2, 0, 2, 3]


def sphere(columns=256, rows=128, radius=0.2):
    """u around the y axis, v from pole to pole; flat facets are far smaller than a pixel."""
    positions, normals, uv, indices = [], [], [], []
    for row in range(rows + 1):
        for column in range(columns + 1):
            theta, phi = math.pi * row / rows, 2.0 * math.pi * column / columns
            n = (math.sin(theta) * math.cos(phi), math.cos(theta), -math.sin(theta) * math.sin(phi))
            positions.append(tuple(radius * c for c in n))
            normals.append(n)
            uv.append((column / columns, row / rows))
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b = a + columns + 1
            if row > 0:
                indices += [a, b + 1, a + 1]
            if row < rows - 1:
                indices += [a, b, b + 1]
    return positions, normals, uv, indices


def rotation_about_x(radians):
    return [math.sin(radians / 2.0), 0.0, 0.0, math.cos(radians / 2.0)]


def node_looking(theta, distance, **content):
    """A node that looks at the origin from `distance`, tilted by theta from straight down towards +z."""
    return {
        "rotation": rotation_about_x(theta - math.pi / 2.0),
        "translation": [0.0, distance * math.cos(theta), distance * math.sin(theta)],
        **content,
    }


def light_of(kind):
    """The extension's name, what it lists, and how far away the light is, metres."""
    distance = LIGHT_DISTANCES[kind]
    if kind == "sun":
        sun = {"type": "directional", "intensity": 1.0, "extras": {"angularDiameter": LIGHT_SIZES[kind][0]}}
        return "KHR_lights_punctual", sun, distance
    width, height = LIGHT_SIZES[kind]
    radiance = 1.0 / (width * height)  # an irradiance of about 1
    rect = {"type": "rect", "intensity": radiance, "size": height * distance, "rect": {"aspect": width / height}}
    return "EXT_lights_area", rect, distance


def scene(shape, distribution, light="sun", cells=None, seed=5, facet_roughness=FACET_ROUGHNESS):
    cells = cells or CELLS[shape]
    extension, content, distance = light_of(light)
    positions, normals, uv, indices = {"plane": plane, "sphere": sphere}[shape]()
    count = len(positions)
    low = [min(p[i] for p in positions) for i in range(3)]
    high = [max(p[i] for p in positions) for i in range(3)]
    binary = b"".join(struct.pack("<3f", *p) for p in positions)
    binary += b"".join(struct.pack("<3f", *n) for n in normals)
    binary += b"".join(struct.pack("<2f", *t) for t in uv)
    binary += struct.pack(f"<{len(indices)}I", *indices)
    sizes = [12 * count, 12 * count, 8 * count, 4 * len(indices)]
    offsets = [sum(sizes[:i]) for i in range(4)]
    document = {
        "asset": {"version": "2.0"},
        "extensionsUsed": [extension, "GLINT_materials_glint"],
        "extensions": {extension: {"lights": [content]}},
        "scene": 0,
        "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [
            {"mesh": 0, "name": shape},
            node_looking(VIEW_RAD, 2.0, camera=0, name="Camera"),
            node_looking(math.radians(-10.0), distance, extensions={extension: {"light": 0}}, name="Light"),
        ],
        "cameras": [{"type": "orthographic", "orthographic": {"xmag": 0.25, "ymag": 0.25, "znear": 0.1, "zfar": 10.0}}],
        "materials": [{
            "name": "flakes",
            "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 1, "roughnessFactor": ROUGHNESS},
            "extensions": {"GLINT_materials_glint": {
                "glintFactor": 1, "glintDistribution": distribution, "glintDensity": cells**2,
                "glintFacetRoughness": facet_roughness, "glintSeed": seed,
            }},
        }],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}],
        "buffers": [{"byteLength": len(binary)}],
        "bufferViews": [{"buffer": 0, "byteOffset": o, "byteLength": s} for o, s in zip(offsets, sizes)],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3", "min": low, "max": high},
            {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5126, "count": count, "type": "VEC2"},
            {"bufferView": 3, "componentType": 5125, "count": len(indices), "type": "SCALAR"},
        ],
    }
    return document, binary


def write_glb(path, document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)


if __name__ == "__main__":
    write_glb(sys.argv[1], *scene(*sys.argv[2:]))
