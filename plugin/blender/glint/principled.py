# SPDX-License-Identifier: GPL-3.0-or-later
"""What a Principled BSDF says about the surface that the flakes make up, in the numbers of libglint and glTF."""

from .flakes import Flakes

# Blender's Specular 0.5 is a reflectance of 4 %: 8 % times the dial.
SPECULAR_SCALE = 0.08


def find(material):
    """The Principled BSDF of a material, or None."""
    if not material.use_nodes:
        return None
    return next((n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED"), None)


def input_value(node, names, default):
    """The first input that this version of Blender has. A linked one gives its constant: textures are not looked up."""
    for name in names:
        socket = node.inputs.get(name)
        if socket is not None:
            return socket.default_value
    return default


def textured_inputs(material):
    """Names of inputs that a flake takes as constants although something is linked to them."""
    node = find(material)
    names = ("Base Color", "Metallic", "Roughness", "Specular", "Specular IOR Level", "Normal")
    return [n for n in names if node is not None and node.inputs.get(n) is not None and node.inputs[n].is_linked]


def flakes_of(material):
    """Flakes from the material's property group and its Principled BSDF."""
    group, node = material.glint, find(material)
    color, metallic, roughness, specular = (1.0, 1.0, 1.0), 1.0, 0.5, 0.5
    if node is not None:
        color = tuple(input_value(node, ("Base Color",), (0.8, 0.8, 0.8, 1.0)))[:3]
        metallic = input_value(node, ("Metallic",), 0.0)
        roughness = input_value(node, ("Roughness",), 0.5)
        specular = input_value(node, ("Specular", "Specular IOR Level"), 0.5)
    alpha = max(roughness * roughness, 1e-4)
    dielectric = min(SPECULAR_SCALE * specular, 1.0)

    def tinted(value, tint):
        return value * (1.0 + group.factor * (tint - 1.0))

    f0 = tuple(tinted(dielectric + metallic * (c - dielectric), t) for c, t in zip(color, group.color))
    f90 = tuple(tinted(1.0, t) for t in group.color)
    return Flakes(
        distribution=group.distribution,
        alpha_x=alpha,
        alpha_y=alpha,
        density_per_m2=group.density_per_cm2 * 1e4,
        facet_roughness=group.facet_roughness,
        elongation=group.elongation,
        coverage=group.coverage,
        factor=group.factor if group.enabled else 0.0,
        color_variation=group.color_variation,
        seed=group.seed,
        uv_scale=group.uv_scale,
        f0=f0,
        f90=f90,
        diffuse=tuple(c * (1.0 - metallic) for c in color),
    )
