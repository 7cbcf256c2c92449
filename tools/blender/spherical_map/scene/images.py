"""Image datablocks, of files and of arrays, kept in the .blend file."""

import os
import tempfile
from typing import NamedTuple, Optional

import bpy
import numpy as np

from ..core.refusal import Refusal
from ..core.steps import ImageFile
from .mesh_reading import column, uv_name, uv_of


_readable = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr")


def of_file(file: ImageFile, name: str, is_data: bool) -> bpy.types.Image:
    """An image of a file, packed. One of that name is replaced wherever it is used."""
    made = _packed(file, is_data)
    made.filepath_raw = "//" + name + file.ending
    return _named(made, name)


def _packed(file: ImageFile, is_data: bool) -> bpy.types.Image:
    with tempfile.TemporaryDirectory(prefix="sphparam-") as folder:
        path = os.path.join(folder, "image" + file.ending)
        with open(path, "wb") as out:
            out.write(file.data)
        made = bpy.data.images.load(path)
        made.colorspace_settings.name = "Non-Color" if is_data else "sRGB"
        made.pack()
    return made


def of_values(name: str, values: np.ndarray) -> bpy.types.Image:
    """An image of numbers (H, W), the top row first, in single precision, packed."""
    height, width = values.shape
    made = bpy.data.images.new(name, width, height, alpha=False, float_buffer=True, is_data=True)
    pixels = np.ones((height, width, 4), np.float32)
    pixels[:, :, :3] = values[::-1, :, None]
    made.pixels.foreach_set(pixels.ravel())
    made.update()
    made.pack()
    return _named(made, name)


def _named(made: bpy.types.Image, name: str) -> bpy.types.Image:
    old = bpy.data.images.get(name)
    if old is not None and old != made:
        old.user_remap(made)
        bpy.data.images.remove(old)
    made.name = name
    return made


def values_of(image: bpy.types.Image) -> np.ndarray:
    """(H, W) the first channel, the top row first."""
    width, height = image.size
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(height, width, image.channels)[::-1, :, 0]


def values_in(file: ImageFile) -> np.ndarray:
    """The same of a file."""
    image = _packed(file, True)
    try:
        return values_of(image)
    finally:
        bpy.data.images.remove(image)


class BaseColour(NamedTuple):
    """Where a material has its base colour from."""

    image: bpy.types.Image
    uv: np.ndarray
    """(L, 2)."""
    filter: str
    """In the words of `bake --filter`."""


def _image_node(material) -> Optional[bpy.types.ShaderNode]:
    """The image that is linked to the base colour of a Principled BSDF, or the only one that is linked."""
    if material is None or not material.use_nodes:
        return None
    nodes = [n for n in material.node_tree.nodes if n.type == "TEX_IMAGE" and n.image and n.outputs[0].is_linked]
    for node in nodes:
        if any(link.to_socket.name in ("Base Color", "Color") for link in node.outputs[0].links):
            return node
    return nodes[0] if len(nodes) == 1 else None


def base_colour_of(obj: bpy.types.Object) -> Optional[BaseColour]:
    """The image of its materials, and its UV map; None: there is none. Raises Refusal for several."""
    mesh = obj.data
    used = set(column(mesh.polygons, "material_index", np.int32))
    nodes = [_image_node(m) for index, m in enumerate(mesh.materials) if index in used]
    node = next((n for n in nodes if n is not None), None)
    if node is None:
        return None
    if any(n is None or n.image != node.image for n in nodes):
        raise Refusal(
            f"{obj.name} has materials with different base colours: Render Properties › Bake of Cycles knows all "
            f"materials, and bakes into the UV map {uv_name}"
        )
    source = node.inputs["Vector"].links[0].from_node if node.inputs["Vector"].is_linked else None
    named = source.uv_map if source is not None and source.type == "UVMAP" else ""
    rendered = next((layer.name for layer in mesh.uv_layers if layer.active_render), "")
    name = named or rendered
    if name not in mesh.uv_layers:
        raise Refusal(f"{obj.name}: the UV map of {node.image.name} is not there")
    words = {"Closest": "nearest", "Linear": "bilinear", "Cubic": "bicubic", "Smart": "bicubic"}
    return BaseColour(node.image, uv_of(mesh, name), words[node.interpolation])


def file_of(image: bpy.types.Image) -> ImageFile:
    """The file of an image, where it is as it is in Blender; else one that Blender makes of it."""
    path = bpy.path.abspath(image.filepath, library=image.library)
    ending = os.path.splitext(path)[1].lower()
    if image.source == "FILE" and not image.is_dirty and ending in _readable:
        if image.packed_file:
            return ImageFile(image.packed_file.data, ending)
        if os.path.exists(path):
            with open(path, "rb") as file:
                return ImageFile(file.read(), ending)
    return _saved(image)


def _saved(image: bpy.types.Image) -> ImageFile:
    """Of its pixels: a copy of the datablock would have those of its file, or none."""
    ending = ".exr" if image.is_float else ".png"
    width, height = image.size
    if not (width and height):
        raise Refusal(f"{image.name} has no pixels: is its file there?")
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    full = np.ones((width * height, 4), np.float32)
    full[:, : image.channels] = pixels.reshape(-1, image.channels)
    copy = bpy.data.images.new("sphparam", width, height, alpha=True, float_buffer=image.is_float)
    try:
        copy.alpha_mode = "CHANNEL_PACKED"
        copy.pixels.foreach_set(full.ravel())
        with tempfile.TemporaryDirectory(prefix="sphparam-") as folder:
            copy.file_format = "OPEN_EXR" if image.is_float else "PNG"
            copy.filepath_raw = os.path.join(folder, "image" + ending)
            copy.save()
            with open(copy.filepath_raw, "rb") as file:
                return ImageFile(file.read(), ending)
    finally:
        bpy.data.images.remove(copy)
