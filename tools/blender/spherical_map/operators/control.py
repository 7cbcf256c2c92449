"""Control mesh: few quads, a Subdivision Surface modifier, and Displace by the image of what it lacks."""

import bpy

from ..core import layout, steps
from ..scene import control, materials, mesh_reading, selection
from .running import RunningOperator


class SPHERICAL_MAP_OT_control(RunningOperator, bpy.types.Operator):
    """Fit a Catmull-Clark control mesh to the active mesh, as a new object whose modifiers subdivide it and
    displace it by an image"""

    bl_idname = "object.spherical_map_control"
    bl_label = "Spherical Control Mesh"
    bl_options = {"REGISTER", "UNDO"}

    edges: bpy.props.IntProperty(name="Edges", description="Quads along an edge of the cube: 6·N² quads",
                                 default=16, min=2, max=256)  # fmt: skip
    levels: bpy.props.IntProperty(name="Levels", description="Of subdivision", default=4, min=1, max=7)

    def invoke(self, context, event):
        if bpy.app.background:
            return self.execute(context)
        return context.window_manager.invoke_props_dialog(self)

    def gather(self, context):
        layout.require_size(self.edges, self.levels)
        return mesh_reading.surface_of(context.object, with_directions=True)

    def work(self, surface):
        self._source = surface.name
        width, self._lost = layout.source_width(self.edges, self.levels)
        return lambda route, folder: steps.fit_control(route, folder, surface, self.edges, width)

    def finish(self, context, result):
        source = bpy.data.objects[self._source]
        made = control.make(result, self.edges, self.levels, source, context)
        selection.make_active(context, made)
        said = result.figures
        return (
            f"{made.name}: {6 * self.edges ** 2} quads, RMS {said.base_rms:.4g} from the mesh without displacement, "
            f"which is from {said.least:.4g} to {said.greatest:.4g}{self._lost}{materials.left_with(source)}"
        )
