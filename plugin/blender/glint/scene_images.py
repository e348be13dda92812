# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's images as libglint_preview takes them: the file itself where there is one, otherwise its pixels."""

import dataclasses
import os
from typing import Optional

import bpy
import numpy

# What the library decodes by itself.
READABLE = (".png", ".jpg", ".jpeg", ".webp")


@dataclasses.dataclass
class Image:
    """One of path, data (the bytes of a file) and pixels (rows from the top, RGBA: what a file would hold)."""

    name: str
    path: Optional[str] = None
    data: Optional[bytes] = None
    pixels: Optional[numpy.ndarray] = None


def encode_srgb(linear):
    """Codes in [0, 1] of linear values (IEC 61966-2-1)."""
    x = numpy.clip(linear, 0.0, 1.0)
    return numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * numpy.power(x, 1.0 / 2.4, where=x > 0.0, out=x.copy()) - 0.055)


def decode_srgb(codes):
    x = numpy.asarray(codes)
    return numpy.where(x <= 0.04045, x / 12.92, numpy.power((x + 0.055) / 1.055, 2.4))


def is_linear(image):
    """Whether the numbers in Blender's buffer are linear: floats are, unless somebody says that bytes are data."""
    return image.is_float or image.colorspace_settings.name in {"Linear", "Non-Color", "Raw"}


def pixels_of(image):
    """Height x width x 4 floats as Blender holds them, rows from the top; None where there are none."""
    width, height = image.size
    if width == 0 or height == 0:
        return None
    values = numpy.empty(width * height * 4, numpy.float32)
    image.pixels.foreach_get(values)
    return values.reshape(height, width, 4)[::-1]


def _file_of(image):
    """The path or the bytes of a file that is what Blender shows."""
    if image.source != "FILE" or image.is_dirty:
        return None
    if image.packed_file is not None:
        data = bytes(image.packed_file.data)
        known = data[:4] == b"\x89PNG" or data[:3] == b"\xff\xd8\xff" or data[8:12] == b"WEBP"
        return Image(image.name, data=data) if known else None
    path = bpy.path.abspath(image.filepath, library=image.library)
    if path.lower().endswith(READABLE) and os.path.isfile(path):
        return Image(image.name, path=path)
    return None


def texture_image(image, as_color):
    """An image for a texture of colours or of data; None for one without pixels."""
    linear = is_linear(image)
    found = _file_of(image) if not (as_color and linear) else None
    if found is not None:
        return found
    pixels = pixels_of(image)
    if pixels is None:
        return None
    pixels = numpy.clip(pixels, 0.0, 1.0).astype(numpy.float32)
    if as_color and linear:
        pixels[..., :3] = encode_srgb(pixels[..., :3])
    return Image(image.name, pixels=numpy.ascontiguousarray(pixels))


def radiance_of(image, largest_width=4096):
    """An environment as height x width x 3 linear floats, twice as wide as high; None for one without pixels.

    Larger ones are reduced by means over blocks, which keep their light.
    """
    pixels = pixels_of(image)
    if pixels is None:
        return None
    rgb = pixels[..., :3]
    if not is_linear(image):
        rgb = decode_srgb(rgb)
    while rgb.shape[1] > largest_width and rgb.shape[0] % 2 == 0 and rgb.shape[1] % 2 == 0:
        rgb = 0.25 * (rgb[0::2, 0::2] + rgb[1::2, 0::2] + rgb[0::2, 1::2] + rgb[1::2, 1::2])
    height = max(rgb.shape[1] // 2, 1)
    if (rgb.shape[0], rgb.shape[1]) != (height, 2 * height):
        rgb = rgb[numpy.arange(height) * rgb.shape[0] // height][:, numpy.arange(2 * height) * rgb.shape[1] // (2 * height)]
    return numpy.ascontiguousarray(rgb, numpy.float32)


def packed(green, blue):
    """Two channels of images of any size in one picture: green and blue, as glTF has roughness and metallic."""
    shapes = [channel.shape for channel in (green, blue) if channel is not None]
    height, width = max(shape[0] for shape in shapes), max(shape[1] for shape in shapes)
    out = numpy.ones((height, width, 4), numpy.float32)
    for place, channel in ((1, green), (2, blue)):
        if channel is not None:
            rows = numpy.arange(height) * channel.shape[0] // height
            columns = numpy.arange(width) * channel.shape[1] // width
            out[..., place] = channel[rows][:, columns]
    return out
