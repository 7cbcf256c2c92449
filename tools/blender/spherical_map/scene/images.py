"""Image datablocks, of files and of arrays, kept in the .blend file."""

import os
import tempfile
from typing import NamedTuple, Optional

import bpy
import numpy as np

from ..core.refusal import Refusal
from ..core.steps import ImageFile
from .mesh_reading import column, uv_name, uv_of


_ours = "spherical_map"  # property of images that were made here
_readable = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr")


def of_file(file: ImageFile, name: str, is_data: bool) -> bpy.types.Image:
    """An image of a file, packed, and kept without users. One that we made by that name is replaced wherever
    it is used."""
    made = _packed(file, is_data, bpy.path.clean_name(name))
    made.filepath_raw = "//" + bpy.path.clean_name(name) + file.ending
    return _named(made, name)


def _packed(file: ImageFile, is_data: bool, stem: str = "image") -> bpy.types.Image:
    """File › External Data › Unpack writes it under this name."""
    with tempfile.TemporaryDirectory(prefix="sphparam-") as folder:
        path = os.path.join(folder, stem + file.ending)
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
    if old is not None and old != made and _ours in old:
        old.user_remap(made)
        bpy.data.images.remove(old)
    made.name = name
    made[_ours] = True
    made.use_fake_user = True
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


def _base_node(material) -> Optional[bpy.types.ShaderNode]:
    """What is linked to the base colour of a material's shader."""
    if material is None or not material.use_nodes:
        return None
    shaders = [n for n in material.node_tree.nodes if n.type.startswith("BSDF") or n.type == "EMISSION"]
    shader = next((n for n in shaders if n.type == "BSDF_PRINCIPLED"), next(iter(shaders), None))
    if shader is None:  # in a group: the only image there is
        found = [n for n in material.node_tree.nodes if n.type == "TEX_IMAGE" and n.outputs[0].is_linked]
        return found[0] if len(found) == 1 else None
    socket = shader.inputs.get("Base Color") or shader.inputs.get("Color")
    while socket is not None and socket.is_linked:
        node = socket.links[0].from_node
        if node.type != "REROUTE":
            return node
        socket = node.inputs[0]
    return None


def _shows_image(node) -> bool:
    """Whether an image is somewhere before a node."""
    if node.type == "TEX_IMAGE":
        return True
    return any(_shows_image(link.from_node) for socket in node.inputs for link in socket.links)


def _used_base_nodes(obj) -> list:
    used = set(column(obj.data.polygons, "material_index", np.int32))
    return [_base_node(slot.material) for index, slot in enumerate(obj.material_slots) if index in used]


def _image_node(obj, node) -> Optional[bpy.types.ShaderNode]:
    """A node where it is an image; None: there is none. Raises Refusal for one that others change."""
    if node is None or not _shows_image(node):
        return None
    if node.type != "TEX_IMAGE":
        raise _of_cycles(obj, f"an image that other nodes change ({node.name}) as base colour")
    return node if node.image else None


def colour_name_of(obj: bpy.types.Object) -> str:
    """The colour attribute that its materials show; empty: they name none."""
    kinds = {"VERTEX_COLOR": "layer_name", "ATTRIBUTE": "attribute_name"}
    names = {getattr(n, kinds[n.type]) if n is not None and n.type in kinds else "" for n in _used_base_nodes(obj)}
    return names.pop() if len(names) == 1 else ""


def _of_cycles(obj, what: str) -> Refusal:
    return Refusal(
        f"{obj.name} has {what}: Render Properties › Bake of Cycles knows all materials, and bakes into the UV map "
        f"{uv_name}"
    )


def _uv_map_of(obj, node) -> str:
    """The name of the UV map that an image is looked up by; empty: the one that is rendered. Raises Refusal."""
    if not node.inputs["Vector"].is_linked:
        return ""
    link = node.inputs["Vector"].links[0]
    if link.from_node.type == "UVMAP":
        return link.from_node.uv_map
    if link.from_node.type == "TEX_COORD" and link.from_socket.name == "UV":
        return ""
    raise _of_cycles(obj, f"the image {node.image.name} by other coordinates than a UV map ({link.from_node.name})")


def _require_plain(obj, node) -> None:
    """Raises Refusal where the material shows something else than the image as it is."""
    image = node.image
    if image.source == "TILED":
        raise _of_cycles(obj, f"the tiled image {image.name} (UDIM)")
    if node.projection != "FLAT" or node.extension != "REPEAT":
        raise _of_cycles(obj, f"the image {image.name} with the settings {node.projection} and {node.extension}")
    if image.colorspace_settings.name not in ("sRGB", "Filmic sRGB") and not image.is_float:
        raise _of_cycles(obj, f"the image {image.name} in the colour space {image.colorspace_settings.name}")


def base_colour_of(obj: bpy.types.Object) -> Optional[BaseColour]:
    """The image of its materials, and its UV map; None: there is none. Raises Refusal for several, and for what
    is more than an image by its UV map."""
    mesh = obj.data
    nodes = [_image_node(obj, n) for n in _used_base_nodes(obj)]
    node = next((n for n in nodes if n is not None), None)
    if node is None:
        return None
    if any(n is None or n.image != node.image for n in nodes):
        raise _of_cycles(obj, "materials with different base colours")
    rendered = next((layer.name for layer in mesh.uv_layers if layer.active_render), "")
    names = [_uv_map_of(obj, n) or rendered for n in nodes]
    for one in nodes:
        _require_plain(obj, one)
    name = names[0]
    if any(other != name for other in names):
        raise _of_cycles(obj, "materials with different UV maps")
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
