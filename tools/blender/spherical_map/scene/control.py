"""A control mesh with its two modifiers: Subdivision Surface, and Displace by an image."""

from dataclasses import replace

import bpy
import numpy as np

from ..core import layout
from ..core.steps import Control
from . import images
from .mesh_reading import column, grid_uv_name
from .mesh_writing import apply_chart, new_object, write_uv


def _subdivision(obj: bpy.types.Object, levels: int) -> bpy.types.Modifier:
    """Catmull-Clark to the limit surface; texture coordinates run straight over every quad."""
    made = obj.modifiers.new("Subdivision", "SUBSURF")
    made.subdivision_type = "CATMULL_CLARK"
    made.levels = made.render_levels = levels
    made.use_limit_surface = True
    made.uv_smooth = "NONE"
    made.show_only_control_edges = True
    return made


def _subdivided(obj: bpy.types.Object, context) -> tuple:
    """(V, 3) vertices and, of each, one (u, v), after the object's modifiers."""
    graph = context.evaluated_depsgraph_get()
    evaluated = obj.evaluated_get(graph)
    mesh = evaluated.to_mesh()
    vertices = column(mesh.vertices, "co", np.float32, 3).astype(np.float64)
    loops = column(mesh.loops, "vertex_index", np.int32)
    uv = column(mesh.uv_layers[grid_uv_name].data, "uv", np.float32, 2).astype(np.float64)
    evaluated.to_mesh_clear()
    return vertices, loops, uv


def _image_of(control: Control, quads: layout.CubeLayout, levels: int, beside, context) -> np.ndarray:
    """The displacement at every vertex of the subdivided mesh, in the layout of the grid.

    The direction of such a vertex is what Catmull-Clark makes of the control points' directions: that is
    how sphparam's image is meant. Blender itself subdivides them here.
    """
    found = control.mesh
    sphere = dict(found.vertices, **dict(zip("xyz", found.table("sx", "sy", "sz").T)))
    helper = new_object("sphparam directions", replace(found, vertices=sphere), beside, context)
    try:
        write_uv(helper.data, quads.uv().reshape(-1, 2), grid_uv_name)
        _subdivision(helper, levels)
        directions, loops, places = _subdivided(helper, context)
    finally:
        mesh = helper.data
        bpy.data.objects.remove(helper)
        bpy.data.meshes.remove(mesh)
    heights = layout.equirectangular(images.values_in(control.image), directions)
    return quads.image(places, heights[loops])


def make(control: Control, edges: int, levels: int, beside: bpy.types.Object, context) -> bpy.types.Object:
    """An object with the control mesh, the image of what it lacks, and modifiers that put them together."""
    made = new_object(beside.name + " control", control.mesh, beside, context)
    corners = control.mesh.corners.reshape(-1, 4)
    directions = control.mesh.table("sx", "sy", "sz")
    quads = layout.CubeLayout(corners, directions, edges, 2**levels)
    write_uv(made.data, quads.uv().reshape(-1, 2), grid_uv_name)
    apply_chart(made.data, control.mapped.surface, control.mapped.chart, False)
    heights = _image_of(control, quads, levels, beside, context)
    image = images.of_values(beside.name + " displacement", heights)
    _subdivision(made, levels)
    displace(made, image)
    return made


def displace(obj: bpy.types.Object, image: bpy.types.Image, scale: float = 1.0, midlevel: float = 0.0) -> None:
    """Displace along normals by (value − midlevel) · scale, looked up by the UV map of the grid as it is: values below
    0 are kept (Blender cuts them off unless told), texels are not blurred, no level of detail is chosen."""
    texture = bpy.data.textures.new(image.name, "IMAGE")
    texture.image = image
    texture.use_clamp = False
    texture.use_alpha = False
    texture.use_interpolation = True
    texture.use_mipmap = False
    texture.filter_type = "BOX"
    texture.filter_size = 1.0
    texture.extension = "EXTEND"
    modifier = obj.modifiers.new("Displacement", "DISPLACE")
    modifier.texture = texture
    modifier.texture_coords = "UV"
    modifier.uv_layer = grid_uv_name
    modifier.direction = "NORMAL"
    modifier.strength = scale
    modifier.mid_level = midlevel
