"""Remesh: a mapped mesh on a grid of the sphere, as a new object."""

import bpy

from ..core import steps
from ..scene import materials, mesh_reading, mesh_writing, selection
from .running import RunningOperator


class SPHERICAL_MAP_OT_remesh(RunningOperator, bpy.types.Operator):
    """Resample the active mesh on a grid of the sphere, as a new object with a UV map"""

    bl_idname = "object.spherical_map_remesh"
    bl_label = "Spherical Remesh"
    bl_options = {"REGISTER", "UNDO"}

    grid: bpy.props.EnumProperty(
        name="Grid",
        items=[
            ("ICO", "Icosahedron", "Triangles, all of about one size"),
            ("CUBE", "Cube", "Quads"),
            ("OCTA", "Octahedron", "Triangles that unfold to a square"),
        ],
    )
    level: bpy.props.IntProperty(name="Level", description="The icosahedron is halved so often: 10·4ᴸ + 2 vertices",
                                 default=5, min=0, max=10)  # fmt: skip
    edges: bpy.props.IntProperty(name="Edges", description="Quads along an edge of the cube", default=32,
                                 min=1, max=2048)  # fmt: skip
    samples: bpy.props.IntProperty(name="Samples", description="N × N of the unfolded octahedron, odd",
                                   default=129, min=3, max=4097, step=2)  # fmt: skip

    def invoke(self, context, event):
        if bpy.app.background:
            return self.execute(context)
        return context.window_manager.invoke_props_dialog(self)

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.prop(self, "grid")
        self.layout.prop(self, {"ICO": "level", "CUBE": "edges", "OCTA": "samples"}[self.grid])

    def _grid(self):
        return {"ICO": f"ico:{self.level}", "CUBE": f"cube:{self.edges}", "OCTA": f"octa:{self.samples}"}[self.grid]

    def gather(self, context):
        surface = mesh_reading.surface_of(context.object, with_directions=True)
        surface.colours = mesh_reading.colours_of(context.object.data)
        surface.scalars = mesh_reading.scalars_of(context.object.data)
        return surface

    def work(self, surface):
        self._source = surface.name
        return lambda route, folder: steps.remesh(route, folder, surface, self._grid())

    def finish(self, context, result):
        found, mapped = result.mesh, result.mapped
        beside = bpy.data.objects[self._source]
        made = mesh_writing.new_object(mapped.surface.name, found, beside, context, result.scalars)
        mesh_writing.apply_chart(made.data, mapped.surface, mapped.chart, True)
        selection.make_active(context, made)
        said = f"{made.name}: {len(found.vertices['x'])} vertices, {len(found.counts)} faces"
        return said + materials.left_with(beside)
