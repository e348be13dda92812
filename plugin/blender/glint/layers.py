# SPDX-License-Identifier: GPL-3.0-or-later
"""A whole material as nodes: a base, what is diffuse below it, and a clear coat above, each with flakes of its own.

    L = base (1 - w (1 - T)) + w coat,    T(wo, wi) = min(t_o, t_i, t_o t_i / t_n)

as docs/layers.md has it. A flake's wi is known, since it is a mirror; what is diffuse takes the mean over wi.
"""

import math

from . import compat, flakes, places, principled
from .example import Example
from .flakes import Frame, Layer

COAT_F0 = 0.04
# The mean of 1 - F over what is diffuse, for the coat's Schlick term: 1 - (f0 + (1 - f0) / 21).
COAT_DIFFUSE_THROUGH = 1.0 - (COAT_F0 + (1.0 - COAT_F0) / 21.0)


class Sources:
    """Inputs of the Principled BSDF: their constants, or what is linked to them, through inputs of the group."""

    def __init__(self, node, linked):
        self.node, self._linked = node, linked

    def of(self, names, default):
        socket = compat.input_of(self.node, *names) if self.node is not None else None
        if socket is None:
            return default
        if socket.is_linked:
            return self._linked(socket)
        value = socket.default_value
        return value if isinstance(value, (int, float)) else tuple(value)[:3]

    def linked(self, names):
        """What is linked to an input, or None."""
        socket = compat.input_of(self.node, *names) if self.node is not None else None
        return self._linked(socket) if socket is not None and socket.is_linked else None


def _sampled(g, texture, uv_maps, is_color=False):
    """The colour of a texture, or None."""
    if texture.image is None:
        return None
    uv = g.node("ShaderNodeUVMap", uv_map=uv_maps[texture.texcoord]).outputs[0]
    mapping = g.node("ShaderNodeMapping")
    # KHR_texture_transform has its origin above, Blender below.
    sine, cosine = math.sin(texture.rotation), math.cos(texture.rotation)
    mapping.inputs["Location"].default_value = (
        texture.offset[0] + texture.scale[1] * sine, 1.0 - texture.offset[1] - texture.scale[1] * cosine, 0.0
    )
    mapping.inputs["Rotation"].default_value = (0.0, 0.0, texture.rotation)
    mapping.inputs["Scale"].default_value = (texture.scale[0], texture.scale[1], 1.0)
    g.connect(uv, mapping.inputs["Vector"])
    node = g.node("ShaderNodeTexImage", image=texture.image, interpolation="Closest" if texture.closest else "Linear")
    texture.image.colorspace_settings.name = "sRGB" if is_color else "Non-Color"
    g.connect(mapping.outputs[0], node.inputs["Vector"])
    return node.outputs["Color"]


def _add_flakes(g, layer, values, uv_maps, seed):
    """Sets what the properties say of a layer's flakes."""
    layer.distribution = values.distribution
    layer.facet_roughness = values.facet_roughness
    layer.elongation, layer.coverage, layer.seed = values.elongation, values.coverage, seed
    layer.color_variation = values.color_variation
    layer.colors = tuple(tuple(entry.color) for entry in values.colors)
    layer.factor = values.factor
    shares = _sampled(g, values.factor_texture, uv_maps)
    if shares is not None:
        layer.factor = g.multiply(g.separate(shares)[0], values.factor)
    layer.density_per_m2 = values.density_per_cm2 * 1e4
    densities = _sampled(g, values.density_texture, uv_maps)
    if densities is not None:
        density = g.separate(densities)[1]
        layer.density_per_m2 = g.multiply(density, layer.density_per_m2)
        layer.factor = g.multiply(g.is_above(density, 0.0), layer.factor)
    tint = tuple(values.color)
    tints = _sampled(g, values.color_texture, uv_maps, is_color=True)
    if tints is not None:
        tint = g.times(tints, tint)
    tint = g.blended((1.0, 1.0, 1.0), tint, layer.factor)
    layer.f0, layer.f90 = g.times(layer.f0, tint), g.times(layer.f90, tint)
    if values.structure == "EXAMPLE" and values.example_texture.image is not None:
        texture = values.example_texture
        texture.image.colorspace_settings.name = "Non-Color"
        size = values.example_size / math.sqrt(texture.scale[0] * texture.scale[1])
        layer.example = Example(texture.image, size, values.elongation, seed, texture.closest)
        layer.alpha_x = layer.alpha_y


