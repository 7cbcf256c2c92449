"""What is at fault is selected, and nothing else of the mesh."""

import bpy
import numpy as np

from ..core.refusal import Elements
from .mesh_reading import column


def select(context, obj: bpy.types.Object, elements: Elements) -> str:
    """Selects elements of a mesh, in the mode that shows them; how many, in words."""
    mesh = obj.data
    pairs = column(mesh.edges, "vertices", np.int32, 2).astype(np.int64)
    key = np.sort(pairs, axis=1) @ [len(mesh.vertices), 1]
    wanted = np.sort(elements.edges, axis=1) @ [len(mesh.vertices), 1]
    edges = np.isin(key, wanted)
    polygons = np.zeros(len(mesh.polygons), bool)
    polygons[elements.polygons] = True
    starts = column(mesh.polygons, "loop_start", np.int32)
    of_loop = np.repeat(polygons, column(mesh.polygons, "loop_total", np.int32)) if len(starts) else polygons
    vertices = np.zeros(len(mesh.vertices), bool)
    vertices[elements.vertices] = True
    vertices[pairs[edges].ravel()] = True
    vertices[column(mesh.loops, "vertex_index", np.int32)[of_loop]] = True
    edges[column(mesh.loops, "edge_index", np.int32)[of_loop]] = True
    for items, flags in ((mesh.vertices, vertices), (mesh.edges, edges), (mesh.polygons, polygons)):
        items.foreach_set("select", flags)
    mesh.update()
    modes = (len(elements.vertices) > 0, len(elements.edges) > 0, len(elements.polygons) > 0)
    context.tool_settings.mesh_select_mode = modes
    make_active(context, obj)
    count, noun = next(
        (len(rows), noun) for rows, noun in (
            (elements.vertices, "vertices"), (elements.edges, "edges"), (elements.polygons, "faces"))
        if len(rows)
    )  # fmt: skip
    return f"{count} {noun} selected"


def make_active(context, obj: bpy.types.Object) -> None:
    """Selects an object and no other."""
    for other in context.selected_objects:
        other.select_set(False)
    obj.select_set(True)
    context.view_layer.objects.active = obj
