"""Maps, UV maps and normals onto meshes of Blender; new objects."""

from typing import Dict, Optional

import bpy
import numpy as np

from ..core import chart as charts
from ..core import ply, steps
from ..core.refusal import Refusal
from ..core.surface import Surface
from .cutting import cut_mesh
from .mesh_reading import column, directions_name, directions_rest, loop_normals, uv_name


def write_attribute(mesh: bpy.types.Mesh, name: str, kind: str, values: np.ndarray, field: str = "value") -> None:
    """An attribute of vertices, made anew."""
    old = mesh.attributes.get(name)
    if old is not None:
        mesh.attributes.remove(old)
    mesh.attributes.new(name, kind, "POINT").data.foreach_set(field, np.ascontiguousarray(values).ravel())


def write_directions(mesh: bpy.types.Mesh, directions: np.ndarray) -> None:
    """(V, 3), to 48 bits."""
    high = directions.astype(np.float32)
    write_attribute(mesh, directions_name, "FLOAT_VECTOR", high, "vector")
    write_attribute(mesh, directions_rest, "FLOAT_VECTOR", (directions - high).astype(np.float32), "vector")


_most_uv_maps = 8  # of Blender


def require_uv_room(mesh: bpy.types.Mesh) -> None:
    """Raises Refusal where the mesh can have no UV map of ours."""
    if uv_name not in mesh.uv_layers and len(mesh.uv_layers) >= _most_uv_maps:
        raise Refusal(f"{mesh.name} has as many UV maps as Blender allows: remove one")


def write_uv(mesh: bpy.types.Mesh, uv: np.ndarray, name: str = uv_name) -> None:
    """(L, 2) as the UV map of that name, which becomes the active one. Requires: there is room for it."""
    layer = mesh.uv_layers.get(name) or mesh.uv_layers.new(name=name, do_init=False)
    layer.data.foreach_set("uv", uv.astype(np.float32).ravel())
    mesh.uv_layers.active = mesh.uv_layers[name]


def mark_seam(mesh: bpy.types.Mesh, uv: np.ndarray) -> None:
    """Edges whose two sides lie apart in (u, v) at both ends are seams; other edges stay as they are."""
    vertices = column(mesh.loops, "vertex_index", np.int32)
    edges = column(mesh.loops, "edge_index", np.int32)
    starts = column(mesh.polygons, "loop_start", np.int32)
    following = np.arange(1, len(vertices) + 1)
    following[np.append(starts[1:], len(vertices)) - 1] = starts
    ends = np.where(vertices[:, None] < vertices[following][:, None], [0, 1], [1, 0])
    sides = np.stack([np.arange(len(vertices)), following], axis=1)
    sides = np.take_along_axis(sides, ends, axis=1)
    order = np.argsort(edges, kind="stable")
    pairs = order[:-1][np.diff(edges[order]) == 0], order[1:][np.diff(edges[order]) == 0]
    apart = (uv[sides[pairs[0]]] != uv[sides[pairs[1]]]).any(axis=2).all(axis=1)
    seams = column(mesh.edges, "use_seam", bool)
    seams[edges[pairs[0][apart]]] = True
    mesh.edges.foreach_set("use_seam", seams)


def _normals_after(surface: Surface, cut: charts.Cut, normals: np.ndarray) -> np.ndarray:
    """(L′, 3): of loops that stay, and of new triangles between those of the triangle they are part of."""
    ends = np.append(surface.polygon_starts[1:], len(surface.loop_vertices))
    stays = np.repeat(cut.kept, ends - surface.polygon_starts)
    new = np.einsum("mkc,mcx->mkx", cut.weights, normals[cut.loops]).reshape(-1, 3)
    new /= np.maximum(np.linalg.norm(new, axis=1, keepdims=True), 1e-30)
    return np.concatenate([normals[stays], new])


def _places_after(surface: Surface, cut: charts.Cut) -> np.ndarray:
    """(V + k, 3) float32."""
    corners = surface.positions.astype(np.float64)[cut.new_corners]
    new = np.einsum("kc,kcx->kx", cut.new_weights, corners)
    return np.concatenate([surface.positions, new.astype(np.float32)])


def apply_chart(mesh: bpy.types.Mesh, surface: Surface, chart: charts.Chart, cuts: bool) -> int:
    """Puts the map and its UV map on the mesh; where `cuts`, splits what the seam and the poles cut.

    Custom normals stay what they are; returns how many polygons were cut.
    """
    if not cuts:
        uv = charts.wrapped_uv(surface, chart)
        write_uv(mesh, uv)
        write_directions(mesh, charts.directions_of(surface, chart))
        return 0
    cut = charts.cut(surface, chart)
    stays = np.repeat(cut.kept, np.diff(np.append(surface.polygon_starts, len(surface.loop_vertices))))
    uv = np.concatenate([cut.loop_uv[stays], cut.uv.reshape(-1, 2)])
    if cut.is_needed:
        normals = loop_normals(mesh) if mesh.has_custom_normals else None
        cut_mesh(mesh, cut, _places_after(surface, cut))
        if normals is not None:
            mesh.normals_split_custom_set(_normals_after(surface, cut, normals))
    write_uv(mesh, uv)
    write_directions(mesh, cut.directions)
    mark_seam(mesh, column(mesh.uv_layers[uv_name].data, "uv", np.float32, 2))
    return int((~cut.kept).sum())


def new_object(
    name: str, found: ply.Ply, beside: bpy.types.Object, context, scalars: Optional[Dict[str, np.ndarray]] = None
) -> bpy.types.Object:
    """An object of a mesh with its map, colours and scalars, where another one is, in the same collections;
    smooth."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(found.vertices["x"]))
    mesh.vertices.foreach_set("co", found.table("x", "y", "z").astype(np.float32).ravel())
    mesh.loops.add(len(found.corners))
    mesh.loops.foreach_set("vertex_index", found.corners.astype(np.int32))
    mesh.polygons.add(len(found.counts))
    starts = np.concatenate([[0], np.cumsum(found.counts)[:-1]]).astype(np.int32)
    mesh.polygons.foreach_set("loop_start", starts)
    mesh.polygons.foreach_set("loop_total", found.counts.astype(np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(found.counts), bool))
    mesh.update(calc_edges=True)
    write_directions(mesh, found.table("sx", "sy", "sz").astype(np.float64))
    _write_carried(mesh, found, scalars or {})
    made = bpy.data.objects.new(name, mesh)
    made.matrix_world = beside.matrix_world
    for collection in beside.users_collection or [context.scene.collection]:
        collection.objects.link(made)
    return made


def _write_carried(mesh: bpy.types.Mesh, found: ply.Ply, scalars: Dict[str, np.ndarray]) -> None:
    """Numbers and colours that came along: colours last, where Blender finds another name for them if need be."""
    for name, values in scalars.items():
        kind = "FLOAT" if values.dtype.kind == "f" else "INT"
        write_attribute(mesh, name, kind, values.astype(np.float32 if kind == "FLOAT" else np.int32))
    colours: Optional[np.ndarray] = steps.colours_of(found)
    if colours is not None:
        attribute = mesh.color_attributes.new("Color", "BYTE_COLOR", "POINT")
        attribute.data.foreach_set("color_srgb", colours.astype(np.float32).ravel())