def _alpha(g, roughness):
    return g.at_least(g.multiply(roughness, roughness), 1e-4)


def _base(g, sources, values):
    """The base without flakes, and its albedo."""
    color = sources.of(("Base Color",), (0.8, 0.8, 0.8))
    metallic = sources.of(("Metallic",), 0.0)
    dial = sources.of(("Specular", "Specular IOR Level"), 0.5)
    scale = compat.specular_scale(sources.node) if sources.node is not None else 0.08
    head_on = g.scaled(tuple(values.specular_color), g.multiply(dial, scale))
    if not isinstance(head_on, tuple):
        head_on = g.vector("MINIMUM", head_on, (1.0, 1.0, 1.0))
    else:
        head_on = tuple(min(c, 1.0) for c in head_on)
    alpha = _alpha(g, sources.of(("Roughness",), 0.5))
    strength = sources.of(("Anisotropic",), 0.0)
    layer = Layer(alpha_x=g.mixed(alpha, 1.0, g.multiply(strength, strength)), alpha_y=alpha,
                  f0=g.blended(head_on, color, metallic))
    return layer, g.scaled(color, g.subtract(1.0, metallic))


class _Coat:
    """The coat's layer and what it lets through."""

    def __init__(self, g, weight, roughness):
        self.g, self.weight = g, weight
        alpha = _alpha(g, roughness)
        self.layer = Layer(alpha_x=alpha, alpha_y=alpha, f0=(COAT_F0,) * 3)

    def _transmitted(self, cosine):
        """t: what its facets do not keep, which see a direction at a lower cosine than the surface does."""
        g, alpha = self.g, self.layer.alpha_x
        slant = g.subtract(1.0, g.at_most(g.multiply(alpha, 0.8), 0.16))
        kept = g.scaled(flakes.reflectance(g, self.layer, g.multiply(g.at_least(cosine, 0.0), slant)), self.layer.coverage)
        return g.minus((1.0, 1.0, 1.0), kept)

    def _weighed(self, through):
        return self.g.blended((1.0, 1.0, 1.0), through, self.weight)

    def through(self, cos_o, cos_i):
        g = self.g
        t_o, t_i = self._transmitted(cos_o), self._transmitted(cos_i)
        both = g.vector("DIVIDE", g.times(t_o, t_i), self._transmitted(1.0))
        return self._weighed(g.vector("MINIMUM", g.vector("MINIMUM", t_o, t_i), both))

    def through_to_diffuse(self, cos_o):
        g = self.g
        mean = g.scaled(self._transmitted(cos_o), COAT_DIFFUSE_THROUGH / (1.0 - COAT_F0))
        return self._weighed(mean)


def _place(g, values, uv_maps, frame):
    if values.space == "UV":
        return places.by_uv(g, uv_maps[values.texcoord], values.uv_scale, frame)
    return places.on_planes(g, frame)


def _along(g, uv_map, normal):
    """The tangent, as UV maps have it; where there is none, any."""
    along = g.node("ShaderNodeTangent", direction_type="UV_MAP", uv_map=uv_map).outputs[0]
    missing = g.math("LESS_THAN", g.vector("LENGTH", along), 0.5)
    any_one = g.cross(normal, (0.36, 0.48, 0.8))
    return g.plus(along, g.scaled(any_one, missing))


