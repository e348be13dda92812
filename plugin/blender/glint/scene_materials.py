# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials as a glTF document in memory: the Principled BSDF with its image textures, and the flakes of the property group.

The numbers are those that Blender's glTF exporter writes, but for alpha, which counts as in Cycles whatever the blend mode
is.
"""

import json
from types import SimpleNamespace

from . import extension, principled, textures
from .scene_images import Image, packed, pixels_of, texture_image
from .scene_nodes import Source, origin, source_of

WRAP = {"REPEAT": 10497, "EXTEND": 33071, "CLIP": 33071, "MIRROR": 33648}
NEAREST = 9728

# Names of the Principled BSDF's inputs since 3.4 and since 4.0, and what they are without one.
INPUTS = {
    "color": (("Base Color",), (0.8, 0.8, 0.8)),
    "metallic": (("Metallic",), 0.0),
    "roughness": (("Roughness",), 0.5),
    "specular": (("Specular", "Specular IOR Level"), 0.5),
    "emission": (("Emission", "Emission Color"), (0.0, 0.0, 0.0)),
    "strength": (("Emission Strength",), 1.0),
    "alpha": (("Alpha",), 1.0),
    "coat": (("Clearcoat", "Coat Weight"), 0.0),
    "coat_roughness": (("Clearcoat Roughness", "Coat Roughness"), 0.03),
}
NOT_RENDERED = ("Transmission", "Transmission Weight", "Subsurface", "Subsurface Weight", "Sheen", "Sheen Weight")


def _clip(value):
    """Into [0, 1]; what is no number, as a driver may make it, is 0: max keeps its first argument then."""
    return tuple(_clip(x) for x in value) if isinstance(value, tuple) else min(max(0.0, value), 1.0)


class Materials:
    """Collects materials, textures and images."""

    def __init__(self, image_cache, warn):
        self.document = {"materials": [], "textures": [], "samplers": []}
        self.images = []
        self._cache, self._warn = image_cache, warn
        self._numbers, self._image_numbers = {}, {}

    def text(self):
        return json.dumps({name: array for name, array in self.document.items() if array})

    def add(self, material, uv_names, active_uv):
        """The number of a material on meshes with these texture coordinates; None is Blender's grey."""
        key = (material.as_pointer() if material is not None else 0, uv_names, active_uv)
        if key not in self._numbers:
            reader = _Reader(self, material, uv_names, active_uv)
            self._numbers[key] = len(self.document["materials"])
            self.document["materials"].append(reader.read())
        return self._numbers[key]

    def warn_of(self, material, text):
        self._warn(f"{material.name}: {text}")

    def image(self, key, make):
        """The number of an image; make() gives it, or None, when it is wanted for the first time."""
        if key not in self._image_numbers:
            if key not in self._cache:
                self._cache[key] = make()
            made = self._cache[key]
            self._image_numbers[key] = None if made is None else len(self.images)
            if made is not None:
                self.images.append(made)
        return self._image_numbers[key]

    def texture(self, image_number, node):
        """The number of a texture: an image with the repetition and interpolation of a node."""
        sampler = {"wrapS": WRAP.get(node.extension, WRAP["REPEAT"])}
        sampler["wrapT"] = sampler["wrapS"]
        if node.interpolation == "Closest":
            sampler["magFilter"] = NEAREST
        if sampler not in self.document["samplers"]:
            self.document["samplers"].append(sampler)
        texture = {"source": image_number, "sampler": self.document["samplers"].index(sampler)}
        if texture not in self.document["textures"]:
            self.document["textures"].append(texture)
        return self.document["textures"].index(texture)


