# SPDX-License-Identifier: GPL-3.0-or-later
"""Image textures of a material as textureInfos of glTF: which UV map, which transform, which channel of which picture."""

from math import cos, sin
from types import SimpleNamespace

from . import textures
from .scene_images import Image, pixels_of, texture_image
from .scene_nodes import origin


class Textures:
    """Those of one material. all_materials collects pictures and samplers (scene_materials.Materials)."""

    def __init__(self, all_materials, material, uv_names, active_uv, warn):
        self.all, self.material, self.warn = all_materials, material, warn
        self.uv_names, self.active_uv = uv_names, active_uv

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

    def of_node(self, node, as_color, **more):
        """The textureInfo of an image texture."""
        image = node.image
        number = self.all.image((image.name, as_color), lambda: texture_image(image, as_color))
        return self.info(number, node, **more)

    def of_channel(self, source, place):
        """A texture whose channel place ("R", "G", "B") is that of a source."""
        if source.channel == place:
            return self.of_node(source.node, False)
        image, channel = source.node.image, source.channel

        def make():
            pixels = pixels_of(image)
            if pixels is None:
                return None
            out = pixels.copy()
            out[..., "RGB".index(place)] = channel_of(pixels, channel)
            return Image(image.name, pixels=out.clip(0.0, 1.0))

        return self.info(self.all.image((image.name, channel, place), make), source.node)

    def of_flakes(self, texture):
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


def channel_of(pixels, channel):
    """One channel of an image; "grey" is the luminance, as Cycles turns a colour into a number."""
    if pixels is None:
        return None
    if channel == "grey":
        return pixels[..., 0] * 0.2126 + pixels[..., 1] * 0.7152 + pixels[..., 2] * 0.0722
    return pixels[..., "RGBA".index(channel)]


def _transform(node):
    """A Mapping node of the type Point as KHR_texture_transform, whose v runs downwards: as the glTF exporter has it."""
    offset, rotation, scale = (node.inputs[name].default_value for name in ("Location", "Rotation", "Scale"))
    return {
        "offset": [offset[0] - scale[1] * sin(rotation[2]), 1.0 - offset[1] - scale[1] * cos(rotation[2])],
        "rotation": rotation[2],
        "scale": [scale[0], scale[1]],
    }