class _Ground:
    """Frames and places, made once where base and coat have the same."""

    def __init__(self, g, sources, uv_maps):
        self.g, self.sources, self.uv_maps = g, sources, uv_maps
        self._frames, self._places = {}, {}

    def frame(self, normal_names, values, rotation):
        normal = self.sources.linked(normal_names)
        uv_map = self.uv_maps[values.texcoord if values.space == "UV" else 0]
        key = None if normal is None else normal.name, uv_map, rotation
        if key not in self._frames:
            g = self.g
            anything = g.node("ShaderNodeNewGeometry").outputs["Normal"] if normal is None else normal
            self._frames[key] = Frame(g, _along(g, uv_map, anything), normal, rotation)
        return self._frames[key]

    def place(self, values, frame):
        key = values.space, values.texcoord, values.uv_scale, id(frame)
        if key not in self._places:
            self._places[key] = _place(self.g, values, self.uv_maps, frame)
        return self._places[key]


def _coat_shader(g, coat, values, ground):
    frame = ground.frame(("Clearcoat Normal", "Coat Normal"), values, 0.0)
    where = ground.place(values, frame) if coat.layer.factor else None
    return flakes.lobe(g, coat.layer, frame, where)


def _with_coat(g, base, coat_shader, coat):
    """base has been weighed by what comes through; the coat counts by its weight."""
    if coat.weight == 1.0:
        return g.sum([base, coat_shader])
    black = g.diffuse((0.0, 0.0, 0.0))
    return g.sum([base, g.mix(coat.weight, black, coat_shader)])


def _coated(g, sources, values, uv_maps, smooth, base_counts):
    """The coat with its flakes, or None."""
    weight = sources.of(principled.COAT, 0.0)
    if not weight:
        return None
    coat = _Coat(g, weight, sources.of(principled.COAT_ROUGHNESS, 0.0))
    own = _coat_values(values)
    if own.enabled and not smooth:
        # A bit that no seed of a file has, so that equal seeds are not equal flakes; as in src/scene/surface.c.
        _add_flakes(g, coat.layer, own, uv_maps, own.seed + 2**31 if base_counts else own.seed)
    return coat


def _coat_values(values):
    return values if values.enabled and values.layer == "CLEARCOAT" else values.coat


def _rotation(sources, layer):
    """Of alpha_x against the tangent; the directions of an example are those of its map."""
    if layer.example is not None or layer.alpha_x == layer.alpha_y:
        return 0.0
    return 2.0 * math.pi * principled.value_of(sources.node, ("Anisotropic Rotation",), 0.0)


def _diffuse(g, layer, albedo, frame, coat):
    """What the flakes let through, seen from the viewer, over a Lambertian base; None where that is black."""
    if isinstance(albedo, tuple) and not any(c > 0.0 for c in albedo):
        return None
    below = g.minus((1.0, 1.0, 1.0), g.scaled(flakes.reflectance(g, layer, frame.cos_o), layer.coverage))
    color = g.times(albedo, below)
    if coat is not None:
        color = g.times(color, coat.through_to_diffuse(frame.cos_o))
    return g.diffuse(color, frame.n)


def build(g, sources, values, uv_maps, smooth=False):
    """The material's shader. smooth: the same without single flakes.

    uv_maps  names of the first and the second UV map of its meshes
    """
    layer, albedo = _base(g, sources, values)
    counts = values.enabled and values.layer == "BASE" and values.factor > 0.0 and not smooth
    if counts:
        _add_flakes(g, layer, values, uv_maps, values.seed)
    coat = _coated(g, sources, values, uv_maps, smooth, counts)
    if coat is not None:
        layer.through = coat.through
    ground = _Ground(g, sources, uv_maps)
    frame = ground.frame(("Normal",), values, _rotation(sources, layer))
    where = ground.place(values, frame) if layer.factor else None
    shaders = [flakes.lobe(g, layer, frame, where), _diffuse(g, layer, albedo, frame, coat)]
    shader = g.sum([s for s in shaders if s is not None])
    if coat is None:
        return shader
    return _with_coat(g, shader, _coat_shader(g, coat, _coat_values(values), ground), coat)
