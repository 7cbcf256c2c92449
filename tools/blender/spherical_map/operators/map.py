"""Map: the selected meshes onto the sphere, one-to-one, with a UV map."""

import os

import bpy

from ..core import steps
from ..core.refusal import Refusal
from ..scene import mesh_reading, mesh_writing
from .running import RunningOperator, require_editable, selected_meshes


def _require_no_sculpture(obj):
    """Blender does not carry the detail of Multires to faces that are cut. Raises Refusal."""
    if any(modifier.type == "MULTIRES" for modifier in obj.modifiers):
        raise Refusal(
            f"{obj.name} has a Multiresolution modifier, whose sculpted detail faces that are cut would lose: apply it, "
            "or map without Cut Along the Seam"
        )


class SPHERICAL_MAP_OT_map(RunningOperator, bpy.types.Operator):
    """Map the selected meshes one-to-one onto the sphere, and give them a UV map for equirectangular images"""

    bl_idname = "object.spherical_map"
    bl_label = "Spherical Map"
    bl_options = {"REGISTER", "UNDO"}

    balance: bpy.props.EnumProperty(
        name="Balance",
        items=[
            ("balanced", "Balanced", "Angles and areas alike"),
            ("conformal", "Angles", "Least distortion of angles, whatever the areas"),
            ("equal-area", "Areas", "Least distortion of areas"),
        ],
    )
    quality: bpy.props.EnumProperty(
        name="Quality",
        items=[
            ("normal", "Normal", "Within one percent of the least energy"),
            ("draft", "Draft", "Quick"),
            ("best", "Best", "To convergence"),
        ],
    )
    cut: bpy.props.BoolProperty(
        name="Cut Along the Seam",
        description="Add vertices where seam and poles lie within faces, as exported files have them, so that "
        "every point of the image has one owner; else no vertex is added, and u goes on beyond 1 across the "
        "seam",
        default=True,
    )

    def gather(self, context):
        objects = selected_meshes(context)
        for obj in objects:
            require_editable(obj)
            mesh_writing.require_uv_room(obj.data)
            if self.cut:
                _require_no_sculpture(obj)
        return [mesh_reading.surface_of(obj) for obj in objects]

    def work(self, surfaces):
        def of_all(route, folder):
            found = []
            for number, surface in enumerate(surfaces):
                place = os.path.join(folder, str(number))
                os.mkdir(place)
                found.append(
                    steps.map_surface(route, place, surface, self.balance, self.quality, not self.cut)
                )
            return found

        return of_all

    def finish(self, context, result):
        lines = []
        for mapped in result:
            mesh = bpy.data.objects[mapped.surface.name].data
            cuts = mesh_writing.apply_chart(mesh, mapped.surface, mapped.chart, self.cut)
            said = mapped.verdict
            line = f"{said.verdict}, angle {said.angle:.3f}, area {said.area:.3f}"
            mesh["spherical_map"] = line
            lines.append(f"{mapped.surface.name}: {line}" + (f", {cuts} faces cut" if cuts else ""))
        return "; ".join(lines)