class _Reader:
    """One material while it is read."""

    def __init__(self, all_materials, material, uv_names, active_uv):
        self.all, self.material = all_materials, material
        self.uv_names, self.active_uv = uv_names, active_uv
        self.node = principled.find(material) if material is not None else None
        self.out = {"doubleSided": True}
        self.extensions = {}

    def warn(self, text):
        self.all.warn_of(self.material, text)

    def source(self, name):
        names, default = INPUTS[name]
        socket = next((self.node.inputs[n] for n in names if n in self.node.inputs), None) if self.node else None
        return source_of(socket, self.warn) if socket is not None else Source(default)

    def read(self):
        if self.material is None:
            self.out["pbrMetallicRoughness"] = {"baseColorFactor": [0.8, 0.8, 0.8, 1.0], "metallicFactor": 0.0,
                                                "roughnessFactor": 0.5}
            return self.out
        self.out["name"] = self.material.name
        self.out["doubleSided"] = not self.material.use_backface_culling
        if self.node is None:
            self.read_display()
        else:
            self.read_base()
            self.read_specular()
            self.read_emission()
            self.read_coat()
            self.read_normal()
            self.warn_of_unrendered()
        self.read_glints()
        if self.extensions:
            self.out["extensions"] = self.extensions
        return self.out

    def read_glints(self):
        own, coat = extension.of_material(self.material.glint, self.glint_texture)
        if own is not None:
            self.extensions[extension.NAME] = own
        if coat is not None:
            self.extensions.setdefault(extension.COAT, {"clearcoatFactor": 0.0})["extensions"] = {extension.NAME: coat}

    def glint_texture(self, texture):
        """The textureInfo of a texture of the flakes, or None."""
        if texture is None or texture.image is None:
            return None
        glint, image = self.material.glint, texture.image
        as_color = texture in (glint.color_texture, glint.coat.color_texture)
        number = self.all.image((image.name, as_color), lambda: texture_image(image, as_color))
        if number is None:
            self.warn(f"the image \"{image.name}\" has no pixels")
            return None
        repeated = SimpleNamespace(extension="REPEAT", interpolation="Closest" if texture.closest else "Linear")
        return textures.info_of(texture, self.all.texture(number, repeated))

    def read_display(self):
        """Without a Principled BSDF: what the viewport shows."""
        if self.material.use_nodes:
            self.warn("has no Principled BSDF; its viewport display stands in")
        m = self.material
        self.out["pbrMetallicRoughness"] = {
            "baseColorFactor": [*_clip(tuple(m.diffuse_color)[:3]), 1.0], "metallicFactor": m.metallic,
            "roughnessFactor": m.roughness,
        }

    # ---- textures ----

    def texcoord_of(self, node):
        """Set and KHR_texture_transform of an image texture, from its Mapping and UV Map nodes."""
        chosen, transform = self.active_uv, None
        output = origin(node.inputs["Vector"])
        if output is not None and output.node.type == "MAPPING":
            transform = _transform(output.node)
            output = origin(output.node.inputs["Vector"])
        if output is not None and output.node.type == "UVMAP" and output.node.uv_map:
            if output.node.uv_map in self.uv_names:
                chosen = self.uv_names.index(output.node.uv_map)
            else:
                self.warn(f"the UV map \"{output.node.uv_map}\" is not among the first two of a mesh")
        elif output is not None and (output.node.type != "TEX_COORD" or output.name != "UV"):
            self.warn(f"textures lie along UV maps only; \"{output.node.name}\" is not read")
        return chosen, transform

    def info(self, image_number, node, **more):
        """A textureInfo; None where the image has no pixels."""
        if image_number is None:
            self.warn(f"the image \"{node.image.name}\" has no pixels")
            return None
        texcoord, transform = self.texcoord_of(node)
        info = {"index": self.all.texture(image_number, node), **more}
        if texcoord:
            info["texCoord"] = texcoord
        if transform is not None:
            info["extensions"] = {"KHR_texture_transform": transform}
        return info

    def texture(self, node, as_color, **more):
        image = node.image
        number = self.all.image((image.name, as_color), lambda: texture_image(image, as_color))
        return self.info(number, node, **more)

    def single_channel(self, source, place):
        """A texture whose channel place ("R", "G", "B") is that of a source."""
        if source.channel == place:
            return self.texture(source.node, False)
        image, channel = source.node.image, source.channel
        planes = {"R": (0,), "G": (1,), "B": (2,)}[place]

        def make():
            pixels = pixels_of(image)
            if pixels is None:
                return None
            out = pixels.copy()
            out[..., planes[0]] = channel_of(pixels, channel)
            return Image(image.name, pixels=out.clip(0.0, 1.0))

        return self.info(self.all.image((image.name, channel, place), make), source.node)

    # ---- the parts of a material ----

    def read_base(self):
        color, alpha = self.source("color"), self.source("alpha")
        base = {"baseColorFactor": [*_clip(color.factor), _clip(alpha.factor)]}
        if color.node is not None:
            _put(base, "baseColorTexture", self.texture(color.node, True))
        if alpha.node is not None and (color.node is None or alpha.node.image != color.node.image):
            self.warn("alpha from another image than the base colour's is not read")
        elif alpha.node is not None or alpha.factor < 1.0:
            self.read_alpha_mode()
        self.read_metallic_roughness(base)
        self.out["pbrMetallicRoughness"] = base

    def read_alpha_mode(self):
        if getattr(self.material, "blend_method", "BLEND") == "CLIP":
            self.out.update(alphaMode="MASK", alphaCutoff=self.material.alpha_threshold)
        else:
            self.out["alphaMode"] = "BLEND"

    def read_metallic_roughness(self, base):
        metallic, roughness = self.source("metallic"), self.source("roughness")
        base.update(metallicFactor=_clip(metallic.factor), roughnessFactor=_clip(roughness.factor))
        node = roughness.node or metallic.node
        if node is None:
            return
        fits = (roughness.node is None or roughness.channel == "G") and (metallic.node is None or metallic.channel == "B")
        together = roughness.node is not None and metallic.node is not None and roughness.node.image == metallic.node.image
        if fits and together:
            _put(base, "metallicRoughnessTexture", self.texture(node, False))
            return
        names = tuple((s.node.image.name, s.channel) if s.node is not None else None for s in (roughness, metallic))

        def make():
            parts = [channel_of(pixels_of(s.node.image), s.channel) if s.node is not None else None
                     for s in (roughness, metallic)]
            return Image(node.image.name, pixels=packed(*parts).clip(0.0, 1.0)) if any(p is not None for p in parts) else None

        _put(base, "metallicRoughnessTexture", self.info(self.all.image(names, make), node))

    def read_specular(self):
        specular = self.source("specular")
        if specular.node is not None:
            self.warn("a texture of Specular is not read")
        self.extensions.update(principled.extensions_of(self.node, self.material.glint))

    def read_emission(self):
        color, strength = self.source("emission"), self.source("strength")
        factor = tuple(max(0.0, c) * max(0.0, strength.factor) for c in color.factor)
        largest = max(factor)
        if not largest > 0.0:
            return
        scale = max(largest, 1.0)
        self.out["emissiveFactor"] = [c / scale for c in factor]
        if scale > 1.0:
            self.extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": scale}
        if color.node is not None:
            _put(self.out, "emissiveTexture", self.texture(color.node, True))

    def read_coat(self):
        coat, roughness = self.source("coat"), self.source("coat_roughness")
        if not coat.factor > 0.0:
            return
        made = {"clearcoatFactor": _clip(coat.factor), "clearcoatRoughnessFactor": _clip(roughness.factor)}
        if coat.node is not None:
            _put(made, "clearcoatTexture", self.single_channel(coat, "R"))
        if roughness.node is not None:
            _put(made, "clearcoatRoughnessTexture", self.single_channel(roughness, "G"))
        normal = self.normal_map(("Clearcoat Normal", "Coat Normal"))
        if normal is not None:
            made["clearcoatNormalTexture"] = normal
        self.extensions["KHR_materials_clearcoat"] = made

    def read_normal(self):
        normal = self.normal_map(("Normal",))
        if normal is not None:
            self.out["normalTexture"] = normal

    def normal_map(self, names):
        socket = next((self.node.inputs[name] for name in names if name in self.node.inputs), None)
        output = origin(socket) if socket is not None else None
        if output is None:
            return None
        if output.node.type != "NORMAL_MAP" or output.node.space != "TANGENT":
            self.warn(f"{socket.name}: only normal maps in tangent space are read, not \"{output.node.name}\"")
            return None
        color = source_of(output.node.inputs["Color"], self.warn)
        if color.node is None:
            return None
        return self.texture(color.node, False, scale=output.node.inputs["Strength"].default_value)

    def warn_of_unrendered(self):
        for name in NOT_RENDERED:
            socket = self.node.inputs.get(name)
            if socket is not None and (socket.is_linked or socket.default_value > 0.0):
                self.warn(f"{name} is not rendered")


def _put(into, name, info):
    if info is not None:
        into[name] = info


def channel_of(pixels, channel):
    """One channel of an image; "grey" is the luminance, as Cycles turns a colour into a number."""
    if pixels is None:
        return None
    if channel == "grey":
        return pixels[..., 0] * 0.2126 + pixels[..., 1] * 0.7152 + pixels[..., 2] * 0.0722
    return pixels[..., "RGBA".index(channel)]


def _transform(node):
    """A Mapping node of the type Point as KHR_texture_transform, whose v runs downwards: as the glTF exporter has it."""
    from math import cos, sin

    offset, rotation, scale = (node.inputs[name].default_value for name in ("Location", "Rotation", "Scale"))
    return {
        "offset": [offset[0] - scale[1] * sin(rotation[2]), 1.0 - offset[1] - scale[1] * cos(rotation[2])],
        "rotation": rotation[2],
        "scale": [scale[0], scale[1]],
    }
