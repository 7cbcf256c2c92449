"""Meshes of Blender as arrays."""

from typing import List, Optional

import bpy
import numpy as np

from ..core.surface import Surface

directions_name, directions_rest = "spherical_map", "spherical_map_rest"
"""Attributes of vertices: the direction in single precision, and what that leaves of it."""
uv_name = "Spherical"
"""The UV map."""
grid_uv_name = "Spherical Grid"
"""That of a control mesh in the layout of its displacement."""


def column(items, name: str, kind, width: int = 1) -> np.ndarray:
    """(n,) or (n, width) of a collection."""
    found = np.empty(len(items) * width, kind)
    items.foreach_get(name, found)
    return found if width == 1 else found.reshape(-1, width)


def directions_of(mesh: bpy.types.Mesh) -> Optional[np.ndarray]:
    """(V, 3) that `write_directions` wrote; None: the mesh has no map."""
    parts = [mesh.attributes.get(name) for name in (directions_name, directions_rest)]
    if parts[0] is None or parts[0].data_type != "FLOAT_VECTOR" or parts[0].domain != "POINT":
        return None
    found = np.zeros((len(mesh.vertices), 3))
    for part in parts:
        if part is not None:
            found += column(part.data, "vector", np.float32, 3)
    return found


def loop_normals(mesh: bpy.types.Mesh) -> np.ndarray:
    """(L, 3) as Blender shades."""
    if hasattr(mesh, "corner_normals"):  # since 4.1
        return column(mesh.corner_normals, "vector", np.float32, 3)
    mesh.calc_normals_split()
    found = column(mesh.loops, "normal", np.float32, 3)
    mesh.free_normals_split()
    return found


def surface_of(obj: bpy.types.Object, *, with_directions: bool = False) -> Surface:
    """Vertices, polygons and their triangles; with the map of the mesh, where it has one."""
    mesh = obj.data
    mesh.calc_loop_triangles()
    return Surface(
        obj.name,
        column(mesh.vertices, "co", np.float32, 3),
        column(mesh.loops, "vertex_index", np.int32),
        column(mesh.polygons, "loop_start", np.int32),
        column(mesh.loop_triangles, "loops", np.int32, 3),
        column(mesh.loop_triangles, "polygon_index", np.int32),
        directions_of(mesh) if with_directions else None,
    )


def colours_of(mesh: bpy.types.Mesh, name: str = "") -> Optional[np.ndarray]:
    """(V, 4) bytes in sRGB of a colour attribute, or of the one that is rendered; of corners the mean at a vertex."""
    index = mesh.color_attributes.find(name) if name else mesh.color_attributes.render_color_index
    if not 0 <= index < len(mesh.color_attributes):
        return None
    attribute = mesh.color_attributes[index]
    found = column(attribute.data, "color", np.float32, 4).astype(np.float64)
    if attribute.domain == "CORNER":
        vertices = column(mesh.loops, "vertex_index", np.int32)
        times = np.maximum(np.bincount(vertices, minlength=len(mesh.vertices)), 1)
        found = np.stack([np.bincount(vertices, c, len(mesh.vertices)) / times for c in found.T], axis=1)
    light = np.clip(found, 0, 1)
    light[:, :3] = np.where(
        light[:, :3] <= 0.0031308, 12.92 * light[:, :3], 1.055 * light[:, :3] ** (1 / 2.4) - 0.055
    )
    return np.rint(255 * light).astype(np.uint8)


def scalar_names(mesh: bpy.types.Mesh) -> List[str]:
    """Numbers that vertices carry and that can be baked or remeshed."""
    return [
        a.name for a in mesh.attributes
        if a.domain == "POINT" and a.data_type in ("FLOAT", "INT") and not a.name.startswith((".", "spherical_map"))
    ]  # fmt: skip


def scalars_of(mesh: bpy.types.Mesh) -> dict:
    """Name to (V,)."""
    kinds = {"FLOAT": np.float32, "INT": np.int32}
    found = [mesh.attributes[name] for name in scalar_names(mesh)]
    return {a.name: column(a.data, "value", kinds[a.data_type]) for a in found}


def uv_of(mesh: bpy.types.Mesh, name: str) -> np.ndarray:
    """(L, 2) of a UV map."""
    return column(mesh.uv_layers[name].data, "uv", np.float32, 2)
