# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of the flakes' textures: as bytes of a file, as data URIs of a preset, and as glTF's textureInfo."""

import base64
import os
import tempfile

import bpy

from .extension import number

TRANSFORM = "KHR_texture_transform"
NEAREST = 9728  # of a sampler's magFilter

_SIGNATURES = {b"\x89PNG": "image/png", b"\xff\xd8\xff": "image/jpeg"}


def mime_type_of(data):
    """glTF 2.0 has these two; None: another."""
    return next((mime for start, mime in _SIGNATURES.items() if data.startswith(start)), None)


def _file_bytes(image):
    """The file that the image came from, None where it is no PNG or JPEG or was painted on since."""
    if image.is_dirty or image.source != "FILE":
        return None
    if image.packed_file is not None:
        data = bytes(image.packed_file.data)
    else:
        path = bpy.path.abspath(image.filepath, library=image.library)
        if not os.path.isfile(path):
            raise ValueError(f"image '{image.name}': there is no file {path}")
        with open(path, "rb") as file:
            data = file.read()
    return data if mime_type_of(data) else None


def bytes_of(image):
    """A PNG or JPEG of the image: its own file where it is one."""
    data = _file_bytes(image)
    if data is not None:
        return data
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "image.png")
        written = image.copy()
        try:
            # A copy of a painted image has its file's pixels, so they are carried over.
            written.pixels = image.pixels[:]
            written.filepath_raw, written.file_format = path, "PNG"
            written.save()
        finally:
            bpy.data.images.remove(written)
        with open(path, "rb") as file:
            return file.read()


def image_of(name, data):
    """An image with this file inside: the one that is there already, or a new one."""
    for known in bpy.data.images:
        if known.packed_file is not None and bytes(known.packed_file.data) == data:
            return known
    mime = mime_type_of(data)
    if mime is None:
        raise ValueError(f"image '{name}': found neither a PNG nor a JPEG")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "image." + mime.rpartition("/")[2])
        with open(path, "wb") as file:
            file.write(data)
        image = bpy.data.images.load(path)
        image.pack()
    image.name = name
    image.filepath_raw = ""
    return image


# ---- textureInfo ----


def info_of(texture, index):
    """The textureInfo of a texture whose image has this index, whatever an index is to the caller."""
    info = {"index": index}
    if texture.texcoord != 0:
        info["texCoord"] = texture.texcoord
    transform = {}
    if tuple(texture.offset) != (0.0, 0.0):
        transform["offset"] = [number(x) for x in texture.offset]
    if texture.rotation != 0.0:
        transform["rotation"] = number(texture.rotation)
    if tuple(texture.scale) != (1.0, 1.0):
        transform["scale"] = [number(x) for x in texture.scale]
    if transform:
        info["extensions"] = {TRANSFORM: transform}
    return info


def set_from(texture, info, image, closest=False):
    """Sets a texture from a textureInfo and the image that it means; info None: to nothing."""
    info = info or {}
    transform = info.get("extensions", {}).get(TRANSFORM, {})
    texture.image = image
    # Where the transform names a set of coordinates it is that one.
    texture.texcoord = min(transform.get("texCoord", info.get("texCoord", 0)), 1)
    texture.offset = transform.get("offset", (0.0, 0.0))
    texture.rotation = transform.get("rotation", 0.0)
    texture.scale = transform.get("scale", (1.0, 1.0))
    texture.closest = closest


# ---- textures of a preset ----


def _preset_image(entry, folder, name):
    uri = entry.get("uri", "")
    if uri.startswith("data:"):
        return image_of(name, base64.b64decode(uri.partition(",")[2], validate=True))
    with open(os.path.join(folder, uri), "rb") as file:
        return image_of(name, file.read())


def preset_reader(preset, path):
    """Sets a texture from a textureInfo of a preset, whose extras hold textures, images and samplers."""
    extras = preset.get("extras", {})

    def set_texture(texture, info):
        if info is None:
            set_from(texture, None, None)
            return
        entry = extras["textures"][info["index"]]
        image = _preset_image(extras["images"][entry["source"]], os.path.dirname(path), preset.get("name", "example"))
        sampler = extras["samplers"][entry["sampler"]] if "sampler" in entry else {}
        set_from(texture, info, image, sampler.get("magFilter") == NEAREST)

    return set_texture


class PresetWriter:
    """Collects the images of a preset's textures for its extras."""

    def __init__(self):
        self.textures, self.images, self.samplers = [], [], []

    @staticmethod
    def _index(entries, entry):
        if entry not in entries:
            entries.append(entry)
        return entries.index(entry)

    def info(self, texture):
        if texture is None or texture.image is None:
            return None
        data = bytes_of(texture.image)
        uri = f"data:{mime_type_of(data)};base64,{base64.b64encode(data).decode()}"
        entry = {"source": self._index(self.images, {"uri": uri})}
        if texture.closest:
            entry["sampler"] = self._index(self.samplers, {"magFilter": NEAREST, "minFilter": NEAREST})
        return info_of(texture, self._index(self.textures, entry))

    def extras(self):
        named = {"textures": self.textures, "images": self.images, "samplers": self.samplers}
        return {name: entries for name, entries in named.items() if entries}
