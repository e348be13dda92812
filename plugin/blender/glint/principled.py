# SPDX-License-Identifier: GPL-3.0-or-later
"""What a Principled BSDF says about the surface that the flakes make up, in the numbers of libglint and glTF, both ways."""

import math

from . import compat
from .extension import number, single

DIELECTRIC = 0.04  # what glTF takes for granted: an index of 1.5
ANISOTROPY = "KHR_materials_anisotropy"
CLEARCOAT = "KHR_materials_clearcoat"
IOR = "KHR_materials_ior"
SPECULAR = "KHR_materials_specular"

COAT = ("Clearcoat", "Coat Weight")
COAT_ROUGHNESS = ("Clearcoat Roughness", "Coat Roughness")


def find(material):
    """The Principled BSDF of a material, or None."""
    if not material.use_nodes:
        return None
    return next((n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED"), None)


def value_of(node, names, default):
    """The constant of the first input that this version of Blender has."""
    socket = compat.input_of(node, *names) if node is not None else None
    return default if socket is None else socket.default_value


def _set(node, names, value):
    socket = compat.input_of(node, *names)
    if socket is not None:
        socket.default_value = value


def alpha_of(material):
    return max(value_of(find(material), ("Roughness",), 0.5) ** 2, 1e-4)


# ---- from glTF ----


def apply(node, group, preset):
    """Sets the Principled BSDF from a glTF material object: all that can be a constant."""
    base, extensions = preset.get("pbrMetallicRoughness", {}), preset.get("extensions", {})
    _set(node, ("Base Color",), base.get("baseColorFactor", [1.0] * 4))
    _set(node, ("Metallic",), base.get("metallicFactor", 1.0))
    _set(node, ("Roughness",), base.get("roughnessFactor", 1.0))
    coat = extensions.get(CLEARCOAT, {})
    _set(node, COAT, coat.get("clearcoatFactor", 0.0))
    _set(node, COAT_ROUGHNESS, coat.get("clearcoatRoughnessFactor", 0.0))
    apply_extensions(node, group, extensions)


def apply_extensions(node, group, extensions):
    """What Blender's own importer leaves out or has no room for."""
    specular = extensions.get(SPECULAR, {})
    if "specularTexture" not in specular and "specularColorTexture" not in specular:
        compat.set_head_on_reflectance(node, extensions.get(IOR, {}).get("ior", 1.5))
        factor = specular.get("specularFactor", 1.0)
        group.specular_color = [factor * c for c in specular.get("specularColorFactor", (1.0, 1.0, 1.0))]
    anisotropy = extensions.get(ANISOTROPY, {})
    if "anisotropyTexture" not in anisotropy:
        _set(node, ("Anisotropic",), anisotropy.get("anisotropyStrength", 0.0))
        turns = anisotropy.get("anisotropyRotation", 0.0) / (2.0 * math.pi)
        _set(node, ("Anisotropic Rotation",), turns % 1.0)


# ---- to glTF ----


def _specular(node, group):
    """KHR_materials_ior and KHR_materials_specular: the index where it says what is reflected, else a colour."""
    head_on = compat.head_on_reflectance(node)
    ior = value_of(node, ("IOR",), 1.5)
    out = {}
    if math.isclose(head_on, DIELECTRIC, rel_tol=1e-5):
        share = 1.0
    elif math.isclose(head_on, ((ior - 1.0) / (ior + 1.0)) ** 2, rel_tol=1e-4):
        out[IOR] = {"ior": number(ior)}
        share = 1.0
    else:
        share = head_on / DIELECTRIC
    color = [number(single(share * c)) for c in group.specular_color]
    if color != [1.0, 1.0, 1.0]:
        out[SPECULAR] = {"specularColorFactor": color}
    return out


def is_textured(node):
    """Something is linked to what says how much is reflected head-on: then Blender's exporter knows better."""
    names = ("Specular", "Specular IOR Level", "IOR")
    return any(node.inputs[name].is_linked for name in names if name in node.inputs)


def extensions_of(node, group):
    """Extensions that say what the flakes are made of, where Blender's own exporter leaves them out."""
    out = {} if is_textured(node) else _specular(node, group)
    strength = value_of(node, ("Anisotropic",), 0.0)
    if strength > 0.0:
        turns = value_of(node, ("Anisotropic Rotation",), 0.0)
        out[ANISOTROPY] = {"anisotropyStrength": number(strength),
                           "anisotropyRotation": number(single(2.0 * math.pi * turns))}
    return out


def to_gltf(node, group):
    """A glTF material object, without extensions of flakes, that apply() turns into this node again."""
    out = {
        "pbrMetallicRoughness": {
            "baseColorFactor": [number(c) for c in value_of(node, ("Base Color",), (1.0,) * 4)],
            "metallicFactor": number(value_of(node, ("Metallic",), 0.0)),
            "roughnessFactor": number(value_of(node, ("Roughness",), 0.5)),
        },
        "extensions": extensions_of(node, group),
    }
    coat = value_of(node, COAT, 0.0)
    if coat > 0.0:
        out["extensions"][CLEARCOAT] = {
            "clearcoatFactor": number(coat),
            "clearcoatRoughnessFactor": number(value_of(node, COAT_ROUGHNESS, 0.0)),
        }
    return out
